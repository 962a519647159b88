"""The lesson book: of every day what was planned, what was practised, a line about it, and what returns next.

In: the folders of a student's sessions, what is remembered, the plan of the day. Out: days as values, and the block
that comes next. One file a day keeps what no session knows: the plan, the line, a teacher's words.
Read `book_day` first, then `lesson_book`.
"""

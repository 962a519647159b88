"""Lessons as text: laid out as a teacher wrote them, or written anew where there is no text.

In: the text of a lesson, or music. Out: text, the reference page's tables and the JSON Schema of lessons. `lesson_text`
keeps every comment and sets single values, `line_layout` aligns the lines below the count, `lesson_writer` writes what
imports bring, `lesson_words` has a sentence for every key.
Read `lesson_text` first.
"""

"""Lessons and courses: what is practised, as text files; and mastery, what to practise next.

In: TOML files of teachers, or scores to make lessons of. Out: `Lesson` and `Course` values, and files written back.
`lesson` is the value, `lesson_file` and `grid` read it, `lesson_text` lays its text out, `lesson_writer` writes music
that has none, `quantise` brings a take onto the grid, `library` finds what ships and what is the user's own.
Read `lesson` first.
"""

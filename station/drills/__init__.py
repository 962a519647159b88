"""Lessons and courses: what is practised, as text files; and mastery, what to practise next.

In: TOML files of teachers, or scores to make lessons of. Out: `Lesson` and `Course` values, and files written back.
`lesson` is the value, `grid` and `reading` read it, `writing` gives its text back, `families` makes drills by seed,
`transcription` makes lessons of takes and imports, `editing` changes the text of one that is being written, `songs`
lays a part along a band's sound, `daily` plans a day, `exam` marks a take, `library` finds what ships and what is the
user's own, `difficulty` measures.
Read `lesson` first.
"""

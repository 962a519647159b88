"""Reading lesson files: from the TOML table to a `Lesson`, with every fault at its place.

In: a text, or a file of a teacher. Out: a `Lesson`, or all faults with line, column and remedy. `lesson_fields` is the
schema, `form` the order in which grids are played, `tempo_marks` and `bar_cues` what happens at bars, `played_grids`
lays the music out, `unplayable` says what nobody can play and how fast it can be played at most.
Read `lesson_file` first.
"""

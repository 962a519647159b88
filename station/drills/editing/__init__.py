"""A lesson while it is being written: its text is the truth, and every way of editing it gives another text.

In: the text of a lesson, and an edit (`lesson_edits`), made by mouse, keyboard, a kit or a form. Out: another text,
which keeps what the edit does not touch, comments and spelling too. Pure: no window, no clock, no file.
First read `lesson_edits`.
"""

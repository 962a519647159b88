"""Played music and music of other programs, written down as a teacher would have: the way from a take to a lesson.

In goes a `DrumPart`; out comes a lesson on the cells of a grid, and a word on what was done. `transcribe` is the door
and the file to read first. What belongs to the hand: `ornament_finder`, `diddle_finder`, `loudness_levels`,
`playable_strokes`. When it is meant: `grid_times` and what it asks. What the page looks like: `form_finder`.
"""

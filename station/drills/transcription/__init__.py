"""Played music and music of other programs, written down as a teacher would have: the way from a take to a lesson.

In go the strokes of a MIDI file, a capture or any other `DrumPart`; out come the same strokes on the cells of a grid,
with meter, beat and swing. `grid_times` is the timing's front door and the file to read first.
"""

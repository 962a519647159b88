"""Guitar Pro: `.gp3 .gp4 .gp5` (PyGuitarPro reads the bytes), `.gp` and `.gpx` (`score.gpif` in a zip or a container).

In: bytes of a file. Out: a `DrumPart`. Both readers give a `TabSong`, bars as written; `tab_part` has the repeats
written out and makes the strokes. Read `tab_song` first.
"""

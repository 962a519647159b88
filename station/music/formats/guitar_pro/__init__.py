"""Guitar Pro: `.gp3 .gp4 .gp5` (PyGuitarPro reads the bytes) and `.gp` (a zip with `score.gpif`).

In: bytes of a file. Out: a `DrumPart`. Both readers give a `TabSong`, bars as written; `play_order` writes the repeats
out and `tab_part` makes the strokes. Read `tab_song` first.
"""

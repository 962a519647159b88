"""File formats of music, one module or package each.

In: bytes of a file. Out: a `Score` or a `Performance`; and the way back. A fault names the place in the file.
`smf` is Standard MIDI, `text_score` a score as text whose limbs a person can edit.
"""

"""File formats of music, one module or package each.

In: bytes of a file. Out: a `DrumPart`; and the way back. A fault names the file and the place in it.
`music_format` says what a format is and promises, `format_table` has them all and finds the one that a file is in.
`smf` is Standard MIDI, `text_score` a score as text whose limbs a person can edit. `safe_xml` and `safe_zip` open what
strangers wrote, `playing_order` follows repeats and jumps, `lost_bars` gathers what a writer has no place for.
Read `music_format` first.
"""

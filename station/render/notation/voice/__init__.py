"""One voice of a bar as it is drawn: its chords, and the strokes that notation writes as one.

In: strokes and how their time is written. Out: shapes. `written_strokes` says what is one note to a reader (`tremolo`
its diddles and open rolls, `held_rolls` its buzz rolls), `chord_pen` draws a chord. Read `voice_pen` first.
"""

"""How time is written: values, rests, tuplets and beams of one bar, without a sign drawn.

In: the ticks of a voice's strokes and its meter. Out: `BeatGroup`s. `bar_spelling` spells a bar, `rhythm` one beat with
the fewest signs, `beat_divisions` and `nearest_division` say into what a beat falls, `beaming` joins; `written_rhythm`
is the door for a whole score. It knows music alone. Read `note_values`, then `bar_spelling`.
"""

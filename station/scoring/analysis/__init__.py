"""What an alignment shows: timing, loudness, habits, points, and the faults that a teacher would name.

In: a score, a performance and their alignment. Out: a `Summary`; of it findings, each an effect with its interval and
what else the data allow. `timing_spread` says how sure a figure is, `points` is the score from 0 to 100, `habits`
explains by few causes, `findings` names faults, `technique` looks beyond the single stroke.
Read `summary`, then `habits` and `findings`.
"""

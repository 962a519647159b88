"""What an alignment shows: timing, loudness, habits, points, faults with their intervals.

In: a score, a performance and their alignment. Out: a `Summary` and findings, each an effect with its interval.
`points` is the score from 0 to 100, `habits` tells effects apart, `findings` names faults, `technique` looks beyond the
single stroke.
Read `summary` first.
"""

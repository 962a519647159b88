"""A lag of all strokes that nobody has measured: found in a session, left out of its judgement, said, and offered.

In goes a session's result with what is known of its devices and what earlier sessions showed; out comes the result as
it is judged fairly, and whose the lag is. Start with `fair_judgement`; the figures are `scoring.analysis.device_lag`'s.
"""

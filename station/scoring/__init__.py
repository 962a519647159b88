"""Align, judge, summarise, advise: hits and notes in, judgements and figures out.

In: a `Score` and a `Performance`. Out: an alignment, live verdicts, an assessment with advice.
`following` finds where in the score the player is, `matching` pairs hits with notes, `analysis` says what the pairs
show, `report` puts it into words and JSON. `align` is the final alignment.
Read `align`, then `analysis.summary`.
"""

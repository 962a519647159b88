"""Where the player is, which hit answers which note, what that shows and what to say: each answered once.

In: a `Score` and a `Performance`, or hits as they come. Out: an `Alignment`, live verdicts, an assessment with advice.
`following` finds the place in the score, `matching` pairs hits with notes, `analysis` says what the pairs show,
`report` puts it into words and JSON. `align` is the final alignment; docs/scoring.md has the formulas.
Read `align`, then `analysis.summary`.
"""

"""Battling drummers (thesis 4.5): repeat what the drummer plays, or trade improvised phrases; bar after bar, no gap.

In: rules, who plays, events of the engine, time. Out: cues, judgements, points, a document, a capture.
`ground` and `phrase` are what all rooms here share; `battle` is the state machine, `repeating` what is to be repeated
and how hard, `improvising` the drummer who listens and answers, `opponents` who they are, `judging` what an
improvisation is worth, `people` who plays against whom, `link` two stations on one network, `records` what is kept.
Read `phrase`, then `battle`.
"""

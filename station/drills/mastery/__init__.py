"""Mastery: what to practise next, and why, from how the last pass went.

In: the facts of a pass, the state of an item. Out: the next pass, its reason in words, the new state.
`pass_measures` has the facts, `rules` every number that a teacher can change, `next_pass` decides, one small module
each knows ladder, probes, reviews, plateaus, silent bars and fading feedback.
Read `next_pass` first, then `rules`.
"""

"""Mastery: what to practise next, and why, from how the last pass went.

In: the facts of a pass, the state of an item. Out: the next pass, its reason in words, the new state.
`rules` holds every number that a teacher can change, `policy` decides, one small module each knows ladder, probes,
reviews, plateaus, silent bars and fading feedback.
Read `policy` first, then `rules`.
"""

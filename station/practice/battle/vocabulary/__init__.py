"""What phrases are made of, and what every phrase must pass: bars of lessons, what they ask, limbs that can play them.

In: a ground, tags, strokes. Out: bars of the shipped lessons that fit, and scores whose limbs are written and whose
every stroke two hands and two feet can play. Read `lesson_bars` and `limbed`.
"""

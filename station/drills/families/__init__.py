"""Lessons that are made: families of drills, each lesson of a family by its level and a seed.

In: a family's name, a level 1–5, a seed and a number of bars. Out: the text of a lesson file, the same for the same
words, to be practised as it is or to be edited by a teacher. `family_table` is the door, `lesson_page` writes the text,
`phrases` has what the families share; each other file is one or two families.
Read `family_table` first.
"""

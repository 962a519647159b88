"""A day's plan: warm-up, what is due, what goes on or is new, what is kept, and playing at the end.

In: what is remembered of every lesson, what there is, what a teacher asks, the last days. Out: blocks with lesson,
bars, tempo, minutes, click and the reason of each. Its order is the agenda's (`drills.mastery.agenda`).
Read `daily_items` first, then `day_plan`.
"""

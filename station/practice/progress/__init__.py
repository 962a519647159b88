"""What may be said of practice over time: days and weeks, a streak, trends with their intervals, limbs and pieces.

In: a student's rows of the history. Out: frozen values in words and numbers, for a page, a command or a report.
Read `trends` first, which says what may be called better, then `trend_fit` with the formulas.
"""

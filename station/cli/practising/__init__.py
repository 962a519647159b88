"""What `practice` and `exam` do in a terminal: a live session, and the next block of the day's plan.

In: a plan, settings. Out: the session's outcome. First read `terminal`.
"""

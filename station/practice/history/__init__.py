"""The history as practice sees it: how sessions come into it, and what is read of it.

In: folders of sessions that are over, a student's rows. Out: kept sessions, what a page, a command or a report asks.
`session_choice` finds the session that a user's word means; `calendar_days`, `streaks`, `trends` and `overview` make
pages of rows: read `trends` first for what may be said of progress.
"""

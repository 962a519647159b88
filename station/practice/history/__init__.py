"""The history as practice sees it: how sessions come into it, and who asks it for what.

In: folders of sessions that are over, a user's words. Out: kept sessions, and the ones that are meant.
Read `student_history`, the one way to ask, then `session_intake`, the one way in; `session_choice` finds the session
that a user's word means.
"""

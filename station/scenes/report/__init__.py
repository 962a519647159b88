"""The facts of a page about one session, from its folder or its capture.

In: what a user calls a session. Out: `render.report.page.SessionPage`.
`session_place` finds the session, `kept_session` reads it, `page_facts` makes the facts.
"""

"""The facts of a page: of one session, of its take to see and hear, of a student's week for parents.

In: what a user calls a session, or a student and a week. Out: `render.report.page`'s and `render.report.take`'s values.
`session_place` finds the session and `kept_session` reads it; then `page_facts`, `take_media` or `week_facts`.
"""

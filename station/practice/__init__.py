"""Practice: a session laid out, played, judged and kept, with no window.

In: a lesson and what the student asks of it, events of the engine, time. Out: judgements, a report, a capture.
`session` is the practice session as a state machine and the loop that moves it on, `now` what tempo it is and where one
is, `control` what pads and pedals may command, `demonstration` the player of a lesson, `records` what is kept of a
session, `history` how it comes into the history and is found there, `progress` what that says over time, `own_data`
what a student takes away or deletes, `book` what is kept of a day, `exchange` what goes between teacher and student,
`exam` one take that is marked, `battle` the game.
Read `session.plan`, then `session.session`.
"""

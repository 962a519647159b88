"""What is practised and what sounds between: lessons, free takes, the demonstration, results.

In: actions, events of the engine, time. Out: snapshots, the state of a session, and what is kept of it.
`session_control` begins and ends, `current_practice` says what follows what, `lesson_session` is one session of a
lesson, `demo_player` the demonstration (by whom: `demo_drummer`; as it looks: `demo_picture`), `playback` what is
heard again.
Read `current_practice`, then `lesson_session`.
"""

"""A session: laid out before it starts, then moved on by events and time.

In: a lesson, options, what the engine says. Out: what sounds, judgements as they fall, the result.
`plan` lays the session out, `cues` what sounds, `session` is the state machine, `adaptation` lays out the next
pass, `runner` is the one loop that window, terminal and headless runs share, `event_log` what a capture remembers.
Read `plan`, then `session`, then `runner`.
"""

"""Sessions without a window: in the terminal, in real time, or with a virtual student faster than real time.

In: a runner, an engine, a clock. Out: lines on a terminal while it runs, and what is over.
`live` is the loop of the terminal, `live_text` its words and marks, `guarded_output` lets nothing that fails while it
is shown cost the session, `end_signals` ends it in order, `virtual_session` runs on a clock that is moved by hand.
Read `live` first.
"""

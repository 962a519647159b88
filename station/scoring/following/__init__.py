"""Where in the score the player is: one model of who goes through it, skips, repeats, stops and begins anywhere.

In: a score and hits in order. Out: a place in the score for each, live (`follower`, `online`) or for the whole take
(`warp`, `free_tempo`, `offline`, `free_run`), and how often a loop was played (`passes`). `prices` says what every step
costs, `tempo_tracker` keeps the clock, `beat_offsets` the offsets against it, `anchors` finds a place from nothing.
Read `prices`, then `offline`; `online` takes the same steps hit by hit.
"""

"""Where in the score the player is.

In: hits in order. Out: a place in the score for each, live (`follower`) or for the whole take (`warp`, `free_tempo`).
`chase` follows without a click, `click_chase` with one; `pursuit`, `locate`, `ways` and `shifts` find skips and
restarts. Read `follower`, then `warp`.
"""

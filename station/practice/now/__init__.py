"""What is going on now, one answer for all that show it: what tempo it is, and where one is.

In: a session, a player, a result. Out: `TempoNow` and `Whereabouts`, frozen, with the words that people read. Pictures,
films, the strip and the terminal show these and work out nothing themselves (docs/window.md has the table).
Read `tempo_now`, then `whereabouts`.
"""

"""The battle's page: what is chosen, the battle that runs, what came of it.

In: actions, events by way of the session that plays, time. Out: one frozen `BattleShown`, and what pads may choose.
`battle_page` owns it, `battle_shown` is what the window draws, `board_words` puts a battle into words, `battle_choice`
is for the pads, `friend_line` meets a friend on the network. Read `battle_shown` first.
"""

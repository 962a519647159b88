"""A battle on the screen: the page on which it is chosen, the board below the picture, the page of its result.

In: `BattleShown`, in words already. Out: actions. `battle_layer` puts them over the picture, one at a time.
Read `battle_layer` first.
"""

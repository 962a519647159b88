"""How hands and sticks keep out of each other's way.

In: both hands' parts. Out: the same parts on other ways, at other heights.
`both_hands` finds where sticks and arms come too near, `detours`, `tangles`, `giving_way` and `shoulders` undo it,
`clearance` says how high a stroke may go under an arm.
Read `both_hands` first.
"""

"""How hands, arms and sticks keep out of the way of each other, the body and the kit.

In: both hands' parts. Out: the same parts on other ways, at other heights, with elbows and sticks held otherwise.
`clearance` says how high a stroke may go under an arm, `cost` what is wrong at a moment, `moves` what a hand may do
differently, `optimise` does what takes most off the cost. Read `optimise` first.
"""

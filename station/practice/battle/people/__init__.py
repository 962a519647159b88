"""Who plays against whom: players and their devices, change-overs on one kit, and a handicap that makes it fair.

In: names and devices, earlier rounds. Out: whose stroke a stroke is, who plays when, what a player may expect of
themselves. Read `player`, then `handicap`.
"""

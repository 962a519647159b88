"""What an improvised turn is worth, openly: six components, each with its formula, its evidence and its weight.

In: a turn, the same player's earlier turns, the turn that it answers. Out: `ImprovisationMarks`; the best bar of many.
`improvisation_marks` says what comes out, `heard_turn` and `likeness` what all components stand on; then a module each.
`docs/battle-judging.md` explains the figures. Read `judged_improvisation` first.
"""

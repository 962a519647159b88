"""Who plays what: a limb for every note.

In: a score and a kit. Out: `Assignment`, and warnings where it is beyond a human.
`limbs` is the door, `feet` has the pedals, `hand_choice` and `hand_costs` our method, `smed_limbs` that of the thesis.
Read `limbs` first.
"""

"""Learns a kit from its owner, who strikes what is asked for.

In: the kit's bytes, keys, time. Out: what to ask next, and at last the likeliest preset with what differs on top.
`wizard_steps` is the table of what is asked, `wizard` the state machine, `infer` draws the conclusions; `one_hit` and
`velocity_learning` learn a single pad.
Read `wizard_steps`, then `wizard`.
"""

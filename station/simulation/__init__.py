"""Students made of numbers: they play a score as people do, and know what they did.

In: a score, a specification (`pro,seed=3,fault=late_kick:20`) or a learner's parameters. Out: a performance, its MIDI
bytes and its truth. `virtual_student` plays, `learner` also learns, tires and forgets.
`student_spec` lists what can be specified, `student_timing` and `student_slips` when and what goes wrong.
Read `virtual_student` first.
"""

"""The body between the strokes: twist, sway, head, gaze, breathing.

In: the beats of a score and a style. Out: keyframes of the trunk and of the head.
`beats` reads the score, `body_keys` makes the keyframes, `gaze` says where the drummer looks, `idle_motion` breathes,
`lean_to_reach` leans towards what is far.
Read `body_keys` first.
"""

"""The hand's strokes: heights, keyframes, contact, and the way from one drum to the next.

In: what one hand does, in order. Out: offsets of shoulder, elbow, wrist and stick over time.
`hand_events` lists what a hand does, `stroke_template` is the measured stroke, `stroke` its keyframes, `contact_pose`
how the arm lies when the stick touches, `travel` the way between, `grip` what is held and how.
Read `stroke`, then `hand`.
"""

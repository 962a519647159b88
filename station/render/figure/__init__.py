"""The drummer's body as triangles on bones.

In: a figure's measures and a pose. Out: a skin, and the frame of every bone.
`skeleton` has the bones, `garments` clothes, `face` the head, `hand_solid` a hand that holds a stick.
Read `body` first.
"""

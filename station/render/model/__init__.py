"""The drummer and the kit as the pictures show them, as one glTF model that moves: for viewers of others.

In: a drummer. Out: bytes of a .glb file. Plainer bones for animation programs are `motion.export`'s affair.
Read `drummer_model` first.
"""

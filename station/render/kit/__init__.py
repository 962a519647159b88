"""The drum kit, its stands and the room as triangles on bones.

In: `motion.kit`. Out: meshes, and a bone for every piece that moves.
Read `kit_rig` first.
"""

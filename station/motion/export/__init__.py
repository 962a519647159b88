"""The motion for other programs: BVH, glTF and NumPy files.

In: a drummer. Out: bytes of a file. A new format is a new module here and a line in `cli.animation`.
`joint_tree` is the drummer as a tree of rigid bones, `glb_file` the container of glTF.
Read `bvh` first.
"""

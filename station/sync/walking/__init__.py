"""A skeleton that walks: where its joints are, and when its feet come down.

In: a skeleton's file (ASF or BVH) and the joint angles of a trial. Out: positions in metres, footfalls in seconds.
The footfalls are the independent measure against which the phase is checked. Read `mocap_skeleton` first.
"""

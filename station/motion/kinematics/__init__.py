"""The figure and its joints: forward kinematics, arms and legs in closed form, limits, splines.

In: angles and targets, as floats or as arrays. Out: positions in metres, angles in radians.
`figure` has the measures of the body, `frame` all numbers of an instant, `arm` and `leg` solve a limb, `pose` is what
is drawn, `collisions` says what passes through what.
Read `figure` and `arm` first.
"""

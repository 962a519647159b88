"""What the sensor on a stick tells of its strokes, and which hand struck what.

In: a sensor's samples and how it is mounted (`core.imu`), the kit's hits. Out: `StickStroke`s, the limb of each hit,
the mounting itself from a gesture, remarks on how the sticks are used.
Read `stroke_detector` first; `stick_orientation` before it turns samples into the stick's motion, `hand_naming` after
it matches strokes with hits.
"""

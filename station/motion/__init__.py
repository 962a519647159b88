"""SMED, the drummer: a score, a kit, a figure and a style in, `pose(t)` out.

In: `music.Score`, a kit and a figure. Out: joint angles, stick tips, pedals and cymbals at any time.
From the ground up: `kit`, `kinematics`, `strokes`, `feasibility`, `sticking`, `avoidance`, `body`; then `motion_plan`
(what no slider changes), `keyframes` (what a style makes of it) and `drummer`. `audit` looks for what is impossible.
Read `drummer` first, then docs/motion.md.
"""

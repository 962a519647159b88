"""Simulated drumsticks with motion sensors: rigid bodies that strike, rebound and are held, measured with faults.

In: what is to be played. Out: samples as a sensor would measure them, with the truth beside them. Independent of the
drummer's motion and of what detects strokes. Read `stick_swing` first.
"""

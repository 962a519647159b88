"""What the sensors on the sticks tell: strokes, which hand struck, hits in the air, and the phase of a repeated motion.

In: samples of motion sensors (`core.imu`), hits, scores, motion-capture files. Out: strokes, hands, hits, phases, the
sounds that a phase triggers. Pure: no thread, clock, device or window. The only user of vqf.
Read `phase/periodic_model` for the paper's tracker, `strokes/stroke_detector` for the sticks.
"""

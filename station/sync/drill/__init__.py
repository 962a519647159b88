"""A drill as the model of the phase tracker: the drummer's own sticks, the student's against them.

In: the drummer of a section (`motion`), samples of the sensors on the student's sticks. Out: where in the section the
student is, how far each hand's strokes lie from it.
Read `stick_signals`, then `drummed_model` and `drill_tracker`.
"""

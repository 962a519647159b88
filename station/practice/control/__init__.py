"""What the kit itself may command: two kicks that start, pads that pause, a foot switch, a tapped tempo.

In: hits with their own times. Out: what is asked for. Nothing here knows a session's inside.
Read `pad_gestures` first.
"""

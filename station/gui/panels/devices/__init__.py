"""The panels of what is plugged in: the kit, pad by pad, and the sensors on the sticks.

`devices_panel` and `sticks_panel` are the panels; a `…_part` is a part of the first.
"""

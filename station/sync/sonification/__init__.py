"""Rhythmic sonification: a phase that passes a threshold triggers a sound; a channel moves a controller.

In: phases with their times. Out: hits, as a kit would send them, and controller values, for the engine, a MIDI file or
a film. Pure: no sound is made here. Read `triggers` first.
"""

"""Air drumming: hits from the motion of the sticks alone, where no pad is struck.

In: samples of the sticks' sensors, zones learnt in a minute. Out: hits of the device "air sticks", as of any kit. Pure.
`air_strokes` finds the beat that was meant, `air_zones` which piece by the stick's direction, `air_latency` how early a
hit can be told; `air_drums` puts them together. Read that first; docs/air-drumming.md has the figures.
"""

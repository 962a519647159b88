"""The sound card: streams, their clock, and the devices that are there.

In: a renderer that fills blocks. Out: sound, and when each block is heard on the monotonic clock.
`sound_output` opens a card, `card_stream` is what both ways have in common, `dac_clock` the delay-locked loop.
Read `sound_output` first.
"""

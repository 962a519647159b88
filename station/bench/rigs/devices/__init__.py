"""Kits, motion sensors and a JACK server that play by themselves, and what the engine hears of them.

In: times, rates and message counts. Out: bytes on a line or a port, when each was sent, and hostile bytes.
`playing_kit`, `imu_line` and `bare_reader` are programs of their own.
Read `playing_kit`, then `engine_hearing`.
"""

"""Kits as devices: transports that read bytes, decoders that understand them, captures that keep them.

In: bytes with their time from a MIDI port or a serial line. Out: `core.events` with session times.
`transport` is what every way in has in common, `device_ports` lists them, `decoders` understands all kits that are
heard; `mapping` says what a kit's notes mean, `wizard` learns it, `capture` keeps and replays.
Read `transport`, then `midi.midi_decoder`.
"""

"""MIDI: ports through rtmidi, the tokenizer, and bytes to events of the kit and back.

In: bytes as a driver gives them, with its own times. Out: packets with session times; hits, chokes and pedal moves.
`midi_ports` and `midi_clients` are the transport, `midi_tokens` and `midi_decoder` pure functions over bytes.
Read `midi_decoder` first.
"""

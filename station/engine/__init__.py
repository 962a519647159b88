"""The real-time part: reads devices, stamps, sounds, keeps the transport. Owns no window and renders nothing.

In: bytes of kits, commands, the sound card's clock. Out: events with session times, and blocks of sound.
`engine` is a plain object that is advanced; `engine_main` runs it in a process of its own, `engine_process` is that
process from outside, `supervisor` replaces one that died; `messages` is all that is said between them.
Read `messages`, then `engine`.
"""

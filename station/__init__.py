"""Drum station: a practice room for electronic drum kits.

Rooms from the ground up, each importing only from those before it: `core`; `music`; `scoring`, `motion`, `devices`,
`sound`; `drills`; `engine`, `render`, `simulation`; `practice`; `scenes`; `app`; `gui`; `bench`; `cli`.
Everything up to `drills`, and `simulation`, runs without hardware, window, thread or clock: data in, data out.
Read docs/architecture.md first: it follows a hit from its bytes to the report, and a lesson from its file to the
screen.
"""

"""What the window does, without the window: the state of the practice room and what changes it. No imgui.

In: actions of the user, events of the engine, time. Out: one frozen view a frame, for `gui` to draw, and what is kept
on disk. `controller` moves `station_parts` on; `settings` has what the user has set, and its one writer.
Read `controller` first, then `actions.action` (all that a user can do), `handlers.handler_table` (who does it) and
`window_state` (all that is seen).
"""

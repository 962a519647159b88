"""What a kit's notes and controllers mean, and which of its hits are no strokes.

In: a module's preset or the user's own TOML file. Out: a `DeviceMap`, and rules that a `TriggerFilter` applies.
`presets` has a table a module, `velocity_curve` and `hihat_pedal` say how pads and pedal count, `device_file` and
`device_writer` are the file.
Read `device_map` first.
"""

"""The window: wires engine, session and render together."""

"""Transports (bytes) and decoders (pure), kit presets and captures."""

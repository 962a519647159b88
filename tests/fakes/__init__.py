"""Fake devices at the byte level."""

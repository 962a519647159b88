"""Drum station: a practice room for electronic drum kits."""

"""Drum kits, the mixer, the click and the sound card's output."""

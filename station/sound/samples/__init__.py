"""Drum kits from recordings: folders of sound files and Hydrogen's drum kits; and the one door to every kit."""

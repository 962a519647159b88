"""Drum kits from recordings: folders of sound files and Hydrogen's drum kits; and the one door to every kit.

In: a name, a folder or a `.h2drumkit`. Out: a `DrumKit` at the card's rate.
`load_kit` is the door, `kit_folder` and `hydrogen_kit` the two kinds, `core.sound_naming` what a file's name means.
Read `load_kit` first.
"""

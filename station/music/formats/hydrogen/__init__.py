"""Hydrogen's songs (`.h2song`) and patterns (`.h2pattern`), both ways.

In: bytes of XML. Out: a `DrumPart`; and the way back, for Hydrogen 1.2 and later.
`song_contents` is what a file holds, `song_reader` reads it from XML and `song_writer` writes it, `song_to_part` and
`part_to_song` (with `instrument_strikes`) go between it and a part, `rock_kit` is the kit that written songs are for,
`hydrogen_formats` the door.
Read `song_contents` first.

Sources: Hydrogen (hydrogen-music/hydrogen: Song.cpp, Pattern.cpp, Note.cpp, Smf.cpp, AudioEngine.cpp, by their fields
and numbers alone; data/xsd/drumkit_pattern.xsd), and the MIDI that it exports (`tests/oracles`).
"""

"""GrooveScribe: a drum groove that is wholly in a link, and the MIDI files that GrooveScribe saves.

In: a link, or its query alone, or a MIDI file of GrooveScribe's. Out: a `DrumPart`; and a link of a part.
`groove_query` takes a link apart and puts one together, `groove_letters` says what each letter plays, `groove_reader`
and `groove_writer` (with `groove_nearest`) go between the letters and a part, `groove_midi` reads GrooveScribe's MIDI,
`groove_formats` is the door. Read `groove_query` first.

Sources: GrooveScribe (montulli/GrooveScribe: js/urlSerialization.js, noteArrays.js, musicMath.js, midiFile.js), and
what its own MIDI does (`tests/oracles`).
"""

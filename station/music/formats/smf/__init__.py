"""Standard MIDI Files: bytes to what a file holds, to drums, and back.

In: bytes. Out: `MidiFile` in the file's own ticks, then a `Score` or a `Performance`.
`standard_midi` is the door; `chunk_reader` and `track_events` read, `drum_channels` and `drum_tracks` find the drums,
`track_writer` and `track_bytes` write.
Read `standard_midi` first.
"""

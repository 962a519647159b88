"""When each stroke of a take is meant: tempo, meter, beat, swing and cells."""

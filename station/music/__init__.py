"""Written and played music as immutable values: Score, TempoMap, Performance, Judgement."""

"""Written and played music as immutable values: Score, TempoMap, Performance, Judgement.

In: files of music (`formats`), or whoever writes or plays. Out: tables of numbers that everything above reads.
Score time is integer ticks, session time integer nanoseconds; `tempo` converts.
Read `score`, then `performance`.
"""

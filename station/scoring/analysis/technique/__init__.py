"""What hands and feet do beyond the single stroke: rolls, ornaments, feel, the inner clock, dynamics.

In: a score, a performance and their alignment. Out: figures with their intervals, or None and why the kit or the data
cannot tell. `technique` gathers all, `estimates` are figures with intervals.
Read `technique` first.
"""

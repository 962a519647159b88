"""What hands and feet do beyond the single stroke: rolls, ornaments, feel, the inner clock, shades of loudness.

Each module looks at a score, a performance and their alignment and tells figures with their intervals, or None and why
the kit or the data cannot tell. `craft.craft` gathers all.
"""

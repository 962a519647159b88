"""Hostile assignments, returns and notes by the million.

In: how many, from which seed. Out: a table of what was read and refused, each input that did harm, the slowest, memory.
`hostile_parcels` makes them, `fuzz_parcels` throws them.
Read `fuzz_parcels` first.
"""

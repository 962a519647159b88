"""TOML that people write: what a table may hold, where in the text each value stands, and every fault with its place.

In: the text of a file and what is expected of it. Out: plain values, and all faults at once with line and column.
`toml_source` reads a text with its places, `schema` checks a table against fields, `toml_write` writes values back.
Read `toml_source`, then `schema`.
"""

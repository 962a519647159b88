"""The words of the drum station: pieces, hits, time, errors, settings, files. Imports nothing of ours.

In: plain values and files. Out: small immutable values that every other package speaks in.
`pieces` and `events` are what is struck, `units` and `clock` time, `errors` whose fault it is, `toml` what a TOML
table may hold, `disk` how files are read and kept, `settings` and `measured_latency` what is kept of a user.
Read `pieces` and `events` first.
"""

"""The benchmarks of `station bench`: how fast and exact the station is on this computer.

In: what lies below, and the window as a separate program. Out: rows of a table, each beside its target or a peer.
`harness` runs them, `rigs` are the kits, servers and simulated work that they need, `rows` what is measured.
Read `harness.benchmark` first.
"""

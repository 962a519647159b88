"""Runs benchmarks one after the other, each group in a process of its own, and prints what they measured.

In: a package whose modules have a table `BENCHMARKS`. Out: a table for people, or one JSON document.
`benchmark` says what a benchmark is, `registry` finds them, `run` runs them by `child`.
Read `benchmark` first.
"""

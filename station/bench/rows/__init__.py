"""What is measured: a module an area, each with a tuple `BENCHMARKS` of rows.

In: the station's own functions and the rigs. Out: a value, its unit, the target, and a peer's value in the same run.
To add a row, add a `Benchmark` to the table of its area; `station bench` finds it by itself.
Read `scoring_rows` for an example.
"""

"""Latency measured: signals and stamps in, estimates with their intervals out; no device is touched here.

In: recordings and times of blocks, or taps. Out: a `LatencyEstimate`, and why it should not be trusted.
`loopback`, `strikes` and `taps` are the ways to measure.
Read `latency_estimate` first.
"""

"""Benchmarks that go well and badly, for the runner's tests."""

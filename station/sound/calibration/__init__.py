"""Latency measured: signals and stamps in, estimates with their intervals out; no device is touched here."""

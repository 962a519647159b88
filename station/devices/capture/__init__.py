"""Captures: every byte of every device with its time, in one file that checks itself.

In: packets as they come. Out: a file that survives a crash, and the same events to the nanosecond when it is replayed.
`capture` is the format, `capture_writer` writes it in a thread, `replay` plays it through the decoders.
Read the head of `capture` first.
"""

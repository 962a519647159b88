"""What `station devices` does line by line: monitoring, learning a kit or a pad, calibrating, setting a stick up.

In: options of the command, hits and keys. Out: lines on the terminal, and the user's own files.
Read `devices_monitor`, then `devices_learn`.
"""

"""Files: read whole or not at all, written whole or not at all, shipped with the program.

In: paths and bytes. Out: bytes and text, or a `BadInput` or `DeviceError` that names the file.
Read `files` first.
"""

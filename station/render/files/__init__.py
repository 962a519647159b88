"""Pictures as files: PNG, PDF, GIF and MP4.

In: pixels, planes or polygons. Out: bytes on disk, whole or not at all.
"""

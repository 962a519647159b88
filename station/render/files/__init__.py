"""Pictures as files: PNG, PDF, GIF and MP4; and SVG for pages.

In: pixels, planes or polygons. Out: bytes on disk, whole or not at all.
"""

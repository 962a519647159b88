"""A small PNG writer: 8 bits a channel, RGB, one zlib stream.

Source: Portable Network Graphics (Second Edition), W3C 2003, sections 5, 9 and 11. Each row takes the "up" filter,
which suits pictures with smooth gradients and needs one numpy subtraction.
"""

import struct
import zlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.disk.files import write_whole

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_RGB = 2
_FILTER_UP = 2


def png_bytes(picture: NDArray[np.uint8]) -> bytes:
    """The PNG file of `picture`, shape (height, width, 3), top row first."""
    height, width, channels = picture.shape
    assert channels == 3, "the writer knows RGB alone"
    rows = np.empty((height, 1 + 3 * width), np.uint8)
    rows[:, 0] = _FILTER_UP
    flat = np.ascontiguousarray(picture).reshape(height, -1)
    rows[0, 1:] = flat[0]
    rows[1:, 1:] = flat[1:] - flat[:-1]
    header = struct.pack(">IIBBBBB", width, height, 8, _RGB, 0, 0, 0)
    return b"".join(
        [_SIGNATURE, _chunk(b"IHDR", header), _chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)), _chunk(b"IEND", b"")]
    )


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_png(picture: NDArray[np.uint8], path: Path) -> None:
    """Write `picture`, shape (height, width, 3), to `path` whole or not at all; raises `DeviceError`."""
    write_whole(path, png_bytes(picture))

"""The PNG writer against the specification: chunks with their CRCs, filters undone by hand."""

import struct
import zlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.render.files.png_file import png_bytes, write_png


def decode(data: bytes) -> NDArray[np.uint8]:
    """A reader of its own, for filters 0 and 2 (PNG specification, section 9.2)."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed, width, height = 8, b"", 0, 0
    while at < len(data):
        (length,), kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        body = data[at + 8 : at + 8 + length]
        (crc,) = struct.unpack(">I", data[at + 8 + length : at + 12 + length])
        assert crc == zlib.crc32(kind + body)
        if kind == b"IHDR":
            width, height, depth, colour, *rest = struct.unpack(">IIBBBBB", body)
            assert (depth, colour, rest) == (8, 2, [0, 0, 0])
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    rows = zlib.decompress(packed)
    above = [0] * (3 * width)
    out: list[list[int]] = []
    for y in range(height):
        row = rows[y * (1 + 3 * width) : (y + 1) * (1 + 3 * width)]
        assert row[0] in {0, 2}
        above = [(v + (a if row[0] == 2 else 0)) % 256 for v, a in zip(row[1:], above, strict=True)]
        out.append(above)
    return np.array(out, np.uint8).reshape(height, width, 3)


def test_what_is_written_is_read(tmp_path: Path) -> None:
    picture = np.random.default_rng(1).integers(0, 256, (7, 5, 3), np.uint8)
    write_png(picture, tmp_path / "a" / "b.png")
    assert np.array_equal(decode((tmp_path / "a" / "b.png").read_bytes()), picture)


def test_one_pixel() -> None:
    assert decode(png_bytes(np.array([[[1, 2, 255]]], np.uint8))).tolist() == [[[1, 2, 255]]]

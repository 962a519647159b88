"""Pages of filled areas as a PDF file: vectors, so that a printer draws them as finely as it can.

Source: ISO 32000-1 (PDF 1.7), sections 7 (syntax, file structure) and 8 (paths). Nothing in it depends on the day.
"""

import zlib
from collections.abc import Iterable, Sequence

from station.render.text.paper import Filled

_HEAD = b"%PDF-1.7\n%\xe2\xe3\xcf\xd3\n"
"""Bytes beyond ASCII in the second line, so that whoever carries the file takes it for binary."""


def pdf(pages: Sequence[Iterable[Filled]], size: tuple[float, float], title: str, author: str) -> bytes:
    """A file of `pages`, each `size` (width, height) points."""
    kids = " ".join(f"{4 + 2 * k} 0 R" for k in range(len(pages)))
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        f"<< /Type /Pages /Kids [{kids}] /Count {len(pages)} >>".encode(),
        f"<< /Title {_text(title)} /Author {_text(author)} /Producer (drum station) >>".encode(),
    ]
    for k, page in enumerate(pages):
        box = f"[0 0 {size[0]:g} {size[1]:g}]"
        objects.append(
            f"<< /Type /Page /Parent 2 0 R /MediaBox {box} /Resources << >> /Contents {5 + 2 * k} 0 R >>".encode()
        )
        objects.append(_stream(page, size[1]))
    return _file(objects)


def _text(text: str) -> str:
    return f"<{(chr(0xFEFF) + text).encode('utf-16-be', 'replace').hex()}>"  # a file's name may be no text


def _stream(page: Iterable[Filled], height: float) -> bytes:
    """The areas as paths; PDF counts y from the bottom."""
    words = [f"1 0 0 -1 0 {height:g} cm"]
    grey = None
    for area in page:
        if area.grey != grey:
            grey = area.grey
            words.append(f"{grey:.3g} g")
        for contour in area.contours:
            points = [f"{x:.2f} {y:.2f}" for x, y in contour.tolist()]
            words.append(f"{points[0]} m {' '.join(point + ' l' for point in points[1:])} h")
        words.append("f")
    data = zlib.compress("\n".join(words).encode(), 9)
    return f"<< /Length {len(data)} /Filter /FlateDecode >>\nstream\n".encode() + data + b"\nendstream"


def _file(objects: Sequence[bytes]) -> bytes:
    """The objects, numbered from 1, with the table that says where each lies."""
    out, places = bytearray(_HEAD), []
    for number, body in enumerate(objects, 1):
        places.append(len(out))
        out += f"{number} 0 obj\n".encode() + body + b"\nendobj\n"
    table = len(out)
    rows = "".join(f"{place:010d} 00000 n \n" for place in places)
    out += f"xref\n0 {len(objects) + 1}\n0000000000 65535 f \n{rows}".encode()
    out += f"trailer\n<< /Size {len(objects) + 1} /Root 1 0 R /Info 3 0 R >>\nstartxref\n{table}\n%%EOF\n".encode()
    return bytes(out)

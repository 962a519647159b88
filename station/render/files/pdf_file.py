"""Pages of ink as a PDF file: vectors, so that a printer draws them as finely as it can.

Each outline stands in the file once, as a form that pages paint in many places; upright boxes are rectangles. Of black
ink the darker is painted over the lighter; colours are those of the day, painted in order. Source: ISO 32000-1 (PDF
1.7), sections 7 (syntax, file structure), 8.5 (paths), 8.6.4.4 (colours) and 8.10 (form XObjects). Nothing in it
depends on the day.
"""

import zlib
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from station.render.palette import paper_bytes
from station.render.text.paper import SQUARE, Ink, Points

_HEAD = b"%PDF-1.7\n%\xe2\xe3\xcf\xd3\n"
"""Bytes beyond ASCII in the second line, so that whoever carries the file takes it for binary."""
_FIRST_PAGE = 4
"""The objects before the pages: catalogue, list of pages, title, forms by name."""
_BOX, _FORM = "%.2f %.2f %.2f %.2f re", "q %.4g %.4g %.4g %.4g %.2f %.2f cm /F%d Do Q"
_DENSITY = 6
"""zlib's usual level: the highest takes four times as long for a hundredth less."""


def pdf(pages: Sequence[Ink], size: tuple[float, float], title: str, author: str, has_colours: bool = False) -> bytes:
    """A file of `pages`, each `size` (width, height) points, their ink of one atlas: black, unless it `has_colours`."""
    used = np.unique(np.concatenate([page.numbers for page in pages])).tolist()
    forms = [number for number in used if number != SQUARE] + [number for number in used if number == SQUARE]
    first_form = _FIRST_PAGE + 2 * len(pages) + 1
    kids = " ".join(f"{_FIRST_PAGE + 1 + 2 * k} 0 R" for k in range(len(pages)))
    names = " ".join(f"/F{number} {first_form + k} 0 R" for k, number in enumerate(forms))
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        f"<< /Type /Pages /Kids [{kids}] /Count {len(pages)} >>".encode(),
        f"<< /Title {_text(title)} /Author {_text(author)} /Producer (drum station) >>".encode(),
        f"<< /XObject << {names} >> >>".encode(),
    ]
    for k, page in enumerate(pages):
        box, content = f"[0 0 {size[0]:g} {size[1]:g}]", _FIRST_PAGE + 2 + 2 * k
        words = f"<< /Type /Page /Parent 2 0 R /MediaBox {box} /Resources 4 0 R /Contents {content} 0 R >>"
        objects += [words.encode(), _stream(_content(page, size[1], has_colours))]
    objects += [_form(pages[0].outlines[number]) for number in forms]
    return _file(objects)


def _text(text: str) -> str:
    return f"<{(chr(0xFEFF) + text).encode('utf-16-be', 'replace').hex()}>"  # a file's name may be no text


def _content(page: Ink, height: float, has_colours: bool) -> str:
    """What paints a page; PDF counts y from the bottom."""
    paints = _in_colours(page) if has_colours else _in_greys(page)
    words = [f"1 0 0 -1 0 {height:g} cm"]
    for colour, rows in paints:
        words.append(colour)
        is_box = rows & (page.numbers == SQUARE) & _is_upright(page.matrices)
        if is_box.any():
            words += [_boxes(page.matrices[is_box]), "f"]
        if (is_form := rows & ~is_box).any():
            words.append(_lines(_FORM, np.column_stack([page.matrices[is_form], page.numbers[is_form]])))
    return "\n".join(words)


def _in_greys(page: Ink) -> Iterator[tuple[str, NDArray[np.bool_]]]:
    """The greys of a page from the lightest to the darkest, each with its areas (n,)."""
    greys = page.greys
    for grey in np.unique(greys)[::-1].tolist():
        yield f"{grey:.3g} g", greys == grey


def _in_colours(page: Ink) -> Iterator[tuple[str, NDArray[np.bool_]]]:
    """The colours of a page in order, each with the areas (n,) that follow each other in it; boxes go before forms."""
    colours = paper_bytes(page.rgba)
    is_box = (page.numbers == SQUARE) & _is_upright(page.matrices)
    changes = np.flatnonzero((np.diff(colours.astype(np.int64), axis=0) != 0).any(axis=1) | (np.diff(is_box) > 0)) + 1
    for start, end in pairwise([0, *changes.tolist(), len(page)]):
        rows = np.zeros(len(page), np.bool_)
        rows[start:end] = True
        yield f"{' '.join(f'{value / 255:.3g}' for value in colours[start].tolist())} rg", rows


def _is_upright(matrices: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which squares, shape (n,), become upright boxes: they are turned by no angle or by a right one."""
    return np.asarray((matrices[:, [1, 2]] == 0).all(axis=1) | (matrices[:, [0, 3]] == 0).all(axis=1))


def _boxes(matrices: NDArray[np.float64]) -> str:
    half = np.abs(matrices[:, :2]) + np.abs(matrices[:, 2:4])
    return _lines(_BOX, np.column_stack([matrices[:, 4:] - half, 2 * half]))


def _lines(words: str, values: NDArray[np.float64]) -> str:
    """A line of `words` for each row of `values`."""
    return "\n".join([words] * len(values)) % tuple(values.ravel().tolist())


def _form(contours: Sequence[Points]) -> bytes:
    """An outline that pages paint by its name."""
    points = np.concatenate(contours)
    (left, low), (right, high) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    words = []
    for contour in contours:
        corners = [f"{x:.4f} {y:.4f}" for x, y in contour.tolist()]
        words.append(f"{corners[0]} m {' '.join(corner + ' l' for corner in corners[1:])} h")
    box = f"[{left - 0.01:.3f} {low - 0.01:.3f} {right + 0.01:.3f} {high + 0.01:.3f}]"
    return _stream("\n".join([*words, "f"]), f"/Type /XObject /Subtype /Form /BBox {box} ")


def _stream(content: str, entries: str = "") -> bytes:
    data = zlib.compress(content.encode(), _DENSITY)
    return f"<< {entries}/Length {len(data)} /Filter /FlateDecode >>\nstream\n".encode() + data + b"\nendstream"


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

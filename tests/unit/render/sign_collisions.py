"""Counts where signs of an engraved score lie on one another: outlines filled on a fine grid, pair by pair."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from station.music.score import Score
from station.render.notation.engraving import Engraver
from station.render.notation.page.line_breaks import lines
from station.render.notation.page.sheet_bars import sheet_bars
from station.render.notation.page.sheet_line import LineSetter
from station.render.text.paper import SQUARE, Filled, OutlineAtlas
from station.render.text.sign_outlines import BEAM, SIGNS, STEM

A_LINE = 102.8
"""Staff spaces: 180 mm between the margins of A4, in a staff of 7 mm."""
_CELL = 0.04
"""Of a staff space: how fine the grid is."""
_TOUCH = 3
"""Cells that two signs may share: an edge that they touch in."""
_CLASSES = {
    "head": "head",
    "rest": "rest",
    "flag": "flag",
    "bracket": "bracket",
    "accent": "mark",
    "hat": "mark",
    "choke": "mark",
    "buzz": "mark",
    "tremolo": "mark",
    "tuplet": "number",
    "meter": "number",
    "loud": "loudness",
    "dot": "dot",
    "beat": "word",
}
_TEXT_CLASS = "letter"


@dataclass(frozen=True, slots=True, eq=False)
class Inked:
    """One sign: what kind it is, and its outlines in staff spaces from its line's left end."""

    kind: str
    name: str
    contours: tuple[NDArray[np.float64], ...]

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom."""
        points = np.concatenate(self.contours)
        (left, top), (right, bottom) = points.min(axis=0), points.max(axis=0)
        return float(left), float(top), float(right), float(bottom)


def inked_lines(score: Score, width: float = A_LINE) -> Iterator[list[Inked]]:
    """The signs of each line of the score on paper, with its numbers and bar lines."""
    atlas, names = _letters()
    bars = sheet_bars(score, {})
    setter = LineSetter(Engraver(score, atlas, as_written=True), bars, {}, atlas)
    set_bars = setter.set_bars()
    for boxes in lines(set_bars, width):
        ink = setter.line(boxes, set_bars, 0.0, 1.0).ink
        yield [
            sign for number, area in zip(ink.numbers.tolist(), ink, strict=True) if (sign := _sign(number, area, names))
        ]


@cache
def _letters() -> tuple[OutlineAtlas, dict[int, str]]:
    """The outlines, and the signs' names by the numbers of theirs."""
    atlas = OutlineAtlas()
    return atlas, {round(atlas.sign(name).uv[0]): name for name in SIGNS}


def _sign(number: int, area: Filled, names: dict[int, str]) -> Inked | None:
    """A sign with its class; None for stems, staff and ledger lines, ties, slurs, hairpins, slashes."""
    if number in names:
        kind = _CLASSES.get(names[number].split("_")[0])
        return Inked(kind, names[number], area.contours) if kind else None
    if number > SQUARE + 2:
        return Inked(_TEXT_CLASS, "", area.contours)
    wide, high = np.ptp(area.contours[0], axis=0).tolist()
    if number == SQUARE and high == pytest.approx(BEAM, abs=0.01) and wide > BEAM:
        return Inked("beam", "", area.contours)
    is_line = number == SQUARE and high == pytest.approx(4.0, abs=0.01) and wide > STEM + 0.01
    return Inked("bar line", "", area.contours) if is_line else None


def collisions(score: Score, width: float = A_LINE) -> Counter[tuple[str, str]]:
    """How often signs of two kinds lie on one another, over all lines of the score."""
    found: Counter[tuple[str, str]] = Counter()
    for line in inked_lines(score, width):
        for a, b in overlapping(line):
            found[min(a.kind, b.kind), max(a.kind, b.kind)] += 1
    return found


def overlapping(line: list[Inked]) -> Iterator[tuple[Inked, Inked]]:
    """Pairs that share ink; beams of one group do not count, which meet at a stem."""
    boxes = np.array([sign.box for sign in line])
    order = np.argsort(boxes[:, 0])
    for rank, i in enumerate(order):
        for j in order[rank + 1 :]:
            if boxes[j, 0] > boxes[i, 2]:
                break
            are_beams = line[i].kind == line[j].kind == "beam"
            meet = boxes[i, 1] < boxes[j, 3] and boxes[j, 1] < boxes[i, 3]
            if meet and not are_beams and _share_ink(line[i], line[j]):
                yield line[i], line[j]


def _share_ink(a: Inked, b: Inked) -> bool:
    """Whether cells of both are inked."""
    (l1, t1, r1, b1), (l2, t2, r2, b2) = a.box, b.box
    xs = np.arange(max(l1, l2) + _CELL / 2, min(r1, r2), _CELL)
    ys = np.arange(max(t1, t2) + _CELL / 2, min(b1, b2), _CELL)
    if not len(xs) or not len(ys):
        return False
    x, y = (grid.ravel() for grid in np.meshgrid(xs, ys))
    return int((_inside(a, x, y) & _inside(b, x, y)).sum()) > _TOUCH


def _inside(sign: Inked, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.bool_]:
    """By the non-zero rule: how often the outlines run round each point."""
    winding = np.zeros(len(x), np.int64)
    for contour in sign.contours:
        for (x0, y0), (x1, y1) in zip(contour, np.roll(contour, -1, axis=0), strict=True):
            if y0 != y1:
                rises = (y0 <= y) & (y1 > y)
                falls = (y1 <= y) & (y0 > y)
                right = x0 + (y - y0) / (y1 - y0) * (x1 - x0) > x
                winding += (rises & right).astype(np.int64) - (falls & right).astype(np.int64)
    return np.asarray(winding != 0)

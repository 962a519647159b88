"""What a plot of strokes looks like, in the window and on a result's page alike: its axis, its lines, a mark a stroke.

Asynchrony is played − written in ms, negative is early. Up is late, for later means more; strokes farther out than
`REACH_MS` stand on that edge, and what has no time of its own stands below the strokes.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from station.music.judgement import Label
from station.render.palette import EARLY, EXTRA, GOOD, INK_SOFT, LATE, MISSED, WRONG, with_opacity
from station.render.text.draw_list import Colour

REACH_MS = 80.0
"""Our choice."""
LINES = {-60.0: "60 early", -30.0: "30 early", 0.0: "0 ms", 30.0: "30 late", 60.0: "60 late"}
"""Where lines lie, in ms, and what they are called."""
_MISSED_MS, _NOT_WRITTEN_MS = -92.0, -107.0
AXIS_MS = (-116.0, 90.0)
"""The lower and the upper end of the axis."""


class StrokeMark(Enum):
    """A shape that stands for a stroke."""

    DISC = "disc"
    UP = "up"
    DOWN = "down"
    SQUARE = "square"
    BARRED_RING = "barred ring"
    CROSS = "cross"
    RING = "ring"


@dataclass(frozen=True, slots=True)
class StrokeKind:
    """Strokes that look alike: `radius` is their circle's in dots' radii, `at_ms` their place if they have no time."""

    name: str
    mark: StrokeMark
    colour: Colour
    radius: float = 1.0
    at_ms: float | None = None


KINDS = (
    StrokeKind("on time", StrokeMark.DISC, with_opacity(GOOD, 0.9)),
    StrokeKind("early", StrokeMark.DOWN, EARLY, 1.25),
    StrokeKind("late", StrokeMark.UP, LATE, 1.25),
    StrokeKind("wrong pad", StrokeMark.SQUARE, WRONG, 1.4),
    StrokeKind("missed", StrokeMark.BARRED_RING, MISSED, at_ms=_MISSED_MS),
    StrokeKind("not written", StrokeMark.CROSS, EXTRA, 1.2, at_ms=_NOT_WRITTEN_MS),
    StrokeKind("unknown", StrokeMark.RING, INK_SOFT, at_ms=_MISSED_MS),
)
_ON_TIME, _EARLY, _LATE, _WRONG, _MISSED, _NOT_WRITTEN, _UNKNOWN = range(len(KINDS))


def by_kind(
    label: NDArray[np.uint8], asynchrony_ms: NDArray[np.float64], on_time_ms: float
) -> Iterator[tuple[StrokeKind, NDArray[np.intp]]]:
    """The kinds that occur, with the rows of each; `label` of `Label` and `asynchrony_ms` are (n,)."""
    timed = np.select([asynchrony_ms < -on_time_ms, asynchrony_ms > on_time_ms], [_EARLY, _LATE], _ON_TIME)
    untimed = [label == Label.WRONG_PIECE, label == Label.MISS, label == Label.EXTRA]
    untimed += [label == Label.UNKNOWN]
    kind_of = np.select(untimed, [_WRONG, _MISSED, _NOT_WRITTEN, _UNKNOWN], timed)
    for index, kind in enumerate(KINDS):
        rows = np.flatnonzero(kind_of == index)
        if len(rows):
            yield kind, rows


def heights_ms(label: NDArray[np.uint8], asynchrony_ms: NDArray[np.float64]) -> NDArray[np.float64]:
    """Where each stroke stands on the axis, (n,); NaN where a right stroke's time is not told."""
    reached = np.clip(asynchrony_ms, -REACH_MS, REACH_MS)
    unplayed = (label == Label.MISS) | (label == Label.UNKNOWN)
    return np.select([unplayed, label == Label.EXTRA], [_MISSED_MS, _NOT_WRITTEN_MS], reached)


def line_words(letter_ms: float) -> list[str]:
    """What each of `LINES` is called, "" for every second where a letter is higher than they are apart."""
    return ["" if ms % 60 and letter_ms > 30 else words for ms, words in LINES.items()]

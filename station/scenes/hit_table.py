"""Every stroke of a result by its place in the lesson: what the plot beside the page shows, and finds under the mouse.

All passes lie over each other, so that a place that is always late is seen as one. Asynchrony is played − written in
ms, negative is early; misses and strokes that answer no note have none. Bars, beats and passes count from 1.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.labels import piece_name
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.music.judgement import Label
from station.practice.session.lesson_places import PLACE_DTYPE, places_of, ticks_of_hits
from station.practice.session.session import SessionResult
from station.render.snapshot import ON_TIME_MS

DOT_DTYPE = np.dtype(
    [
        *PLACE_DTYPE.descr,
        ("late_ms", np.float64),  # NaN where there is none
        ("piece", np.uint8),
        ("label", np.uint8),
    ]
)


@dataclass(frozen=True, eq=False)
class EveryHit:
    """`dots` (n,) of `DOT_DTYPE`: the notes in the score's order, then the strokes that answer none.

    So far from its note a stroke is on time as `on_time_ms` says.
    """

    dots: NDArray[np.void]
    on_time_ms: float = ON_TIME_MS

    @property
    def bars(self) -> tuple[int, int]:
        """The first and last bar of the lesson that have dots, from 1."""
        return int(self.dots["bar"].min()), int(self.dots["bar"].max())

    @property
    def pieces(self) -> list[Piece]:
        """The pieces that have dots, in their order."""
        return [Piece(int(piece)) for piece in np.unique(self.dots["piece"])]

    def of(self, piece: Piece | None) -> NDArray[np.void]:
        """The dots of one piece, of all for None."""
        return self.dots if piece is None else self.dots[self.dots["piece"] == piece]


def every_hit(result: SessionResult) -> EveryHit:
    """The dots of a session's result."""
    score, alignment = result.score, result.alignment
    extra = alignment.hit_label == Label.EXTRA
    notes = _dots(result, score.notes["tick"])
    notes["piece"], notes["label"] = score.notes["piece"], alignment.note_label
    played = np.isin(alignment.note_label, (Label.MATCH, Label.WRONG_PIECE))
    notes["late_ms"] = np.where(played, alignment.asynchrony_ns / NS_PER_MS, np.nan)
    strokes = _dots(result, ticks_of_hits(result, result.performance.hits["at_ns"][extra]))
    strokes["piece"], strokes["label"] = result.performance.hits["piece"][extra], Label.EXTRA
    strokes["late_ms"] = np.nan
    return EveryHit(np.concatenate([notes, strokes]), result.plan.level.windows.on_time_ms)


def _dots(result: SessionResult, ticks: NDArray[np.int64]) -> NDArray[np.void]:
    """Dots at `ticks` of the score, with their places alone."""
    dots, places = np.zeros(len(ticks), DOT_DTYPE), places_of(result, ticks)
    for name in PLACE_DTYPE.fields or ():
        dots[name] = places[name]
    return dots


def nearest(at: NDArray[np.float64], point: tuple[float, float], within: float) -> int | None:
    """The row of `at` (n, 2), in pixels, that is nearest to `point`; None where none is `within` so many."""
    if not len(at):
        return None
    away = np.hypot(*(at - np.asarray(point)).T)
    index = int(np.argmin(away))
    return index if away[index] <= within else None


def dot_label(dot: np.void, on_time_ms: float) -> str:
    """The words for a dot: bar, beat, piece, whether it was on time, ms, pass."""
    return f"Bar {dot['bar']}, {beat_label(dot, on_time_ms)} (pass {dot['pass']})"


def beat_label(dot: np.void, on_time_ms: float) -> str:
    """The words for a dot within its bar: beat, piece, whether it was on time, ms."""
    name = piece_name(Piece(int(dot["piece"])))
    return f"beat {round(float(dot['beat']), 2):g}, {name}: {_judged(dot, on_time_ms)}"


def _judged(dot: np.void, on_time_ms: float) -> str:
    label, late_ms = Label(int(dot["label"])), float(dot["late_ms"])
    if label is Label.MISS:
        return "missed"
    if label is Label.EXTRA:
        return "not written"
    if label is Label.UNKNOWN:
        return "unknown, for nothing could be heard"
    off = f"{abs(late_ms):.0f} ms {'late' if late_ms > 0 else 'early'}"
    when = off if abs(late_ms) > on_time_ms else f"on time ({off})" if round(late_ms) else "on time"
    return f"{when}, on a wrong pad" if label is Label.WRONG_PIECE else when

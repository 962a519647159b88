"""Every stroke of a result by its place in the lesson: what the plot beside the page shows, and finds under the mouse.

All passes lie over each other, so that a place that is always late is seen as one. Asynchrony is played − written in
ms, negative is early; misses and strokes that answer no note have none. Bars, beats and passes count from 1.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.names import piece_name
from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.music.judgement import Label
from station.practice.adaptation import lesson_bars
from station.practice.session import SessionResult

DOT_DTYPE = np.dtype(
    [
        ("place", np.float64),  # the lesson's bar from 1, and how much of it is over
        ("late_ms", np.float64),  # NaN where there is none
        ("beat", np.float64),
        ("bar", np.int32),  # of the lesson
        ("row_bar", np.int32),  # of the result's score, from 0
        ("pass", np.int32),
        ("piece", np.uint8),
        ("label", np.uint8),
    ]
)


@dataclass(frozen=True, eq=False)
class EveryHit:
    """`dots` (n,) of `DOT_DTYPE`: the notes in the score's order, then the strokes that answer none."""

    dots: NDArray[np.void]

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
    at_ns = np.clip(result.performance.hits["at_ns"][extra], 0, max(score.length_ns - 1, 0))
    strokes = _dots(result, score.tempo_map.ticks_at(at_ns / NS_PER_S).astype(np.int64))
    strokes["piece"], strokes["label"] = result.performance.hits["piece"][extra], Label.EXTRA
    strokes["late_ms"] = np.nan
    return EveryHit(np.concatenate([notes, strokes]))


def _dots(result: SessionResult, ticks: NDArray[np.int64]) -> NDArray[np.void]:
    """Dots at `ticks` of the score, with their places alone."""
    dots = np.zeros(len(ticks), DOT_DTYPE)
    if not len(ticks):
        return dots
    tempo_map, plan = result.score.tempo_map, result.plan
    names = np.asarray(lesson_bars(plan))
    row = np.minimum(tempo_map.bars_at(ticks), len(names) - 1)
    starts = np.asarray([tempo_map.bar_start(int(bar)) for bar in range(int(row.max()) + 2)])
    lengths = np.diff(starts)[row]
    within = np.minimum((ticks - starts[row]) / lengths, 1.0)
    beats = np.asarray([tempo_map.meter_at(int(start)).beats for start in starts[:-1]])[row]
    dots["row_bar"], dots["bar"], dots["beat"] = row, names[row] + 1, within * beats + 1
    dots["place"] = dots["bar"] + within
    if plan.rounds is not None:
        dots["pass"] = np.searchsorted(np.asarray(plan.rounds.starts), row, "right")
    else:
        dots["pass"] = row // plan.section.bar_count + 1
    return dots


def nearest(at: NDArray[np.float64], point: tuple[float, float], within: float) -> int | None:
    """The row of `at` (n, 2), in pixels, that is nearest to `point`; None where none is `within` so many."""
    if not len(at):
        return None
    away = np.hypot(*(at - np.asarray(point)).T)
    index = int(np.argmin(away))
    return index if away[index] <= within else None


def words_of(dot: np.void) -> str:
    """What is told of a dot: bar, beat, piece, ms, pass."""
    where = f"Bar {dot['bar']}, beat {round(float(dot['beat']), 2):g}, {piece_name(Piece(int(dot['piece'])))}"
    return f"{where}: {_judged(dot)} (pass {dot['pass']})"


def _judged(dot: np.void) -> str:
    label, late_ms = Label(int(dot["label"])), float(dot["late_ms"])
    if label is Label.MISS:
        return "missed"
    if label is Label.EXTRA:
        return "not written"
    when = "on time" if round(late_ms) == 0 else f"{abs(late_ms):.0f} ms {'late' if late_ms > 0 else 'early'}"
    return f"{when}, on a wrong pad" if label is Label.WRONG_PIECE else when

"""What one pass came to: the facts that the mastery policy looks at, measured from a final alignment.

Asynchronies are in ms, negative is early. Bias and spread are apart: each piece's own lean and the swing that the
player holds are taken out before the spread is measured, with the degrees of freedom that this costs; grace strokes,
diddles and rolls have no say in it (TEACHING, Defaults). No data is None.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Ornament, Piece
from station.core.units import NS_PER_MS
from station.music.judgement import Label
from station.music.passages import Swung, slots, swung
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.points import points
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.hit_windows import DEFAULT_LEVEL, Windows
from station.scoring.matching.right import right_notes

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

LEAST_FREEDOM = 3
"""With fewer degrees of freedom a spread says nothing; our choice."""
_ROLLS = (Ornament.DIDDLE, Ornament.ROLL)


@dataclass(frozen=True, slots=True)
class BarResult:
    """The lesson's bar `bar` (from 0): its notes, and how many were right."""

    bar: int
    notes: int
    right: int


@dataclass(frozen=True, slots=True)
class StruckFor:
    """`count` times `played` was struck where `written` stood; the two are one where it was right."""

    written: Piece
    played: Piece
    count: int


@dataclass(frozen=True, slots=True)
class PassResult:
    """One pass: `right` of `notes` were (`scoring.matching`), `wrong_pads` struck elsewhere, `extras` not written.

    `played` notes were matched, right or not; `sd_ms` the spread about leans and swing, `lean_ms` the mean asynchrony,
    `interval_ms` the usual wait between strokes as they were played, `swing_ratio` the ratio that was held (None where
    nothing swings), `points` 0–100.
    """

    notes: int
    right: int
    wrong_pads: int = 0
    extras: int = 0
    played: int = 0
    sd_ms: float | None = None
    lean_ms: float | None = None
    interval_ms: float | None = None
    swing_ratio: float | None = None
    points: float | None = None
    bars: tuple[BarResult, ...] = ()
    answers: tuple[StruckFor, ...] = ()

    @property
    def is_silent(self) -> bool:
        """Whether there was anything to play and nothing was played: such a pass is not judged."""
        return self.notes > 0 and not (self.played or self.right or self.wrong_pads or self.extras)


def measure_pass(
    score: Score,
    performance: Performance,
    alignment: Alignment,
    bars: Sequence[int] | None = None,
    windows: Windows = DEFAULT_LEVEL,
) -> PassResult:
    """Sum up one pass over `score`, at the tempo at which it was played.

    `bars` names the lesson's bar (from 0) of each bar of `score`, several times where it is repeated (None: its own).
    """
    names = np.arange(score.bar_count) if bars is None else np.asarray(bars, np.int64)
    off_ms, rows, swing = asynchrony_ms(alignment), _steady(score, alignment), swung(score)
    leaning = _leaning(score, off_ms, rows, swing.flags)
    right = right_notes(score, alignment, windows)
    return PassResult(
        notes=len(score),
        right=int(right.sum()),
        wrong_pads=alignment.count(Label.WRONG_PIECE),
        extras=alignment.count(Label.EXTRA),
        played=alignment.count(Label.MATCH),
        sd_ms=leaning.sd_ms,
        lean_ms=float(off_ms[rows].mean()) if rows.any() else None,
        interval_ms=usual_interval_ms(score),
        swing_ratio=_swing_ratio(leaning.swing_ms, rows, swing),
        points=points(score, alignment, None),
        bars=_by_bar(names[score.bar], right),
        answers=_answers(score, performance, alignment),
    )


# --- timing -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Leaning:
    """What is the player's own and no fault: `due_ms` (n,), of it `swing_ms` of swung rows; the spread that is left."""

    due_ms: Floats
    swing_ms: float
    sd_ms: float | None


def _steady(score: Score, alignment: Alignment) -> Flags:
    """The strokes (n,) whose time counts: matched, neither grace strokes nor parts of diddles and rolls."""
    notes = score.notes
    rolled = np.isin(notes["ornament"], _ROLLS) | (notes["duration_ticks"] > 0)
    return np.asarray(timed_notes(score, alignment) & ~rolled)


def _leaning(score: Score, off_ms: Floats, rows: Flags, offbeat: Flags) -> _Leaning:
    """Least squares over the `rows` that count: a lean for each piece, and one that swung offbeats share."""
    pieces = np.unique(score.notes["piece"][rows])
    by_piece = score.notes["piece"][:, None] == pieces
    columns = np.column_stack([by_piece, offbeat]).astype(np.float64)
    lean, _, rank, _ = np.linalg.lstsq(columns[rows], off_ms[rows], rcond=None)
    due_ms: Floats = columns @ lean
    left, freedom = (off_ms - due_ms)[rows], int(rows.sum()) - int(rank)
    sd_ms = float((left @ left / freedom) ** 0.5) if freedom >= LEAST_FREEDOM else None
    return _Leaning(due_ms, float(lean[-1]), sd_ms)


def usual_interval_ms(score: Score) -> float | None:
    """The median wait between slots, in real time."""
    slot_ns = score.tempo_map.ns_at(slots(score)[0])
    return float(np.median(np.diff(slot_ns))) / NS_PER_MS if len(slot_ns) > 1 else None


def _swing_ratio(swing_ms: float, rows: Flags, swing: Swung) -> float | None:
    """Long to short as it was held: the written place of the swung offbeats, moved by their own lean."""
    own = swing.flags & rows
    if not own.any():
        return None
    place = float(np.mean(swing.places[own] + swing_ms / swing.span_ms[own]))
    return place / (1.0 - place) if 0.0 < place < 1.0 else None


# --- counts -----------------------------------------------------------------------------------------------------------


def _by_bar(bar: NDArray[np.int64], right: Flags) -> tuple[BarResult, ...]:
    """Notes and right ones of each of the lesson's bars that has notes."""
    practised, which = np.unique(bar, return_inverse=True)
    notes, well = np.bincount(which), np.bincount(which, weights=right)
    return tuple(BarResult(*row) for row in zip(practised.tolist(), notes.tolist(), map(int, well), strict=True))


def _answers(score: Score, performance: Performance, alignment: Alignment) -> tuple[StruckFor, ...]:
    """What was struck for what, of all notes that were answered."""
    answered = np.flatnonzero(alignment.hit_of_note >= 0)
    written = score.notes["piece"][answered].tolist()
    played = performance.hits["piece"][alignment.hit_of_note[answered]].tolist()
    same = alignment.note_label[answered] == Label.MATCH  # alternates (crash 2 for 1) match: that is no mix-up
    pairs = Counter((w, w if fits else p) for w, p, fits in zip(written, played, same.tolist(), strict=True))
    return tuple(StruckFor(Piece(w), Piece(p), count) for (w, p), count in sorted(pairs.items()))

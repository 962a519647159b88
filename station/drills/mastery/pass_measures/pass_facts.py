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

from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.drills.mastery.pass_measures.asked_parts import Part
from station.drills.mastery.pass_measures.part_facts import NoteFacts, PartResult, part_result
from station.drills.mastery.pass_measures.pass_spread import Flags, leaning, steady_strokes
from station.music.judgement import Label
from station.music.passages import Swung, slots, swung
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.loudness import dynamics
from station.scoring.analysis.points import points
from station.scoring.analysis.timing_spread import asynchrony_ms
from station.scoring.matching.alignment import Alignment, Reference
from station.scoring.matching.hit_windows import DEFAULT_LEVEL, Windows
from station.scoring.matching.right import right_notes
from station.scoring.matching.unheard import known_part


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

    `played` notes were matched, right or not; `sd_ms` the spread about leans and swing, `lean_ms` the mean asynchrony
    (None without a click), `interval_ms` the usual wait between strokes as they were played, `swing_ratio` the ratio
    that was held (None where nothing swings), `points` 0–100, `loudness_error_db` the mean distance from the written
    loudness, `parts` what the lesson asks something of besides.
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
    loudness_error_db: float | None = None
    parts: tuple[PartResult, ...] = ()

    @property
    def is_silent(self) -> bool:
        """Whether there was anything to play and nothing was played: such a pass is not judged."""
        return self.notes > 0 and not (self.played or self.right or self.wrong_pads or self.extras)


@dataclass(frozen=True, slots=True)
class PassView:
    """How a pass is looked at: what is right by the level's `windows`, and the `parts` that are summed up besides.

    `hears_velocity` False where the input cannot tell loud from soft.
    """

    windows: Windows = DEFAULT_LEVEL
    parts: tuple[Part, ...] = ()
    hears_velocity: bool = True


def measure_pass(
    score: Score,
    performance: Performance,
    alignment: Alignment,
    bars: Sequence[int] | None = None,
    view: PassView | None = None,
) -> PassResult:
    """Sum up one pass over `score`, at the tempo at which it was played; unknown notes are left out.

    `bars` names the lesson's bar (from 0) of each bar of `score`, several times where it is repeated (None: its own).
    """
    view = view or PassView()
    score, alignment, _ = known_part(score, alignment)
    names = np.arange(score.bar_count) if bars is None else np.asarray(bars, np.int64)
    swing, off_ms = swung(score), asynchrony_ms(alignment)
    notes = NoteFacts(
        score,
        bar=names[score.bar],
        off_ms=off_ms,
        steady=steady_strokes(score, alignment),
        offbeat=swing.flags,
        right=right_notes(score, alignment, view.windows),
        off_db=dynamics(score, performance, alignment).off_db if view.hears_velocity else np.full(len(score), np.nan),
        is_clocked=alignment.reference is not Reference.PLAYER,
    )
    held, every = leaning(score, off_ms, notes.steady, swing.flags), np.ones(len(score), np.bool_)
    return PassResult(
        notes=len(score),
        right=int(notes.right.sum()),
        wrong_pads=alignment.count(Label.WRONG_PIECE),
        extras=alignment.count(Label.EXTRA),
        played=alignment.count(Label.MATCH),
        sd_ms=held.sd_ms,
        lean_ms=notes.lean_ms(every),
        interval_ms=usual_interval_ms(score),
        swing_ratio=_swing_ratio(held.swing_ms, notes.steady, swing),
        points=points(score, alignment, None),
        bars=_by_bar(notes.bar, notes.right),
        answers=_answers(score, performance, alignment),
        loudness_error_db=notes.loudness_error_db(every),
        parts=tuple(part_result(part, notes) for part in view.parts),
    )


# --- timing -----------------------------------------------------------------------------------------------------------


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

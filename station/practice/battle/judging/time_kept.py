"""Time: how evenly the strokes lie about the click, whether they drift from it, and how the turn comes home to one.

    a_k    = late_k − mean(late)                  late_k: the stroke after its cell of its beat's own division
    spread = √mean(a²) ms,                        blur = √mean((a / length of its cell)²)
    drift  = slope of a over the bars · bars      ms from the phrase's beginning to its end
    home   = the downbeat after the last bar, less the mean: the nearest stroke, in ms
    even   = min(credit(spread), credit(blur))
    points = 100·proof·(0.6·even + 0.15·min(credit(drift), even) + 0.25·credit(home))

The mean lean is style and costs nothing. Points fall as the spread grows and never rise with it. Strokes at random lie
about their nearest cells by a spread that is small where cells are short: they are told by the blur, which is 1/√12 =
0.289 then. `proof` asks for enough strokes to tell a time. Windows: HUMANS (full within 10 ms, mild to 25, a clear
fault beyond 40, after the lean is set apart; Groove MIDI Dataset 26–28 ms within a whole take).
"""

from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from station.practice.battle.judging.component_words import Cost, words_of
from station.practice.battle.judging.heard_turn import Floats, HeardTurn
from station.practice.battle.judging.improvisation_marks import FULL_POINTS, Component, ComponentMarks, Place

SPREAD_MS, SPREAD_CREDIT = (4.0, 10.0, 25.0, 40.0, 60.0), (1.0, 0.9, 0.6, 0.2, 0.0)
BLUR, BLUR_CREDIT = (0.18, 0.28), (1.0, 0.0)
"""Human phrases lie at .10–.24 of a cell, strokes at random at .289 (our choice between)."""
DRIFT_MS, DRIFT_CREDIT = (15.0, 60.0), (1.0, 0.0)
"""Human phrases to a click drift by 3–31 ms over four bars; a sixteenth at 250 beats a minute is 60 (our choice)."""
HOME_MS, HOME_CREDIT = (10.0, 25.0, 60.0), (1.0, 0.7, 0.0)
SHARES = MappingProxyType({"spread": 0.6, "drift": 0.15, "home": 0.25})
PROOF_A_BAR = 4
"""Strokes a bar that prove a time: one a beat (our choice)."""
FAR_MS = 25.0
"""What is off by more is pointed at (HUMANS: mild to 25)."""


@dataclass(frozen=True, slots=True)
class _Kept:
    off_ms: Floats
    spread_ms: float
    blur: float
    drift_ms: float
    home_ms: float | None


def time_kept(turn: HeardTurn) -> ComponentMarks:
    """The marks for time."""
    if not len(turn):
        return ComponentMarks(Component.TIME, 0.0, "nothing played")
    kept = _kept(turn)
    proof = min(1.0, len(turn) / (PROOF_A_BAR * turn.bars))
    points = FULL_POINTS * proof * _credit(kept)
    figures = {"spread_ms": kept.spread_ms, "blur": kept.blur, "drift_ms": kept.drift_ms, "proof": proof}
    if kept.home_ms is not None:
        figures["home_ms"] = kept.home_ms
    words = _words(turn, kept, proof)
    return ComponentMarks(Component.TIME, points, words, MappingProxyType(figures), _places(turn, kept))


def bar_credit(turn: HeardTurn) -> Floats:
    """Share of full marks (bars,) for the spread in each bar; 0 where it is silent."""
    off = turn.late_ms - turn.late_ms.mean() if len(turn) else turn.late_ms
    counts = np.bincount(turn.bar, minlength=turn.bars)
    squares = np.bincount(turn.bar, off**2, minlength=turn.bars)
    spread = np.sqrt(squares / np.maximum(counts, 1))
    return np.where(counts > 0, np.interp(spread, SPREAD_MS, SPREAD_CREDIT), 0.0)


def _kept(turn: HeardTurn) -> _Kept:
    lean = float(turn.late_ms.mean())
    off = turn.late_ms - lean
    home = turn.landing_late_ms - lean
    return _Kept(
        off,
        float(np.sqrt(np.mean(off**2))),
        float(np.sqrt(np.mean((off / turn.cell_ms) ** 2))),
        _drift_ms(turn, off),
        float(home[np.argmin(np.abs(home))]) if len(home) else None,
    )


def _drift_ms(turn: HeardTurn, off: Floats) -> float:
    along = (turn.moment - turn.moment.mean()) / max(turn.beat_shapes.shape[0] * turn.beat_shapes.shape[1], 1)
    square = float(along @ along)
    return float(along @ off) / square if square > 0 else 0.0


@dataclass(frozen=True, slots=True)
class _Credits:
    """Shares of full marks."""

    spread: float
    blur: float
    drift: float
    home: float

    @property
    def even(self) -> float:
        return min(self.spread, self.blur)


def _credits(kept: _Kept) -> _Credits:
    return _Credits(
        float(np.interp(kept.spread_ms, SPREAD_MS, SPREAD_CREDIT)),
        float(np.interp(kept.blur, BLUR, BLUR_CREDIT)),
        float(np.interp(abs(kept.drift_ms), DRIFT_MS, DRIFT_CREDIT)),
        float(np.interp(abs(kept.home_ms), HOME_MS, HOME_CREDIT)) if kept.home_ms is not None else 0.0,
    )


def _credit(kept: _Kept) -> float:
    earned = _credits(kept)
    drift = min(earned.drift, earned.even)
    return SHARES["spread"] * earned.even + SHARES["drift"] * drift + SHARES["home"] * earned.home


def _words(turn: HeardTurn, kept: _Kept, proof: float) -> str:
    """What cost points of time."""
    earned, even = _credits(kept), f"kept within {kept.spread_ms:.0f} ms (best: {SPREAD_MS[0]:.0f})"
    if earned.blur < earned.spread:
        even = f"off the grid by {100 * kept.blur:.1f} % of its cells (best: {100 * BLUR[0]:.0f})"
    costs = (
        Cost(FULL_POINTS * (SHARES["spread"] + SHARES["drift"]) * (1.0 - earned.even), even),
        Cost(FULL_POINTS * SHARES["home"] * (1.0 - earned.home), _home_words(kept)),
        Cost(
            FULL_POINTS * SHARES["drift"] * max(earned.even - earned.drift, 0.0),
            f"drifts by {abs(kept.drift_ms):.0f} ms (best: {DRIFT_MS[0]:.0f})",
        ),
        Cost(FULL_POINTS * (1.0 - proof), f"{len(turn)} strokes ({PROOF_A_BAR * turn.bars} prove a time)"),
    )
    return words_of(costs, f"kept within {kept.spread_ms:.0f} ms, and back on one")


def _home_words(kept: _Kept) -> str:
    if kept.home_ms is None:
        return "no stroke on the one after the turn"
    side = "late" if kept.home_ms > 0 else "early"
    return f"back on one {abs(kept.home_ms):.0f} ms {side} (best: {HOME_MS[0]:.0f})"


def _places(turn: HeardTurn, kept: _Kept) -> tuple[Place, ...]:
    """The beat that strays farthest by its mean, where that can be heard."""
    counts = np.bincount(turn.beat, minlength=turn.beats)
    mean = np.bincount(turn.beat, kept.off_ms, minlength=turn.beats) / np.maximum(counts, 1)
    beat = int(np.argmax(np.abs(mean)))
    if abs(mean[beat]) < FAR_MS:
        return ()
    side = "late" if mean[beat] > 0 else "early"
    return (Place(*divmod(beat, turn.beats_a_bar), f"{abs(mean[beat]):.0f} ms {side}"),)

"""Development: whether bars take up what was said, by the call or the player, and change it.

    kept_k   = the best likeness of bar k to an earlier bar of the turn or to a bar of the call: as it was; 0.85 of that
               on other drums or cymbals; 0.8 of that with all but the timekeeping displaced by half a beat or a beat
    copy_k   = how much of a copy bar k is: of any earlier bar of the turn, of bar k of the call, or half as much of
               bar k of an earlier turn of the player's
    kept     = mean of kept_k over the bars that can take something up
    period   = the mean likeness of beats half a bar, a bar or two bars apart, whichever is most
    own      = 1 − mean of copy_k over all bars that sound
    points   = 100·credit((kept + period) / 2)·credit(own)

Strangers' bars are unlike each other, copies are all too like: the middle band earns. A motif is taken up by bars, and
it has a period: ostinato, backbeat, question and answer. That repetition with change holds music together: Schoenberg
1967 (developing variation). Likelihood under a model would call one bar copied four times the better player; so it is
measured here by itself.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from station.practice.battle.judging.component_words import Cost, words_of
from station.practice.battle.judging.heard_turn import Floats, HeardTurn
from station.practice.battle.judging.improvisation_marks import FULL_POINTS, Component, ComponentMarks, Place
from station.practice.battle.judging.likeness import copied, likeness

KEPT, KEPT_CREDIT = (0.15, 0.7), (0.0, 1.0)
"""Human phrases lie at .65 (.27–.92; four drummers of the Groove MIDI Dataset), bars of four strangers at .4, and
where motifs on other drums or displaced count too, all a little higher."""
OWN, OWN_CREDIT = (0.25, 0.5), (0.0, 1.0)
"""One bar four times has a quarter of its own, two bars by turns a half; human phrases have .5 to 1."""

BEFORE_COUNTS = 0.5
"""A groove may go on from turn to turn: to say it again counts half as much as a copy of the call (our choice)."""
ORCHESTRATED, DISPLACED = 0.85, 0.8
"""How much of a motif is heard again on other drums, or half a beat or a beat from its place (our choice)."""


@dataclass(frozen=True, eq=False)
class BarLikeness:
    """Of each bar (bars,): `kept`, NaN where it can take up nothing, `source` the bar that it is likest to.

    `source` counts the turn's bars from 0, the call's from -1 downwards, last first; `copy` 0 … 1; `sounds`.
    """

    kept: Floats
    copy: Floats
    source: tuple[int | None, ...]
    sounds: tuple[bool, ...]

    @property
    def own(self) -> float:
        """Share of the sounding bars that were not said before."""
        return float(1.0 - self.copy[list(self.sounds)].mean()) if any(self.sounds) else 0.0


def bar_likeness(turn: HeardTurn, before: Sequence[HeardTurn], call: HeardTurn | None) -> BarLikeness:
    """How each bar stands to what was said earlier."""
    motifs = np.tril(_taken_up(turn, turn), -1)
    if call is not None:
        motifs = np.concatenate([motifs, _taken_up(turn, call)], axis=1)
    copy = np.max([copied(np.tril(_sameness(turn, turn), -1).max(axis=1)), *_copies(turn, before, call)], axis=0)
    best = motifs.argmax(axis=1)
    can = turn.bar_sounds & ((np.cumsum(turn.bar_sounds) > 1) | (call is not None))
    source = [int(b) if b < turn.bars else turn.bars - 1 - int(b) for b in best]
    return BarLikeness(
        np.where(can, motifs.max(axis=1), np.nan),
        np.where(turn.bar_sounds, copy, 0.0),
        tuple(s if c else None for s, c in zip(source, can.tolist(), strict=True)),
        tuple(turn.bar_sounds.tolist()),
    )


def motif_development(turn: HeardTurn, bars: BarLikeness) -> ComponentMarks:
    """The marks for development."""
    told = ~np.isnan(bars.kept)
    if not told.any():
        points = None if len(bars.kept) == 1 and any(bars.sounds) else 0.0
        return ComponentMarks(Component.DEVELOPMENT, points, "one bar alone" if any(bars.sounds) else "nothing played")
    kept, period = float(bars.kept[told].mean()), _period(turn)
    taken, changed = np.interp((kept + period) / 2, KEPT, KEPT_CREDIT), np.interp(bars.own, OWN, OWN_CREDIT)
    figures = MappingProxyType({"kept": kept, "period": period, "own": bars.own})
    places = _places(bars)
    costs = (
        Cost(FULL_POINTS * (1.0 - taken), f"{50 * (kept + period):.0f} % of it taken up (best: {100 * KEPT[1]:.0f})"),
        Cost(FULL_POINTS * (1.0 - changed), f"{100 * bars.own:.0f} % of it no copy (best: {100 * OWN[1]:.0f})"),
    )
    words = words_of(costs, "takes its motifs up and changes them")
    return ComponentMarks(Component.DEVELOPMENT, FULL_POINTS * float(taken * changed), words, figures, places)


def _taken_up(turn: HeardTurn, other: HeardTurn) -> Floats:
    """(bars, other's bars): how far a motif is taken up: as it was, on other drums or cymbals, or displaced."""
    displaced = [likeness(turn.bar_shapes, shapes) for shapes in other.displaced_bar_shapes]
    orchestrated = likeness(turn.bar_family_shapes, other.bar_family_shapes)
    as_it_was = likeness(turn.bar_shapes, other.bar_shapes)
    return np.asarray(
        np.maximum.reduce([as_it_was, ORCHESTRATED * orchestrated, DISPLACED * np.max(displaced, axis=0)])
    )


def _copies(turn: HeardTurn, before: Sequence[HeardTurn], call: HeardTurn | None) -> list[Floats]:
    """How much of a copy each bar (bars,) is of the same bar of the call, and of the player's earlier turns."""
    copies = []
    for other, counts in [*((other, BEFORE_COUNTS) for other in before), *([(call, 1.0)] if call is not None else [])]:
        copy, both = np.zeros(turn.bars), min(turn.bars, other.bars)
        copy[:both] = counts * copied(np.diagonal(_sameness(turn, other)))
        copies.append(copy)
    return copies


def _sameness(turn: HeardTurn, other: HeardTurn) -> Floats:
    """(bars, other's bars): how far bars say the same, by their cells or as they were played, whichever is more.

    A copy with other errors has the same cells; one that is read otherwise still comes at the same times.
    """
    by_cells = likeness(turn.bar_shapes, other.bar_shapes)
    return np.maximum(by_cells, likeness(turn.bar_shapes_as_played, other.bar_shapes_as_played))


def _period(turn: HeardTurn) -> float:
    """The mean likeness of beats half a bar, a bar or two bars apart, whichever is most."""
    alike = likeness(turn.beat_shapes, turn.beat_shapes)
    bar = turn.beats_a_bar
    lags = {lag for lag in (bar // 2 if bar % 2 == 0 else bar, bar, 2 * bar) if 0 < lag < turn.beats}
    return max((float(np.diagonal(alike, lag).mean()) for lag in lags), default=0.0)


def bar_credit(bars: BarLikeness) -> Floats:
    """Share of full marks (bars,) for taking up and changing; the first bar has nothing to take up and gets half."""
    kept = np.where(np.isnan(bars.kept), sum(KEPT) / 2, bars.kept)
    return np.where(bars.sounds, np.interp(kept, KEPT, KEPT_CREDIT) * (1.0 - bars.copy), 0.0)


def _places(bars: BarLikeness) -> tuple[Place, ...]:
    """The bar that best takes something up and changes it, and the one that copies most, where there are."""
    credit = np.where(np.isnan(bars.kept), 0.0, bar_credit(bars))
    best, worst = int(np.argmax(credit)), int(np.argmax(bars.copy))
    places = [Place(best, None, f"takes up {_named(bars.source[best])}")] if credit[best] > 0 else []
    return (*places, *([Place(worst, None, "copied from earlier")] if bars.copy[worst] >= 1.0 else []))


def _named(source: int | None) -> str:
    assert source is not None, "what takes something up takes it from somewhere"
    return f"bar {source + 1}" if source >= 0 else f"bar {-source} of the call"

"""Dynamics: how wide their range is, whether loud and soft come on purpose, and whether the phrase has a contour.

    range    = SD of the strokes' levels, dB                  level = 40·log10(v / 127) (HUMANS, Velocity)
    chance   = √((Σ off² / range² + 8) / (again + 8))        off: a level less the mean of its place
    contour  = highest − lowest mean level of a bar, dB
    points   = 100·own·credit(range)·(0.3 + credit(chance)·(0.6 + 0.1·credit(contour)))

A place is an instrument on a slot of the bar, or of the beat, whichever tells more; `again` are the strokes less the
places. An accent is on purpose that comes where it came before: strokes at the same place then differ less in level
than all strokes do. `chance` is 1 where loud and soft are drawn by lot, near 0 where every place
has its own level; about 0.6 in human phrases (Groove MIDI Dataset). Where no place comes twice nothing tells purpose
from chance. All is in dB, so that a louder kit changes little.
"""

from types import MappingProxyType

import numpy as np

from station.practice.battle.improvising.played_beats import Instrument
from station.practice.battle.judging.component_words import Cost, own_cost, words_of
from station.practice.battle.judging.heard_turn import SLOTS, Floats, HeardTurn
from station.practice.battle.judging.improvisation_marks import FULL_POINTS, Component, ComponentMarks, Place

RANGE_DB, RANGE_CREDIT = (1.0, 6.0), (0.0, 1.0)
"""1 dB is what the skilled just hear (HUMANS); 6 dB is between normal and accent, and human phrases have 6 to 12."""
CHANCE, CHANCE_CREDIT = (0.5, 0.9), (1.0, 0.0)
"""Human phrases lie at .47 to .87, strokes whose levels are drawn by lot at 1 (our choice between)."""
CHANCE_STROKES = 8
"""So many strokes by chance are thought beside those that come again, so that two or three alike prove nothing."""
CONTOUR_DB, CONTOUR_CREDIT = (0.5, 3.0), (0.0, 1.0)
"""The bars of human phrases differ by 1 to 7 dB (our choice)."""
RANGE_SHARE, PURPOSE_SHARE, CONTOUR_SHARE = 0.3, 0.6, 0.1
FLAT_DB = 1.0


def dynamics_used(turn: HeardTurn, own: float) -> ComponentMarks:
    """The marks for dynamics; `own` is the share of the turn that was not said before."""
    if len(turn) < 2:
        return ComponentMarks(Component.DYNAMICS, 0.0, "nothing to compare")
    spread, chance, contour = float(turn.level_db.std()), _chance(turn), _contour_db(turn)
    purpose = float(np.interp(chance, CHANCE, CHANCE_CREDIT))
    curve = float(np.interp(contour, CONTOUR_DB, CONTOUR_CREDIT))
    shaped = PURPOSE_SHARE + CONTOUR_SHARE * curve
    wide = float(np.interp(spread, RANGE_DB, RANGE_CREDIT))
    credit = wide * (RANGE_SHARE + purpose * shaped)
    costs = (
        Cost(FULL_POINTS * (1.0 - wide), f"{spread:.1f} dB of loud and soft (best: {RANGE_DB[1]:.0f})"),
        Cost(
            FULL_POINTS * (PURPOSE_SHARE + CONTOUR_SHARE) * (1.0 - purpose),
            f"loud and soft at their own places: {100 * purpose:.0f} % (best: 100)",
        ),
        Cost(
            FULL_POINTS * CONTOUR_SHARE * purpose * (1.0 - curve),
            f"bars {contour:.1f} dB apart (best: {CONTOUR_DB[1]:.0f})",
        ),
        own_cost(own),
    )
    at_best = f"{spread:.0f} dB of loud and soft, placed on purpose"
    figures = {"range_db": spread, "chance": chance, "contour_db": contour, "own": own}
    return ComponentMarks(
        Component.DYNAMICS,
        FULL_POINTS * own * credit,
        "all at one level" if spread < FLAT_DB else words_of(costs, at_best),
        MappingProxyType(figures),
        _loudest(turn),
    )


def bar_credit(turn: HeardTurn) -> Floats:
    """Share of full marks (bars,) for the range in each bar."""
    spreads = [turn.level_db[turn.bar == bar].std() if turn.bar_sounds[bar] else 0.0 for bar in range(turn.bars)]
    return np.asarray(np.interp(spreads, RANGE_DB, RANGE_CREDIT))


def _chance(turn: HeardTurn) -> float:
    """How much of the range is left within places of the beat or of the bar, whichever tells more."""
    return min(_chance_at(turn, period) for period in (1, turn.beats_a_bar))


def _chance_at(turn: HeardTurn, period: int) -> float:
    """The same for places that come again every `period` beats."""
    place = ((turn.beat % period) * SLOTS + turn.slot) * len(Instrument) + turn.instrument
    _, place, counts = np.unique(place, return_inverse=True, return_counts=True)
    again, whole = int((counts - 1).sum()), float(turn.level_db.var(ddof=1))
    if not whole > 0:
        return 1.0
    off = turn.level_db - (np.bincount(place, turn.level_db) / counts)[place]
    return float(np.sqrt((off @ off / whole + CHANCE_STROKES) / (again + CHANCE_STROKES)))


def _contour_db(turn: HeardTurn) -> float:
    levels = _bar_levels(turn)[turn.bar_sounds]
    return float(np.ptp(levels)) if len(levels) else 0.0


def _bar_levels(turn: HeardTurn) -> Floats:
    counts = np.bincount(turn.bar, minlength=turn.bars)
    return np.asarray(np.bincount(turn.bar, turn.level_db, minlength=turn.bars) / np.maximum(counts, 1))


def _loudest(turn: HeardTurn) -> tuple[Place, ...]:
    beat = int(turn.beat[np.argmax(turn.level_db)])
    return (Place(*divmod(beat, turn.beats_a_bar), "the loudest stroke"),)

"""Use of space: what is left unplayed, and whether the density has a shape.

    open   = share of the moments of a 1/16 grid that are left open        0 a drum roll … 1 silence
    shape  = SD of the bars' numbers of strokes / their mean
    points = 100·own·(0.6·credit(open) + 0.4·credit(shape))·proof

A phrase breathes: neither every cell is struck nor hardly any, and it thins and thickens from bar to bar. Human phrases
leave 20 to 60 of 100 open and shape their density by .03 to .33 (four drummers of the Groove MIDI Dataset).
"""

from types import MappingProxyType

import numpy as np

from station.practice.battle.judging.component_words import Cost, own_cost, words_of
from station.practice.battle.judging.heard_turn import SLOTS, HeardTurn
from station.practice.battle.judging.improvisation_marks import FULL_POINTS, Component, ComponentMarks, Place

OPEN, OPEN_CREDIT = (0.0, 0.15, 0.75, 1.0), (0.0, 1.0, 1.0, 0.0)
SHAPE, SHAPE_CREDIT = (0.02, 0.12, 0.5, 1.0), (0.0, 1.0, 1.0, 0.3)
OPEN_SHARE, SHAPE_SHARE = 0.6, 0.4
SIXTEENTHS = 4
PROOF_A_BAR = 2
"""Strokes a bar below which the space is nobody's (our choice)."""


def space_used(turn: HeardTurn, own: float) -> ComponentMarks:
    """The marks for space."""
    if not len(turn):
        return ComponentMarks(Component.SPACE, 0.0, "nothing but rest")
    counts = np.bincount(turn.bar, minlength=turn.bars)
    opened, shape = _open(turn), float(counts.std() / counts.mean())
    breathes, varies = np.interp(opened, OPEN, OPEN_CREDIT), np.interp(shape, SHAPE, SHAPE_CREDIT)
    credit = OPEN_SHARE * breathes + SHAPE_SHARE * varies
    proof = min(1.0, len(turn) / (PROOF_A_BAR * turn.bars))
    figures = MappingProxyType({"open": opened, "shape": shape, "own": own})
    fullest = Place(int(np.argmax(counts)), None, "the fullest bar")
    costs = (
        Cost(
            FULL_POINTS * OPEN_SHARE * (1.0 - breathes),
            f"{100 * opened:.0f} % left open (best: {100 * OPEN[1]:.0f}–{100 * OPEN[2]:.0f})",
        ),
        Cost(
            FULL_POINTS * SHAPE_SHARE * (1.0 - varies),
            f"bars {100 * shape:.0f} % fuller and thinner (best: {100 * SHAPE[1]:.0f}–{100 * SHAPE[2]:.0f})",
        ),
        Cost(FULL_POINTS * (1.0 - proof), f"{len(turn)} strokes ({PROOF_A_BAR * turn.bars} shape a space)"),
        own_cost(own),
    )
    words = words_of(costs, f"{100 * opened:.0f} % left open, bars fuller and thinner")
    return ComponentMarks(Component.SPACE, FULL_POINTS * own * proof * float(credit), words, figures, (fullest,))


def _open(turn: HeardTurn) -> float:
    struck = np.unique(turn.moment * SIXTEENTHS // SLOTS)
    return 1.0 - len(struck) / (turn.beats * SIXTEENTHS)

"""The optimiser on hands that cross: what it mends, what it leaves alone, and that chance has no part in it."""

from functools import lru_cache

import numpy as np
import pytest

from station.core.pieces import Articulation, Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.audit import audit
from station.motion.avoidance.clearance import cleared
from station.motion.avoidance.cost import WRONG_M, Hands
from station.motion.avoidance.optimise import optimised
from station.motion.drummer import Drummer
from station.motion.strokes.hand import HandPart
from station.motion.strokes.lap import thighs
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from tests.unit.motion.patterns import ROCK, score_of

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND
CROSSING = {R: (Piece.HIHAT, Piece.SNARE), L: (Piece.SNARE, Piece.FLOOR_TOM_1)}


@lru_cache(maxsize=1)
def crossing() -> Drummer:
    """Hands that cross at 120 bpm, two bars long."""
    notes = [
        Note((2 * i + k) * PPQ // 2, piece, Zone.BOW if piece == Piece.HIHAT else Zone.HEAD, 100, limb=limb)
        for i in range(8)
        for k, (limb, pieces) in enumerate(CROSSING.items())
        for piece in (pieces[i % 2],)
    ]
    return Drummer(Score.from_notes(notes, TempoMap.constant(120)))


def straight() -> tuple[HandPart, HandPart]:
    """Their ways before any move."""
    drummer = crossing()
    plan = drummer._plan
    legs = thighs(plan.kit, plan.figure, plan.footings, "down")
    first = zip((R, L), (p.hold for p in drummer._hands), plan.events, legs, strict=True)
    right, left = (HandPart.of(plan.score, plan.kit, plan.figure, h, limb, e, t) for limb, h, e, t in first)
    return cleared((right, left), plan.figure)


def test_less_is_wrong_than_before_and_strikes_stay() -> None:
    parts = straight()
    plan = crossing()._plan
    stage = plan._stage(parts, thighs(plan.kit, plan.figure, plan.footings, "down"))
    before = Hands(stage, parts).cost(np.arange(len(stage.grid)))
    led, after = optimised(parts, stage)
    assert before.max() > 2 * WRONG_M
    assert after.sum() < 0.6 * before.sum()
    assert after == pytest.approx(Hands(stage, led).cost(np.arange(len(stage.grid))), abs=1e-9)
    for old, new in zip(parts, led, strict=True):
        struck = old.events.key[:, 2] == 0
        assert np.array_equal(old.contacts[struck, :3], new.contacts[struck, :3])
    again, _ = optimised(parts, stage)
    assert all(np.array_equal(a.way.rows, b.way.rows) for a, b in zip(led, again, strict=True))


def test_fewer_searches_mend_less_and_none_leaves_all_as_it_is() -> None:
    parts = straight()
    plan = crossing()._plan
    stage = plan._stage(parts, thighs(plan.kit, plan.figure, plan.footings, "down"))
    before = Hands(stage, parts).cost(np.arange(len(stage.grid)))
    (right, left), untouched = optimised(parts, stage, 0)
    assert (right, left) == parts
    assert untouched == pytest.approx(before)
    _, few = optimised(parts, stage, 6)
    _, all_of_them = optimised(parts, stage)
    assert all_of_them.sum() < few.sum() < before.sum()


def test_hands_that_cannot_but_meet_are_named_with_their_bar_and_a_groove_has_none() -> None:
    """Both hands lie on the snare's head for cross-sticks at once, in bar 2: two hands are 18 cm broad, the head 36."""
    clicks = [Note(4 * PPQ, Piece.SNARE, Zone.RIM, 80, Articulation.CROSS_STICK, limb=limb) for limb in (R, L)]
    score = Score.from_notes([Note(0, Piece.SNARE, limb=R), *clicks], TempoMap.constant(110))
    drummer = Drummer(score)
    (met,) = (demand for demand in drummer.left_over if demand.bar == 1)
    assert met.text == "bar 2: the hands meet"
    assert met.start_s <= score.onset_s[1] <= met.end_s
    assert audit(drummer).hands_m.value > 0.001
    assert Drummer(score_of(ROCK)).left_over == ()


def test_left_on_the_ride_while_the_right_crashes_breaks_no_arm() -> None:
    """Arms crossed from one end of the kit to the other in the middle of sixteenths at 116: no joint leaps, at 1
    kHz."""
    notes = [Note(i * PPQ // 2, Piece.SNARE, Zone.HEAD, 90, limb=(R, L)[i % 2]) for i in range(4)]
    notes += [Note(3 * PPQ, Piece.RIDE, Zone.BOW, 100, limb=L), Note(3 * PPQ, Piece.CRASH_1, Zone.EDGE, 110, limb=R)]
    notes += [Note(4 * PPQ + i * PPQ // 2, Piece.SNARE, Zone.HEAD, 90, limb=(R, L)[i % 2]) for i in range(4)]
    drummer = Drummer(Score.from_notes(notes, TempoMap.constant(116)))
    found = audit(drummer)
    assert found.limit_rad.value <= np.radians(1), found.limit_rad
    assert found.strike_m.value <= 1e-6, found.strike_m
    assert found.body_m.value <= 0.02, found.body_m
    assert found.speed.value <= 1.5, found.speed

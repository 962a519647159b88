"""Flams and drags: spacing, softness, hand order, by hand."""

import numpy as np
import pytest

from station.core.pieces import Limb, Ornament, Piece
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.analysis.summary import SummaryView, summarise
from station.scoring.analysis.technique.ornaments import Ornaments, ornaments
from tests.fakes.answers import Played, take
from tests.fakes.scores import flams


def told(how: Played, score: Score | None = None, kind: Ornament = Ornament.FLAM) -> Ornaments:
    played = take(score or flams(3), how)
    return ornaments(played.score, played.performance, played.alignment)[kind]


def test_spacing_by_hand() -> None:
    """Grace strokes in turn 10 ms before and after their place: 40 and 20 ms ahead, mean 30, SD √(12·100/11)."""
    graces = flams(3).is_grace
    off = np.zeros(24)
    off[graces] = np.tile([-10.0, 10.0], 6)
    found = told(Played(off_ms=off))
    assert (found.graces, found.heard, found.usual) == (12, 12, 12)
    assert found.spacing_ms.mean == pytest.approx(30.0)
    assert found.spacing_ms.sd == pytest.approx((1200 / 11) ** 0.5)


def test_spacing_beyond_the_usual_is_told_and_not_lost() -> None:
    """One flam of 100 ms among eleven of 30: still twelve, eleven within 15–40."""
    off = np.zeros(24)
    off[0] = -70.0
    found = told(Played(off_ms=off))
    assert (found.heard, found.usual) == (12, 11)


def test_softness_by_hand() -> None:
    """35 before 100: 40·log10(0.35) = −18.2 dB; one grace as loud as its main stroke is not softer."""
    velocity = flams(3).notes["velocity"].copy()
    velocity[0] = 100
    found = told(Played(velocity=velocity))
    assert found.softer == 11
    assert found.level_db.mean == pytest.approx(11 / 12 * 40 * np.log10(0.35), abs=1e-6)


def test_half_a_step_softer_is_softer() -> None:
    """100 before 100.5: 40·log10(100/100.5) = −0.087 dB."""
    found = told(Played(velocity=np.where(flams(3).is_grace, 100, 100.5)))
    assert found.softer == 12
    assert found.level_db.mean == pytest.approx(-0.087, abs=1e-3)


def test_a_grace_stroke_as_loud_as_its_main_stroke_costs_a_tenth() -> None:
    """Six of 24 notes: 100·(1 − 0.1/4); keys that have no velocity lose nothing."""
    velocity = flams(3).notes["velocity"].copy()
    velocity[:12:2] = 100
    played = take(flams(3), Played(velocity=velocity))
    told, deaf = (
        summarise(played.score, played.performance, played.alignment, SummaryView(hears_velocity=hears)).points
        for hears in (True, False)
    )
    assert told == pytest.approx(97.5)
    assert deaf == pytest.approx(100.0)


def test_hand_order_where_the_sticks_say_it() -> None:
    """Written left leads right; two flams were led by the right hand."""
    limbs = flams(3).notes["limb"].copy()
    limbs[:4] = limbs[:4][::-1]
    assert told(Played(limbs=limbs)).hand_order == (10, 12)


def test_hand_order_of_midi_cannot_be_told() -> None:
    assert told(Played()).hand_order is None
    half = flams(3).notes["limb"].copy()
    half[::2] = Limb.UNKNOWN
    assert told(Played(limbs=half)).hand_order is None


def test_drags_by_hand() -> None:
    """Two grace strokes, 110 and 55 ms ahead: each 55 ms before the next; the first of one drag left out."""
    notes = [
        Note(beat * PPQ, Piece.SNARE, velocity=v, lead_ms=lead, ornament=Ornament.DRAG)
        for beat in range(8)
        for v, lead in ((32, 110.0), (32, 55.0), (80, 0.0))
    ]
    found = told(Played(left_out=(9,)), Score.from_notes(notes, TempoMap.constant(60)), Ornament.DRAG)
    assert (found.graces, found.heard, found.usual) == (16, 15, 15)
    assert found.spacing_ms.mean == pytest.approx(55.0)


def test_the_main_stroke_carries_the_time() -> None:
    """Grace strokes 12 ms wider than written: the asynchrony of the whole is that of the main strokes, 5 ms late."""
    off = np.where(flams(3).is_grace, -7.0, 5.0)
    played = take(flams(3), Played(off_ms=off))
    timing = summarise(played.score, played.performance, played.alignment).timing
    assert (timing.count, timing.sd_ms) == (12, 0.0)
    assert timing.mean_ms == pytest.approx(5.0)

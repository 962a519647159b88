"""How hands lean against the phase."""

from dataclasses import replace

import numpy as np
import pytest

from station.core.events import PhaseEstimate, StickStroke
from station.core.pieces import Limb
from station.sync.drill.phase_feedback import hand_leans, stroke_offsets
from tests.unit.sync.drummed_sticks import model_of

RIGHT, LEFT = Limb.RIGHT_HAND, Limb.LEFT_HAND
LESSON = "single-paradiddle"


def clocked(tempo: float, locked: bool = True) -> list[PhaseEstimate]:
    """Twelve seconds of a student who moves evenly at `tempo` of the lesson's."""
    cycle_s = model_of(LESSON).cycle_s
    turns = np.arange(1200) * 0.01 * tempo / cycle_s
    phases = np.pi - (np.pi - 2 * np.pi * turns) % (2 * np.pi)
    return [
        PhaseEstimate(k * 10_000_000, phase, 1.0, 1.0, 2 * np.pi * tempo / cycle_s, locked)
        for k, phase in enumerate(phases.tolist())
    ]


def struck(tempo: float, late_s: dict[Limb, float]) -> list[StickStroke]:
    """The first loop's strokes, each hand late by so much of the student's own time."""
    model = model_of(LESSON)
    rows = [
        (o / tempo + late_s[Limb(h)], Limb(h)) for o, h in zip(model.onset_s + model.loop_s, model.limb, strict=True)
    ]
    return [StickStroke(round(at * 1e9), limb.name, limb, 3.0) for at, limb in rows]


@pytest.mark.parametrize("tempo", [0.6, 1.0, 1.7])
def test_each_hand_leans_by_what_it_is_late(tempo: float) -> None:
    """A beat of the lesson is 857 ms (70 bpm); 12 ms of the student's time are 12·tempo ms of the score's."""
    beat_s = 60 / 70
    strokes = struck(tempo, {RIGHT: 0.0, LEFT: 0.012})
    right, left = hand_leans(stroke_offsets(model_of(LESSON), clocked(tempo), strokes, beat_s))
    assert (right.limb, right.strokes, left.limb, left.strokes) == (RIGHT, 8, LEFT, 8)
    assert right.late_ms == pytest.approx(0.0, abs=0.01)
    assert left.late_ms == pytest.approx(12.0, abs=0.01)
    assert left.late_beats == pytest.approx(0.012 * tempo / beat_s, abs=1e-5)
    assert left.sd_ms == pytest.approx(0.0, abs=0.01)


def test_early_is_negative_and_what_was_not_locked_or_not_a_hand_says_nothing() -> None:
    model, strokes = model_of(LESSON), struck(1.0, {RIGHT: -0.02, LEFT: 0.0})
    assert hand_leans(stroke_offsets(model, clocked(1.0), strokes, 0.5))[0].late_ms == pytest.approx(-20.0, abs=0.01)
    assert stroke_offsets(model, clocked(1.0, locked=False), strokes, 0.5) == ()
    nobody = [replace(stroke, limb=Limb.UNKNOWN) for stroke in strokes]
    assert stroke_offsets(model, clocked(1.0), nobody, 0.5) == ()
    assert stroke_offsets(model, clocked(1.0), [replace(strokes[0], at_ns=60_000_000_000)], 0.5) == ()


def test_of_three_strokes_nothing_is_said() -> None:
    strokes = struck(1.0, {RIGHT: 0.0, LEFT: 0.0})[:5]
    offsets = stroke_offsets(model_of(LESSON), clocked(1.0), strokes, 0.5)
    assert len(offsets) == 5
    assert hand_leans(offsets[:3]) == ()

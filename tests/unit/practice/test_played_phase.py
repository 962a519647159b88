"""The phases of a session: what counts of them, and what is said of it."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from station.core.events import PhaseEstimate, StickStroke
from station.core.pieces import Limb
from station.drills.library import find_lesson
from station.practice.records.report.phase_words import phase_document, phase_lines
from station.practice.session.adaptation import Adaptation
from station.practice.session.device_latency import Latency
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.played_phase import PhasesHeard, PlayedPhase, all_phases
from station.practice.session.runner import SessionRunner
from station.scoring.analysis.fault_table import Asked
from station.sync.drill.drummed_model import is_soon_made
from station.sync.drill.phase_feedback import StrokeOffset
from tests.unit.practice.test_adaptation import TODAY
from tests.unit.sync.drummed_sticks import model_of

LESSON = "single-paradiddle"
SECTION = plan_practice(find_lesson(LESSON), PlanOptions(loops=2, demonstrations=0)).section
BEAT_TICKS = find_lesson(LESSON).beat_ticks


def heard(until: int, locked_from: int) -> PhasesHeard:
    """A hundred phases a second of one who plays evenly at the lesson's tempo, locked from some step on."""
    model = model_of(LESSON)
    phases = PhasesHeard(model)
    for k in range(until):
        phase = np.pi - (np.pi - 2 * np.pi * k * 0.01 / model.cycle_s) % (2 * np.pi)
        phases.handle(PhaseEstimate(k * 10_000_000, phase, 1.0, 1.0, 2 * np.pi / model.cycle_s, k >= locked_from))
    return phases


def strokes(late_s: float) -> list[StickStroke]:
    model = model_of(LESSON)
    return [
        StickStroke(round((loop * model.loop_s + onset_s + late_s) * 1e9), "one", Limb(limb), 3.0)
        for loop in range(3)
        for onset_s, limb in zip(model.onset_s.tolist(), model.limb.tolist(), strict=True)
    ]


def test_what_counts_lies_within_the_judged_strokes() -> None:
    played = heard(1000, 400).played(SECTION, BEAT_TICKS, strokes(0.012), (2_000_000_000, 8_000_000_000))
    assert played is not None
    assert (played.steps, played.locked) == (601, 401)
    assert all(3.97e9 < offset.at_ns <= 8e9 for offset in played.offsets)
    assert np.allclose([offset.late_ms for offset in played.offsets], 12.0, atol=0.1)
    phase: Any = phase_document(played)
    assert phase["locked_share"] == pytest.approx(401 / 601, abs=1e-3)
    assert phase["hands"]["left_hand"]["late_ms"] == 12.0


def test_another_tempo_is_the_same_drill_and_other_bars_are_not() -> None:
    span, phases = (0, 9_000_000_000), heard(1000, 0)
    assert phases.played(SECTION.at_speed(1.3), BEAT_TICKS, [], span) is not None
    assert phases.played(find_lesson("rock-1").score, BEAT_TICKS, [], span) is None
    assert phases.played(SECTION, BEAT_TICKS, [], None) is None
    assert PhasesHeard().played(SECTION, BEAT_TICKS, [], span) is None


def test_passes_are_taken_together() -> None:
    one = PlayedPhase(100, 50, (StrokeOffset(1, Limb.LEFT_HAND, 2.0, 0.01),))
    assert all_phases([None, one, replace(one, locked=100)]) == PlayedPhase(200, 150, one.offsets * 2)
    assert all_phases([None, None]) is None


def test_only_a_sure_lean_has_a_side() -> None:
    def offsets(late_ms: float, sd_ms: float) -> tuple[StrokeOffset, ...]:
        off_ms = late_ms + sd_ms * np.random.default_rng(4).standard_normal(40)
        return tuple(StrokeOffset(k, Limb.LEFT_HAND, ms, ms / 500) for k, ms in enumerate(off_ms.tolist()))

    for late_ms, words in ((12.0, "ms behind"), (-12.0, "ms ahead of"), (0.2, "leans neither way")):
        lines = phase_lines({"phase": phase_document(PlayedPhase(100, 80, offsets(late_ms, 5.0)))})
        assert lines[0] == "Motion: your sticks were followed through the drill 80% of the time"
        assert words in lines[1]
    assert phase_lines({"phase": None}) == []
    sized = Asked({"hand_behind": 20.0, "hand_ahead": None})
    for late_ms in (12.0, -12.0):
        phase: Any = phase_document(PlayedPhase(100, 80, offsets(late_ms, 5.0)), sized)
        assert phase["hands"]["left_hand"]["fault"] is None
        assert phase_lines({"phase": phase})[1].startswith("Motion: left hand spread (SD) ")


def test_a_slip_is_no_lean() -> None:
    offsets = tuple(StrokeOffset(k, Limb.LEFT_HAND, 200.0 if k == 7 else 4.0 + k % 2, 0.01) for k in range(40))
    phase: Any = phase_document(PlayedPhase(100, 80, offsets))
    assert phase["hands"]["left_hand"]["strokes"] == 39
    assert phase["hands"]["left_hand"]["late_ms"] == pytest.approx(4.5, abs=0.1)


def test_the_next_pass_is_tracked_by_the_same_model() -> None:
    runner = SessionRunner(Adaptation(find_lesson(LESSON), PlanOptions(demonstrations=0), TODAY), Latency())
    runner.track(SECTION, model_of(LESSON))
    runner.veto()
    assert runner.session.phases.model is model_of(LESSON)


def test_a_section_that_would_take_long_is_not_tracked_unasked() -> None:
    assert is_soon_made(SECTION)
    assert not is_soon_made(SECTION.repeated(30))

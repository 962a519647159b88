"""Triggers that sound live: phases that are told late, and a drill that is played on sticks with sensors."""

from math import pi

import numpy as np
import pytest

from station.core.events import PhaseEstimate
from station.core.note_map import NoteMeaning
from station.core.pieces import Piece
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.sync.drill.drill_tracker import DrillTracker
from station.sync.sonification.live_triggers import FORETOLD_S, LiveTriggers
from station.sync.sonification.trigger_table import drill_triggers
from station.sync.sonification.triggers import Trigger
from tests.unit.sync.drummed_sticks import events, model_of, take

HALF = Trigger(0.5, NoteMeaning(Piece.SNARE))
LESSON = "rock-1"


def estimate(at_s: float, turns: float, locked: bool = True) -> PhaseEstimate:
    """A phase at 1 cycle a second."""
    phase_rad = pi - (pi - 2 * pi * turns) % (2 * pi)
    return PhaseEstimate(round(at_s * NS_PER_S), phase_rad, 1.0, 1.0, 2 * pi, locked)


def heard(late_s: float, until_s: float, locked: bool = True) -> list[float]:
    """When the snare sounds at φ = 0 of a phase of 1 cycle a second that is told every 10 ms, `late_s` late."""
    live = LiveTriggers((HALF,))
    times_s = np.arange(0.3, until_s, 0.01)
    told = [live.handle(estimate(t, t, locked), round((t + late_s) * NS_PER_S)) for t in times_s]
    return [hit.at_ns / NS_PER_S for hits in told for hit in hits]


@pytest.mark.parametrize("late_s", [0.0, 0.05, 0.2])
def test_it_sounds_as_the_phase_passes_however_late_that_is_told(late_s: float) -> None:
    assert heard(late_s, 3.5) == pytest.approx([1.0, 2.0, 3.0], abs=1e-6)


def test_a_phase_that_is_very_late_is_not_foretold_for_ever() -> None:
    assert heard(FORETOLD_S + 0.1, 2.5) == pytest.approx([1.1, 2.1], abs=1e-6)


def test_a_phase_that_has_not_locked_is_silent() -> None:
    assert heard(0.0, 3.5, locked=False) == []


def test_a_drill_that_is_played_on_sticks_sounds_with_its_strokes() -> None:
    """The snare's strokes of the loop, as its score has them, within 40 ms, while the sensors are followed."""
    model, score = model_of(LESSON), find_lesson(LESSON).score
    triggers = [each for each in drill_triggers(score, model.repeats) if each.sound.piece is Piece.SNARE]
    tracker, live, hits = DrillTracker(model), LiveTriggers(triggers), []
    for event in events(take(LESSON)):
        for told in tracker.handle(event):
            hits += live.handle(told, event.at_ns)
    loop_s = score.length_ns / NS_PER_S
    snare_s = score.onset_s[score.notes["piece"] == Piece.SNARE]
    all_s = np.concatenate([snare_s + k * loop_s for k in range(5)])
    apart_s = [float(np.abs(all_s - hit.at_ns / NS_PER_S).min()) for hit in hits]
    assert len(hits) >= 2 * len(snare_s)
    assert max(apart_s) < 0.04

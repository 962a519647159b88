"""The clock that runs by the student's phase: never back, never a leap, and by hits in the right repeat."""

from dataclasses import replace

import numpy as np
import pytest

from station.core.events import Hit, PhaseEstimate
from station.core.pieces import Piece, Zone
from station.sync.drill.drill_model import DrillModel
from station.sync.drill.phase_clock import FASTEST, PhaseClock
from tests.unit.sync.drummed_sticks import model_of

CYCLE_S, LOOP_S, REPEATS = 1.0, 4.0, 4
STEP_NS = 10_000_000
FRAME_NS = 16_000_000


def model() -> DrillModel:
    """Four equal seconds of the hands; in the third there is a crash besides the snares of each."""
    onset_s = np.array([0.0, 1.0, 2.0, 2.5, 3.0])
    piece = np.array([Piece.SNARE, Piece.SNARE, Piece.SNARE, Piece.CRASH_1, Piece.SNARE], np.int64)
    return replace(model_of("single-paradiddle"), loop_s=LOOP_S, repeats=REPEATS, onset_s=onset_s, piece=piece)


def estimate(at_ns: int, turns: float, tempo: float = 1.0, locked: bool = True) -> PhaseEstimate:
    phase = np.pi - (np.pi - 2 * np.pi * turns) % (2 * np.pi)
    return PhaseEstimate(at_ns, phase, 0.9, 1.0 if locked else 0.0, 2 * np.pi * tempo / CYCLE_S, locked)


def run(clock: PhaseClock, estimates: list[PhaseEstimate], clock_s: float = 0.0) -> np.ndarray:
    """The positions at pictures 16 ms apart; each phase is told 40 ms late."""
    shown, waiting = [], list(estimates)
    for now_ns in range(estimates[0].at_ns, estimates[-1].at_ns + 40_000_000, FRAME_NS):
        while waiting and waiting[0].at_ns + 40_000_000 <= now_ns:
            clock.handle(waiting.pop(0))
        clock.advance(now_ns, clock_s)
        shown.append(np.nan if clock.position_s is None else clock.position_s)
    return np.array(shown)


@pytest.mark.parametrize("tempo", [0.5, 1.0, 2.0])
def test_it_runs_on_through_repeats_and_loops_at_the_students_tempo(tempo: float) -> None:
    steps = [estimate(k * STEP_NS, 0.3 + k * 0.01 * tempo, tempo) for k in range(1000)]
    shown = run(PhaseClock(model()), steps)
    shown = shown[~np.isnan(shown)]
    assert shown[-1] == pytest.approx(0.3 + 10.0 * tempo, abs=0.05 * tempo)
    assert np.diff(shown)[60:] == pytest.approx(0.016 * tempo, abs=1e-3)


def test_it_begins_at_the_sessions_place_in_the_repeat_that_is_nearest() -> None:
    """The session is at 7.1 s, the student at .94 of a repeat: at 6.94 s, so that the clock waits for them."""
    shown = run(PhaseClock(model()), [estimate(k * STEP_NS, 0.9 + k * 0.01) for k in range(100)], clock_s=7.1)
    shown = shown[~np.isnan(shown)]
    assert shown[:9] == pytest.approx(7.1)
    assert shown[-1] == pytest.approx(7.9, abs=0.05)


def test_it_stands_while_the_student_is_lost_and_goes_on_without_a_leap() -> None:
    """Lost for a second, and found again a third of a repeat ahead of where they were."""
    first = [estimate(k * STEP_NS, k * 0.01) for k in range(100)]
    lost = [estimate((100 + k) * STEP_NS, k * 0.37, locked=False) for k in range(100)]
    again = [estimate((200 + k) * STEP_NS, 0.33 + k * 0.01) for k in range(200)]
    shown = run(PhaseClock(model()), [*first, *lost, *again])
    shown = shown[~np.isnan(shown)]
    steps = np.diff(shown)
    assert (steps >= 0).all()
    assert steps.max() <= FASTEST * 0.016 + 1e-9
    assert (steps == 0).sum() * 0.016 == pytest.approx(1.0, abs=0.06)
    assert shown[-1] == pytest.approx(1.0 + 0.33 + 2.0, abs=0.06)


def test_jitter_never_turns_it_back() -> None:
    chance = np.random.default_rng(4)
    steps = [estimate(k * STEP_NS, 5 + k * 0.01 + chance.normal(0, 0.02)) for k in range(500)]
    shown = run(PhaseClock(model()), steps)
    shown = shown[~np.isnan(shown)]
    assert (np.diff(shown) >= 0).all()
    assert shown[-1] - shown[0] == pytest.approx(5.0, abs=0.15)


def test_hits_settle_the_repeat_and_the_clock_skips_whole_ones() -> None:
    """The clock thinks itself in the first second of the loop; three crashes say that it was the third."""
    clock = PhaseClock(model())
    places = []
    for k in range(1400):
        turns = k * 0.01
        clock.handle(estimate(k * STEP_NS, turns))
        clock.advance(k * STEP_NS, 0.0)
        if k % 400 == 50:  # once a loop, half way through the repeat
            clock.hit(Hit(k * STEP_NS, Piece.CRASH_1, Zone.BOW, 90))
        places.append(clock.position_s or 0.0)
    moved = np.diff(places)
    assert (moved >= 0).all()
    assert moved.max() == pytest.approx(2 * CYCLE_S, abs=0.02)
    assert (moved > 0.1).sum() == 1
    assert places[-1] % LOOP_S == pytest.approx((13.99 + 2.0) % LOOP_S, abs=0.02)


def test_before_anybody_was_found_there_is_no_place() -> None:
    clock = PhaseClock(model())
    clock.handle(estimate(0, 0.5, locked=False))
    clock.advance(STEP_NS, 3.0)
    assert clock.position_s is None

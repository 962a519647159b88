"""What phases trigger, by phases made so that the answer is known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.events import Hit
from station.core.note_map import NoteMeaning
from station.core.pieces import Piece
from station.sync.sonification.triggers import Trigger, share_of, triggered

KICK, SNARE, HAT = NoteMeaning(Piece.KICK), NoteMeaning(Piece.SNARE), NoteMeaning(Piece.HIHAT)
FEET = (Trigger(0.25, KICK), Trigger(0.75, SNARE))
STEP_NS = 10_000_000


def heard(turns: np.ndarray, triggers: tuple[Trigger, ...] = FEET, sure: np.ndarray | None = None) -> list[str]:
    return [hit.piece.name for hit in hits(turns, triggers, sure)]


def hits(turns: np.ndarray, triggers: tuple[Trigger, ...] = FEET, sure: np.ndarray | None = None) -> list[Hit]:
    at_ns = np.arange(len(turns)) * STEP_NS
    phase = 2 * np.pi * (turns % 1.0) - np.pi
    return triggered(triggers, at_ns, phase, np.ones(len(turns), bool) if sure is None else sure)


def test_the_share_of_the_cycle_runs_from_0_to_1() -> None:
    assert [share_of(-np.pi), share_of(0.0), share_of(np.pi / 2), share_of(np.pi)] == [0, 0.5, 0.75, 1]


def test_a_phase_that_runs_triggers_each_threshold_once_a_cycle_in_order() -> None:
    assert heard(np.arange(0.0, 2.6, 0.01)) == ["KICK", "SNARE"] * 2 + ["KICK"]


def test_a_sound_lies_where_the_phase_passed_between_two_samples() -> None:
    at_ns = [hit.at_ns for hit in hits(np.array([0.20, 0.22, 0.30]))]
    assert at_ns == [STEP_NS + round(STEP_NS * 3 / 8)]


def test_what_lies_on_the_first_sample_has_passed_already() -> None:
    assert heard(np.array([0.25, 0.26, 0.30])) == []
    assert heard(np.array([0.24, 0.25, 0.26])) == ["KICK"]


def test_a_phase_that_trembles_about_a_threshold_triggers_it_once() -> None:
    assert heard(np.array([0.2, 0.26, 0.24, 0.26, 0.23, 0.27, 0.3])) == ["KICK"]


def test_a_phase_that_runs_back_is_silent() -> None:
    assert heard(np.arange(3.0, 0.0, -0.01)) == []


def test_after_running_back_it_sounds_again_going_ahead() -> None:
    back_and_ahead = np.concatenate([np.arange(0.9, 0.6, -0.02), np.arange(0.6, 1.8, 0.02)])
    assert heard(back_and_ahead) == ["SNARE", "KICK", "SNARE"]


def test_what_is_leapt_over_is_silent() -> None:
    assert heard(np.array([0.1, 0.12, 0.5, 0.52])) == []


def test_an_unsure_phase_is_silent_and_owes_nothing_later() -> None:
    turns = np.arange(0.0, 1.0, 0.01)
    assert heard(turns, sure=turns > 0.5) == ["SNARE"]


def test_thresholds_passed_in_one_step_sound_in_order() -> None:
    near = (Trigger(0.99, HAT), Trigger(0.0, KICK), Trigger(0.05, SNARE))
    assert heard(np.array([0.9, 0.95, 1.1]), near) == ["HIHAT", "KICK", "SNARE"]


@given(
    st.lists(st.floats(-0.02, 0.08), min_size=20, max_size=200),
    st.lists(st.integers(0, 99), min_size=1, max_size=5, unique=True),
)
def test_sounds_are_as_many_as_thresholds_below_the_furthest_point(steps: list[float], hundredths: list[int]) -> None:
    """Whatever it trembles: with no step back as far as a quarter, what sounds is what the furthest point passed."""
    turns = 10.003 + np.cumsum(steps) + np.arange(len(steps)) * 0.02
    triggers = tuple(Trigger(h / 100, KICK, 1 + h) for h in hundredths)
    passed = sorted(
        (n + h / 100, 1 + h) for h in hundredths for n in range(5, 60) if turns[0] < n + h / 100 <= turns.max()
    )
    assert [hit.velocity for hit in hits(turns, triggers)] == [velocity for _, velocity in passed]


@given(st.lists(st.floats(0.0, 0.2), min_size=2, max_size=100))
def test_times_never_go_back(steps: list[float]) -> None:
    at_ns = [hit.at_ns for hit in hits(np.cumsum(steps))]
    assert at_ns == sorted(at_ns)
    assert all(0 <= at <= len(steps) * STEP_NS for at in at_ns)


def test_hits_name_their_source() -> None:
    assert hits(np.array([0.2, 0.3]))[0].device == "phase"


@pytest.mark.parametrize("count", [0, 1])
def test_fewer_than_two_samples_trigger_nothing(count: int) -> None:
    assert heard(np.full(count, 0.25)) == []

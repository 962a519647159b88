"""The best way through phase and tempo, on made-up motions whose phase is known."""

import numpy as np
import pytest

from station.sync.drill.phase_paths import FASTEST, SLOWEST, MatchTable, PathStep, PhasePaths

STEP_S = 0.01
ALL = np.ones(3, bool)
CYCLE_S = 2.0


def motion(turn: float) -> np.ndarray:
    """Four strokes a turn that are told apart by one slow channel."""
    angle = 2 * np.pi * turn
    return np.array([np.exp(3 * np.cos(4 * angle) - 3), np.sin(4 * angle), np.sin(angle)]) * 2 - [0.5, 0, 0]


def table(count: int = 64) -> MatchTable:
    return MatchTable(np.array([[motion(j / count) for j in range(count)]]), (1.0,), CYCLE_S)


def followed(
    speed: float, begin: float = 0.37, seconds: float = 8.0, noise: float = 0.2
) -> list[tuple[float, PathStep]]:
    paths, chance = PhasePaths(table(), STEP_S), np.random.default_rng(5)
    turns = begin + np.arange(int(seconds / STEP_S)) * STEP_S * speed / CYCLE_S
    return [(turn % 1, paths.step(motion(turn) + chance.normal(0, noise, 3), ALL)) for turn in turns]


def off(turn: float, step: PathStep) -> float:
    return abs((step.turn - turn + 0.5) % 1 - 0.5)


@pytest.mark.parametrize("speed", [0.5, 0.7, 1.0, 1.37, 2.0])
def test_phase_and_tempo_are_found_from_half_to_double(speed: float) -> None:
    late = followed(speed)[400:]
    assert np.percentile([off(*each) for each in late], 95) < 1 / 32  # an eighth of a stroke
    assert np.mean([step.speed for _, step in late]) == pytest.approx(speed, rel=0.03)


def test_who_jumps_is_found_again() -> None:
    paths = PhasePaths(table(), STEP_S)
    turns = np.concatenate([np.arange(400), np.arange(400) + 60]) * STEP_S / CYCLE_S
    steps = [paths.step(motion(turn), ALL) for turn in turns]
    assert off(turns[399], steps[399]) < 1 / 64
    assert off(turns[599], steps[599]) < 1 / 64


def test_equal_halves_leave_no_lead_and_different_ones_do() -> None:
    def lead(distinct: float) -> float:
        values = np.array([[motion(j / 64) * [1, 1, distinct] for j in range(64)]])
        paths = PhasePaths(MatchTable(values, (1.0,), CYCLE_S), STEP_S)
        return [paths.step(motion(k * STEP_S / CYCLE_S) * [1, 1, distinct], ALL) for k in range(300)][-1].lead

    assert lead(0.0) == pytest.approx(0.0, abs=1e-6)
    assert lead(1.0) > 2.0


def test_without_a_channel_it_moves_on_as_it_did() -> None:
    paths = PhasePaths(table(), STEP_S)
    turns = np.arange(600) * STEP_S / CYCLE_S
    steps = [paths.step(motion(turn), ALL if k < 500 else ~ALL) for k, turn in enumerate(turns)]
    assert off(turns[-1], steps[-1]) < 1 / 32
    assert steps[-1].match == 0.0


def test_rows_stand_for_all_tempi_from_less_than_half_to_more_than_double() -> None:
    assert SLOWEST < 0.5
    assert FASTEST > 2.0


def test_a_row_reads_the_model_of_its_tempo() -> None:
    """Of two models, one for half the tempo and one for all of it, the slow player is found in the first."""
    slow = np.array([motion(j / 64) * [1, -1, 1] for j in range(64)])
    both = MatchTable(np.array([slow, [motion(j / 64) for j in range(64)]]), (0.5, 1.0), CYCLE_S)
    paths = PhasePaths(both, STEP_S)
    turns = np.arange(800) * STEP_S * 0.5 / CYCLE_S
    steps = [paths.step(motion(turn) * [1, -1, 1], ALL) for turn in turns]
    assert steps[-1].speed == pytest.approx(0.5, rel=0.05)
    assert off(turns[-1], steps[-1]) < 1 / 64
    assert steps[-1].match > 0.95

"""Timekeeping on the other cymbal: what moves, and that nothing else does."""

import numpy as np
import pytest

from station.core.pieces import Piece
from station.drills.library import lesson_names
from station.drills.orchestration import can_reorchestrate, reorchestrated
from tests.shipped_lesson import shipped_lesson

REORCHESTRATED = [name for name in lesson_names() if can_reorchestrate(shipped_lesson(name).score)]


def test_some_lessons_can_and_some_cannot() -> None:
    assert "rock-1" in REORCHESTRATED
    assert not can_reorchestrate(shipped_lesson("single-drag-tap").score)


@pytest.mark.parametrize("lesson", REORCHESTRATED[::7])
def test_only_cymbals_move_and_nothing_in_time(lesson: str) -> None:
    score = shipped_lesson(lesson).score
    other = reorchestrated(score)
    moves = np.isin(score.notes["piece"], (Piece.HIHAT, Piece.RIDE))
    for name in ("tick", "velocity", "dynamic", "ornament", "limb", "lead_ms", "duration_ticks"):
        assert np.array_equal(np.sort(other.notes[name]), np.sort(score.notes[name]))
    assert len(other) == len(score)
    kept = np.bincount(score.notes["piece"][~moves], minlength=64)
    found = np.bincount(other.notes["piece"][~np.isin(other.notes["piece"], (Piece.HIHAT, Piece.RIDE))], minlength=64)
    assert np.array_equal(kept, found)


def test_rock_1_moves_to_the_ride() -> None:
    """Eight eighths a bar on the hi-hat, two bars."""
    score = shipped_lesson("rock-1").score
    assert np.count_nonzero(score.notes["piece"] == Piece.HIHAT) == 16
    other = reorchestrated(score)
    assert np.count_nonzero(other.notes["piece"] == Piece.RIDE) == 16
    assert np.count_nonzero(reorchestrated(other).notes["piece"] == Piece.HIHAT) == 16

"""A loop's own repeats, and the hits that settle them."""

import numpy as np
import pytest

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.sync.drill.loop_repeats import repeats, settled


def loop(cycles: int, odd: float = 0.0, count: int = 1000) -> np.ndarray:
    """Two channels that return `cycles` times, and one that does not."""
    turn = 2 * np.pi * np.arange(count) / count
    return np.stack([np.sin(cycles * turn), np.cos(2 * cycles * turn), odd * np.sin(turn)], axis=1)


@pytest.mark.parametrize("cycles", [1, 2, 3, 4, 7, 12])
def test_the_shortest_motion_is_found(cycles: int) -> None:
    assert repeats(loop(cycles), (2 * cycles, cycles)) == cycles


def test_a_difference_that_shows_makes_them_two() -> None:
    assert repeats(loop(4, odd=0.5), (8, 8)) == 1
    assert repeats(loop(4, odd=0.05), (8, 8)) == 4


def test_strokes_that_cannot_be_shared_out_do_not_repeat() -> None:
    assert repeats(loop(4), (6, 0)) == 2


def hits(*struck: tuple[float, Piece]) -> tuple[list[Hit], list[float]]:
    return [Hit(int(at * 1e9), piece, Zone.HEAD, 80) for at, piece in struck], [at for at, _ in struck]


ONSET_S = np.array([0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5])
PIECE = np.array([Piece.KICK, Piece.SNARE] * 3 + [Piece.SNARE, Piece.SNARE], np.int64)
"""Two bars of two seconds: the second has a kick less and a snare more."""


def test_the_pieces_say_in_which_bar() -> None:
    """Three snares where only the second bar has one; a fourth hit that both bars have."""
    first_bar = hits((1.01, Piece.SNARE), (0.5, Piece.SNARE), (0.99, Piece.SNARE), (1.02, Piece.SNARE))
    assert settled(*first_bar, ONSET_S, PIECE, 4.0, 2) == 1
    kicks = hits((1.0, Piece.KICK), (1.0, Piece.KICK), (1.01, Piece.KICK))
    assert settled(*kicks, ONSET_S, PIECE, 4.0, 2) == 0


def test_what_both_have_settles_nothing() -> None:
    assert settled(*hits(*[(0.5, Piece.SNARE)] * 9), ONSET_S, PIECE, 4.0, 2) is None
    assert settled(*hits((0.3, Piece.CRASH_1)), ONSET_S, PIECE, 4.0, 2) is None


def test_one_repeat_needs_no_hits() -> None:
    assert settled([], [], ONSET_S, PIECE, 4.0, 1) == 0

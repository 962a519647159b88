"""Two kicks: which strokes ask for the count-in. Times in ms, by hand."""

import pytest

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS
from station.practice.pad_gestures import TwoKicks

K, S = Piece.KICK, Piece.SNARE


@pytest.mark.parametrize(
    ("strokes", "asks_at"),
    [
        ([(0, K), (500, K)], [500]),
        ([(0, K), (1000, K)], [1000]),
        ([(0, K), (1001, K)], []),
        ([(0, K), (1500, K), (2000, K)], [2000]),
        ([(0, K), (200, S), (400, K)], []),
        ([(0, K), (200, S), (400, K), (700, K)], [700]),
        ([(0, K), (30, K)], []),  # one stroke that triggered twice
        ([(0, K), (30, K), (500, K)], [500]),
        ([(0, K), (400, K), (800, K)], [400]),  # the third begins anew
        ([(0, S), (300, S)], []),
    ],
)
def test_two_kicks_within_a_second_and_nothing_between(strokes: list[tuple[int, Piece]], asks_at: list[int]) -> None:
    kicks = TwoKicks()
    asked = [at for at, piece in strokes if kicks.take(Hit(at * NS_PER_MS, piece, Zone.HEAD, 90))]
    assert asked == asks_at


def test_what_was_forgotten_counts_no_more() -> None:
    kicks = TwoKicks()
    kicks.take(Hit(0, K, Zone.HEAD, 90))
    kicks.forget()
    assert not kicks.take(Hit(300 * NS_PER_MS, K, Zone.HEAD, 90))

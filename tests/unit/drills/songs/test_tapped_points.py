"""Taps become points: which beat each one means, by hand."""

import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.songs.song import SongPoint
from station.drills.songs.tapped_points import tapped_points
from station.music.score import Note, Score
from station.music.tempo import TempoMap


def score(beats: int = 4, unit: int = 4, bars: int = 4) -> Score:
    tempo_map = TempoMap.constant(120.0, beats, unit)
    return Score.from_notes([Note(0, Piece.KICK)], tempo_map, bars * 4 * PPQ * beats // unit)


def places(points: tuple[SongPoint, ...]) -> list[tuple[int, float]]:
    return [(point.bar, point.beat) for point in points]


def test_taps_are_the_beats_from_a_bar_on() -> None:
    points = tapped_points(score(), 2, [5.0, 5.52, 6.01, 6.5, 7.02])
    assert places(points) == [(2, 1), (2, 2), (2, 3), (2, 4), (3, 1)]
    assert [point.at_s for point in points] == [5.0, 5.52, 6.01, 6.5, 7.02]


def test_a_tap_that_was_left_out_is_counted() -> None:
    assert places(tapped_points(score(), 1, [0.0, 0.5, 1.5, 2.0, 2.5])) == [(1, 1), (1, 2), (1, 4), (2, 1), (2, 2)]


def test_in_six_eight_the_foot_taps_twice_a_bar() -> None:
    assert places(tapped_points(score(6, 8), 1, [0.0, 0.75, 1.5])) == [(1, 1), (1, 4), (2, 1)]


def test_beyond_the_part_there_are_no_points() -> None:
    assert places(tapped_points(score(bars=1), 1, [0.5 * i for i in range(9)])) == [(1, 1), (1, 2), (1, 3), (1, 4)]
    assert tapped_points(score(bars=1), 7, [0.0]) == ()


@pytest.mark.parametrize("taps", [[], [3.0]])
def test_few_taps(taps: list[float]) -> None:
    assert len(tapped_points(score(), 1, taps)) == len(taps)

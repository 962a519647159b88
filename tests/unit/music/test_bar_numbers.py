"""How bars are named in sentences; expected words are written by hand."""

import pytest

from station.music.bar_numbers import bar_numbers, named_bars
from station.music.formats.lost_bars import LostBars
from station.music.formats.music_format import Feature


@pytest.mark.parametrize(
    ("bars", "words"),
    [([4], "bar 5"), ([0, 1], "bars 1–2"), ([6, 0, 2, 1, 2], "bars 1–3, 7"), (range(500), "bars 1–500")],
)
def test_runs_are_ranges(bars: list[int], words: str) -> None:
    assert named_bars(bars) == words


def test_no_more_runs_than_fit_a_line() -> None:
    assert bar_numbers(range(0, 100, 2)) == "1, 3, 5, 7, 9, 11, 13, 15 …"


def test_what_a_long_song_loses_fits_a_line() -> None:
    lost = LostBars()
    for bar in range(200):
        lost.add(Feature.TIMES, "moved", bar)
    assert [loss.text for loss in lost.told()] == ["bars 1–200: moved"]

"""How bars are named in sentences; expected words are written by hand."""

import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.bar_numbers import bar_numbers, named_bars
from station.music.drum_part import DrumPart
from station.music.formats.dtx.dtx_writer import write_dtx
from station.music.formats.lost_bars import LostBars
from station.music.formats.music_format import Feature
from station.music.score import Note, Score
from station.music.tempo import TempoMap


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


def test_a_long_dtx_names_its_bars_once() -> None:
    """Triplets of 7 and 11 in one bar are finer than its 1920 places."""
    ticks = [bar * 4 * PPQ + at for bar in range(20) for at in (0, PPQ // 7, 2 * PPQ + PPQ // 11)]
    score = Score.from_notes([Note(tick, Piece.SNARE) for tick in ticks], TempoMap.constant(120), 80 * PPQ)
    told = [loss.text for loss in write_dtx(DrumPart(score)).lost]
    assert "bars 1–20: finer than 1920 places; moved to the nearest" in told

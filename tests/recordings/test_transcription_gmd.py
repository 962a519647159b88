"""Human takes onto the grid: four drummers played the same grooves, all written in sixteenths, to one click."""

from collections import Counter
from pathlib import Path

import pytest

from station.core.units import PPQ
from station.drills.transcription.grid_times import quantised_times
from station.drills.transcription.ornament_finder import found_ornaments
from station.music.formats.format_table import read_part
from station.music.score import Score
from tests.real_data import real_files

FINEST_TICKS = PPQ // 8


@pytest.mark.parametrize("path", real_files("gmd/*/eval_session/*.mid"))
def test_a_groove_in_sixteenths_is_cut_into_sixteenths_and_never_finer_than_thirty_seconds(path: Path) -> None:
    score = read_part(path).score
    mains = Score.from_notes(found_ornaments(score, None).mains, score.tempo_map, score.end_tick)
    found = quantised_times(mains, is_played=True)
    assert all(beat.length_ticks >= FINEST_TICKS * beat.cells for beat in found.beats)
    cells = Counter(beat.cells for beat in found.beats)
    assert cells[2] + cells[4] >= cells.total() / 2
    assert 5 < found.spread_ms < 28  # HUMANS, Timing: 10–20 ms of professionals, 26–28 of this dataset at large

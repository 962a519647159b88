"""Rows of a line that grows, against those of the whole line read at once."""

import numpy as np
import pytest

from station.practice.battle.ground import Feel
from station.practice.battle.improvising.bar_memory import contexts
from station.practice.battle.improvising.beat_steps import GRID, Music, division_rows, step_rows, steps_of
from station.practice.battle.improvising.played_beats import Beats
from station.practice.battle.improvising.played_line import PlayedLine
from station.practice.battle.improvising.rows_ahead import RowsAhead

MUSIC = Music(frozenset({"jazz"}), Feel.TRIPLET, 150.0, phrase_bar=3)


def random_beats(bars: int, beats_a_bar: int) -> Beats:
    rng = np.random.default_rng(beats_a_bar)
    beats = Beats.silent(bars * beats_a_bar, beats_a_bar)
    beats.division[:] = rng.choice([3, 4, 6, 8], len(beats))
    inside = np.arange(8) < beats.division[:, None]
    beats.struck[:] = (rng.random(beats.struck.shape) < 0.25) & inside[:, :, None]
    return beats


@pytest.mark.parametrize("beats_a_bar", [2, 3, 4, 5, 17])
def test_a_line_that_grows_knows_what_the_whole_one_does(beats_a_bar: int) -> None:
    whole, heard = random_beats(7, beats_a_bar), 2 * beats_a_bar
    steps = steps_of(whole)
    line = PlayedLine.after([whole.of_bars(0, 2)], len(whole) - heard, beats_a_bar)
    rows = RowsAhead.of(line.steps, heard, len(whole) - heard, MUSIC)
    for beat in range(heard, len(whole)):
        known, division = rows.known_before(beat), int(whole.division[beat])
        assert np.array_equal(rows.of_division(beat, known), division_rows(steps, np.array([beat]), MUSIC))
        line.steps.division[beat] = division
        row = rows.of_steps(beat, line.step, known)
        for cell in range(division):
            assert np.array_equal(row(cell), step_rows(steps, np.array([line.step]), MUSIC))
            place = cell * (GRID // division)
            keys = contexts(beat, place, beats_a_bar, line.past)
            line.strike(place, keys, whole.struck[beat, cell].tolist())
        line.end_beat()
    assert line.step == len(steps.at)

"""The map that a band's beats make: exact, and without a drift of its own."""

import numpy as np
import pytest

from station.core.units import PPQ
from station.drills.songs.band_tempo import PlacedPoint, tempo_map_of
from station.music.tempo import MeterChange, TempoMap

WRITTEN = TempoMap.build([], [MeterChange(0, 3, 4)])


def test_every_beat_lies_within_a_microsecond_a_quarter_after_ten_minutes() -> None:
    """1201 beats of 0.4999996 s and a little: rounding each tempo by itself would be off by 0.5 ms at the end."""
    beat_s = 2.5 + np.arange(1201) * 0.49999958
    ticks = list(range(0, 1201 * PPQ, PPQ))
    made, start_s = tempo_map_of(WRITTEN, ticks, beat_s.tolist())
    assert start_s == pytest.approx(2.5, abs=1e-9)
    assert np.abs(start_s + made.seconds_at(ticks) - beat_s).max() < 1.1e-6
    assert made.meters == WRITTEN.meters


def test_the_first_tempo_holds_from_tick_0() -> None:
    """The first beat that is known, the third of the song, comes at 3 s; at 0.6 s a beat tick 0 lies at 1.8 s."""
    made, start_s = tempo_map_of(WRITTEN, [2 * PPQ, 3 * PPQ, 5 * PPQ], [3.0, 3.6, 4.6])
    assert start_s == pytest.approx(1.8, abs=1e-6)
    assert start_s + made.seconds_at([2 * PPQ, 3 * PPQ, 4 * PPQ, 5 * PPQ]) == pytest.approx([3, 3.6, 4.1, 4.6])


def test_a_residual_is_shown_beyond_20_ms() -> None:
    assert [PlacedPoint(0, 0.0, ms).is_off for ms in (20.0, -20.0, 20.1, -35.0)] == [False, False, True, True]

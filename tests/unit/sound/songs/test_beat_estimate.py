"""The beat of a sound that is made here: kick, snare and hats of noise and tones at times that are known."""

import numpy as np
import pytest

from station.sound.songs.beat_estimate import estimated_beat
from station.sound.songs.onset_strength import RATE_HZ
from station.sound.songs.song_onsets import onsets_of
from tests.fakes.virtual_band import rock


@pytest.mark.parametrize(("bpm", "first_beat_s"), [(97.3, 1.437), (120.0, 0.5), (148.6, 3.05), (168.0, 0.25)])
def test_tempo_and_first_beat_are_found(bpm: float, first_beat_s: float) -> None:
    found = estimated_beat(onsets_of(rock(bpm, first_beat_s)))
    assert found is not None
    assert found.bpm == pytest.approx(bpm, abs=0.1)
    assert found.first_beat_s == pytest.approx(first_beat_s, abs=0.01)


def test_a_slow_song_in_eighths_may_be_counted_at_double() -> None:
    found = estimated_beat(onsets_of(rock(72.0, 0.812)))
    assert found is not None
    assert min(abs(found.bpm - 72.0), abs(found.bpm - 144.0)) < 0.1
    assert found.first_beat_s == pytest.approx(0.812, abs=0.01)


def test_people_scatter() -> None:
    found = estimated_beat(onsets_of(rock(104.0, 1.0, scatter_s=0.008)))
    assert found is not None
    assert found.bpm == pytest.approx(104.0, abs=0.2)
    assert found.first_beat_s == pytest.approx(1.0, abs=0.02)


def test_silence_has_no_beat() -> None:
    assert estimated_beat(onsets_of(np.zeros(5 * RATE_HZ, np.float32))) is None

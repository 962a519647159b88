"""The beat of a sound that is made here: kick, snare and hats of noise and tones at times that are known."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.sound.songs.beat_estimate import estimated_beat
from station.sound.songs.onset_strength import RATE_HZ
from station.sound.songs.song_onsets import onsets_of


def rock(bpm: float, first_beat_s: float, length_s: float = 40.0, scatter_s: float = 0.0) -> NDArray[np.float32]:
    """Eighths on a hat, kick on 1 and 3, snare on 2 and 4, over a chord that lasts: (n,) at `RATE_HZ`."""
    chance = np.random.default_rng(7)
    time_s = np.arange(round(length_s * RATE_HZ)) / RATE_HZ
    sound = 0.02 * np.sin(2 * np.pi * np.outer((220.0, 277.2, 329.6), time_s)).sum(axis=0)
    ring_s = np.arange(round(0.15 * RATE_HZ)) / RATE_HZ
    noise = chance.normal(size=len(ring_s))
    kick = np.sin(2 * np.pi * 60 * ring_s) * np.exp(-ring_s / 0.05)
    snare = (0.5 * noise + np.sin(2 * np.pi * 200 * ring_s)) * np.exp(-ring_s / 0.04)
    hat = 0.15 * np.diff(noise, prepend=0.0) * np.exp(-ring_s / 0.02)
    for eighth in range(int((length_s - first_beat_s - 0.5) * bpm / 30)):
        struck = [hat, *({0: [kick], 2: [snare]}.get(eighth % 4, []))]
        at = round((first_beat_s + eighth * 30 / bpm + chance.normal(scale=scatter_s)) * RATE_HZ)
        for each in struck:
            sound[at : at + len(ring_s)] += 0.5 * each
    return np.asarray(sound, np.float32)


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

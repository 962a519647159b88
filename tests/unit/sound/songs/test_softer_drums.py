"""Drums turned down in a mix whose drums and whose band are known apart."""

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from station.simulation.bands.band_sound import RATE_HZ
from station.simulation.bands.made_song import MadeSong, SongSpec, made_song
from station.sound.songs.softer_drums import softer_drums

Frames = NDArray[np.float32]


@cache
def song() -> tuple[MadeSong, NDArray[np.float64], NDArray[np.uint8]]:
    made = made_song(SongSpec(seed=2, length_s=12.0, left_out=0.0, own=0.0))
    return made, made.seconds_at(made.score.notes["tick"]), made.score.notes["piece"]


def both_sides(mono: NDArray[np.float32]) -> Frames:
    return np.column_stack([mono, 0.5 * mono]).astype(np.float32)


def db(louder: Frames, softer: Frames) -> float:
    return float(
        10 * np.log10(np.sum(np.square(louder, dtype=np.float64)) / np.sum(np.square(softer, dtype=np.float64)))
    )


def at_strokes(frames: Frames, at_s: NDArray[np.float64]) -> Frames:
    starts = np.rint(np.unique(at_s[at_s < 11.0]) * RATE_HZ).astype(int)
    return np.concatenate([frames[start : start + 2000] for start in starts])


def test_nothing_changes_where_nothing_is_written() -> None:
    made, _, _ = song()
    frames = both_sides(made.mono)
    same = softer_drums(frames, RATE_HZ, np.zeros(0), np.zeros(0, np.uint8))
    assert np.abs(same - frames).max() < 1e-5


def test_strokes_fall_by_6_db_and_more_and_the_band_by_less_than_2() -> None:
    """Drums alone, and the band alone, as the gains of each by itself: they are at least what the mix gets."""
    made, at_s, pieces = song()
    drums, mix = both_sides(made.drums), both_sides(made.mono)
    soft = softer_drums(mix, RATE_HZ, at_s, pieces)
    assert soft.shape == mix.shape
    assert db(at_strokes(mix, at_s), at_strokes(soft, at_s)) > 3.0
    assert db(at_strokes(drums, at_s), at_strokes(softer_drums(drums, RATE_HZ, at_s, pieces), at_s)) > 6.0
    band = mix - drums
    assert db(band, softer_drums(band, RATE_HZ, at_s, pieces)) < 2.0


def test_a_chord_that_lasts_is_left_alone() -> None:
    t = np.arange(4 * RATE_HZ) / RATE_HZ
    chord = both_sides(np.asarray(sum(0.1 * np.sin(2 * np.pi * f * t) for f in (220.0, 277.2, 329.6)), np.float32))
    soft = softer_drums(chord, RATE_HZ, np.array([1.0, 2.0]), np.array([0, 1], np.uint8))
    within = slice(RATE_HZ // 2, 3 * RATE_HZ)
    assert db(chord[within], soft[within]) == pytest.approx(0.0, abs=0.2)


def test_the_shortest_song_and_strokes_beyond_it_are_no_fault() -> None:
    frames = np.ones((10, 2), np.float32)
    assert softer_drums(frames, RATE_HZ, np.array([-1.0, 0.0, 99.0]), np.zeros(3, np.uint8)).shape == (10, 2)

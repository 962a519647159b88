"""A band without a click, followed through its song: the truth is what the virtual band knows."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import soxr

from station.core.errors import BadInput
from station.core.units import PPQ
from station.drills.songs.band_following import follow_band
from station.drills.songs.band_tempo import BandPoint, BandTempo
from station.music.sound_onsets import SoundOnsets
from station.simulation.bands.band_sound import RATE_HZ as SONG_HZ
from station.simulation.bands.band_sound import BandMix
from station.simulation.bands.band_timing import BandDrift
from station.simulation.bands.made_song import MadeSong, SongSpec, made_song
from station.sound.songs.onset_strength import RATE_HZ
from station.sound.songs.song_onsets import onsets_of

DRIFTING = SongSpec(seed=2, length_s=48.0, bpm=118.0, drift=BandDrift(walk=0.03))


@cache
def heard(spec: SongSpec) -> tuple[MadeSong, SoundOnsets]:
    song = made_song(spec)
    return song, onsets_of(soxr.resample(song.mono, SONG_HZ, RATE_HZ).astype(np.float32))


def points(song: MadeSong, count: int, late_s: tuple[float, ...] = ()) -> list[BandPoint]:
    """Points on bars from the first to the last but one, each by so much too late."""
    beats = np.rint(np.linspace(0, len(song.beat_s) - 9, count) / 4).astype(int) * 4
    late = late_s or (0.0,) * count
    return [BandPoint(int(song.beat_ticks[b]), float(song.beat_s[b]) + by) for b, by in zip(beats, late, strict=True)]


def misses_ms(song: MadeSong, tempo: BandTempo) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return 1e3 * np.abs(tempo.beat_s[: len(song.beat_s)] - song.beat_s)


@pytest.mark.parametrize("late_s", [(0.0,) * 5, (0.04, -0.03, 0.025, -0.045, 0.03)], ids=["exact", "tapped"])
def test_five_points_bring_the_beats_within_ten_ms(late_s: tuple[float, ...]) -> None:
    song, onsets = heard(DRIFTING)
    misses = misses_ms(song, follow_band(song.score, points(song, 5, late_s), onsets))
    assert float(np.mean(misses < 10.0)) > 0.95
    assert misses.max() < 20.0


def test_weak_attacks_everywhere_hide_no_stroke() -> None:
    """A chord that rings beats with itself: an attack of a quarter of the usual strength every 40 ms, in every band."""
    song, onsets = heard(DRIFTING)
    ringing_s = np.tile(np.arange(0.0, onsets.length_s, 0.04), 3)
    at_s = np.concatenate([onsets.at_s, ringing_s])
    order = np.argsort(at_s)
    band = np.concatenate([onsets.band, np.repeat(np.arange(3, dtype=np.int8), len(ringing_s) // 3)])
    weight = np.concatenate([onsets.weight, np.full(len(ringing_s), 0.25, np.float32)])
    ringing = replace(onsets, at_s=at_s[order], band=band[order], weight=weight[order])
    misses = misses_ms(song, follow_band(song.score, points(song, 5), ringing))
    assert float(np.mean(misses < 10.0)) > 0.95


def test_the_points_alone_would_be_far_off() -> None:
    """What the onsets bring: the song drifts so much that a curve through the same points misses beats by a quarter."""
    song, onsets = heard(DRIFTING)
    five = points(song, 5)
    by_points, by_onsets = (misses_ms(song, follow_band(song.score, five, o)).max() for o in (None, onsets))
    assert by_points > 4 * by_onsets


def test_residuals_say_how_far_each_point_is_off() -> None:
    song, onsets = heard(DRIFTING)
    late_s = (0.0, 0.04, 0.0, -0.06, 0.0)
    placed = follow_band(song.score, points(song, 5, late_s), onsets).points
    assert [p.residual_ms for p in placed] == pytest.approx([-1e3 * s for s in late_s], abs=12.0)
    assert [p.is_off for p in placed] == [False, True, False, True, False]


def test_a_point_that_is_a_bar_off_drags_nothing_along() -> None:
    song, onsets = heard(DRIFTING)
    bar_s = 4 * 60 / DRIFTING.bpm
    tempo = follow_band(song.score, points(song, 5, (0.0, 0.0, bar_s, 0.0, 0.0)), onsets)
    assert tempo.points[2].residual_ms == pytest.approx(-1e3 * bar_s, abs=25.0)
    assert float(np.mean(misses_ms(song, tempo) < 10.0)) > 0.9


@pytest.mark.parametrize("wrong", [1, 2, 3])
def test_a_point_that_is_a_beat_off_drags_nothing_along(wrong: int) -> None:
    song, onsets = heard(DRIFTING)
    beat_s = 60 / DRIFTING.bpm
    tempo = follow_band(song.score, points(song, 5, tuple(beat_s if i == wrong else 0.0 for i in range(5))), onsets)
    assert [point.is_off for point in tempo.points] == [i == wrong for i in range(5)]
    assert float(np.mean(misses_ms(song, tempo) < 10.0)) > 0.9


def test_points_alone_are_gone_through_smoothly() -> None:
    """A constant tempo of 100 in a part that is written at 120: every beat 0.6 s after the one before, from 2 s on."""
    song, _ = heard(DRIFTING)
    by_hand = [BandPoint(b * PPQ, 2.0 + 0.6 * b) for b in (0, 16, 40)]
    tempo = follow_band(song.score, by_hand, None)
    assert tempo.start_s == pytest.approx(2.0, abs=1e-3)
    assert np.abs(tempo.beat_s - (2.0 + 0.6 * np.arange(len(tempo.beat_s)))).max() < 2e-3
    assert not tempo.confidence.any()


def test_confidence_tells_music_from_silence() -> None:
    song, onsets = heard(DRIFTING)
    tempo = follow_band(song.score, points(song, 5), onsets)
    assert float(np.median(tempo.confidence)) > 0.7
    nothing = SoundOnsets(
        onsets.hop_s, 0 * onsets.strength, onsets.at_s[:0], onsets.band[:0], onsets.weight[:0], onsets.length_s
    )
    silent = follow_band(song.score, points(song, 5), nothing)
    assert not silent.confidence.any()
    assert misses_ms(song, silent)[[0, -9]].max() < 20.0


@pytest.mark.parametrize(
    ("by_hand", "fault"),
    [
        ([], "two different beats"),
        ([BandPoint(0, 1.0)], "two different beats"),
        ([BandPoint(0, 1.0), BandPoint(0, 1.1)], "two different beats"),
        ([BandPoint(0, 9.0), BandPoint(40 * PPQ, 1.0)], "backwards"),
        ([BandPoint(0, 1.0), BandPoint(4 * PPQ, 1000.0)], "of the written tempo"),
        ([BandPoint(0, 1.0), BandPoint(4 * PPQ, float("nan"))], "no number"),
    ],
)
def test_points_that_cannot_be_are_refused(by_hand: list[BandPoint], fault: str) -> None:
    song, onsets = heard(DRIFTING)
    with pytest.raises(BadInput, match=fault):
        follow_band(song.score, by_hand, onsets)


def test_early_taps_all_along_do_not_pull_the_beats() -> None:
    """A tap a beat, 30 ms early on average with 25 ms of scatter, as people tap: the attacks have the last word."""
    song, onsets = heard(DRIFTING)
    early = np.random.default_rng(1).normal(-0.03, 0.025, len(song.beat_s))
    taps = [BandPoint(int(t), float(s) + by) for t, s, by in zip(song.beat_ticks, song.beat_s, early, strict=True)]
    tempo = follow_band(song.score, taps, onsets)
    assert float(np.mean(misses_ms(song, tempo) < 10.0)) > 0.94
    assert float(np.median([p.residual_ms for p in tempo.points])) == pytest.approx(30.0, abs=6.0)


@pytest.mark.parametrize("ritard", [0.2, 0.6], ids=["by a fifth", "to five eighths of the tempo"])
def test_an_end_that_slows_down_is_followed(ritard: float) -> None:
    song, onsets = heard(SongSpec(seed=8, length_s=40.0, bpm=129.0, drift=BandDrift(ritard=ritard)))
    assert np.diff(song.beat_s)[-1] > (1.0 + 0.75 * ritard) * np.median(np.diff(song.beat_s))
    assert misses_ms(song, follow_band(song.score, points(song, 3), onsets))[-8:].max() < 30.0


def test_points_set_exactly_say_where_a_band_of_late_strums_has_its_beat() -> None:
    """No drums in the file; chords are strummed up to 20 ms late, so attacks alone are late by a part of it."""
    late_strums = SongSpec(seed=2, length_s=40.0, bpm=100.0, mix=BandMix(drums=0.0), strum_s=0.02)
    song, onsets = heard(late_strums)
    five, two = (follow_band(song.score, points(song, count), onsets) for count in (5, 2))
    late_ms = [1e3 * float(np.median(tempo.beat_s[: len(song.beat_s)] - song.beat_s)) for tempo in (five, two)]
    assert late_ms[1] > 5.0
    assert abs(late_ms[0]) < 0.35 * late_ms[1]

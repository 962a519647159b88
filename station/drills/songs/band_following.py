"""Follows a band through its song: points of a listener and the onsets of the sound give every beat its time.

First coarsely, by the whole of the evidence (`coarse_way`), then to a few milliseconds by single attacks
(`beat_smoothing`). Without onsets, or where they tell nothing, the points alone bend the tempo.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.units import PPQ
from station.drills.songs.band_tempo import BandPoint, BandTempo, PlacedPoint, tempo_map_of
from station.drills.songs.beat_smoothing import smoothed
from station.drills.songs.coarse_way import ENDING_S, GRID_S, STEP_S, Evidence, coarse_way
from station.drills.songs.expected_onsets import ExpectedOnsets, expected_onsets, leans
from station.drills.songs.point_curve import point_knots, rival_knots, through
from station.music.score import Score
from station.music.sound_onsets import SoundOnsets

Floats = NDArray[np.float64]

MOST_BEATS = 6000
"""Ten minutes at 600 a minute: what is longer is no song (our choice)."""

_GATES_S = (0.045, 0.03, 0.025)
"""How far an attack may be from where it is expected, fit by fit: the coarse way is good to 10–20 ms."""

_ATTACK_SD_S = 0.010
"""What a stroke of weight 1 strays from the band's beat (a drummer's 6–10 ms, the attack's own 2–4)."""

_POINT_SD_S = 0.025
"""What a point strays: where there are attacks they say more."""

_GIVEN_SD_S = 0.004
"""The same without any onsets: then the points are all that is known."""

_WINDOW_BEATS = 4
"""A beat's confidence is that of so many beats to both sides."""


@dataclass(frozen=True, eq=False)
class _Song:
    """What is asked: beats (n,) in ticks, in written seconds and on the points' curve, and the points (p,).

    `knots` are those of the curve.
    """

    beat_ticks: NDArray[np.int64]
    written_s: Floats
    curve_s: Floats
    point_score_s: Floats
    point_s: Floats
    knots: tuple[Floats, Floats]


def follow_band(score: Score, points: Sequence[BandPoint], onsets: SoundOnsets | None) -> BandTempo:
    """Where the band plays each quarter of `score` in the file that `onsets` are of.

    Two points at least, on different beats; a drifting song wants about five. Raises `BadInput` for points that
    cannot be of this song.
    """
    song = _song(score, points)
    if onsets is None:
        beat_s, confidence = _by_points(song), np.zeros(len(song.beat_ticks))
    else:
        beat_s, confidence = max((_heard(score, one, onsets) for one in (song, *_rival(song))), key=_found)
    tempo_map, start_s = tempo_map_of(score.tempo_map, song.beat_ticks.tolist(), beat_s.tolist())
    placed = tuple(_placed(point, start_s + float(tempo_map.seconds_at(point.tick))) for point in points)
    return BandTempo(tempo_map, start_s, song.beat_ticks, beat_s, confidence, placed)


def _heard(score: Score, song: _Song, onsets: SoundOnsets) -> tuple[Floats, Floats]:
    """Times of the beats and their confidence, from the song's curve on."""
    expected = expected_onsets(score, int(song.beat_ticks[-1]))
    at = score.tempo_map.seconds_at(expected.tick)
    beat_s, confidence = _fine(song, at, expected, onsets, _coarse(song, at, expected, onsets))
    return beat_s + _common_s(song, beat_s), confidence


def _found(heard: tuple[Floats, Floats]) -> float:
    return float(heard[1].sum())


def _rival(song: _Song) -> Sequence[_Song]:
    """The song on the curve without a point that may be wrong, if there is one: where more is found is right."""
    knots = rival_knots(song.knots)
    return () if knots is None else (replace(song, knots=knots, curve_s=through(knots, song.written_s)),)


def _song(score: Score, points: Sequence[BandPoint]) -> _Song:
    if score.end_tick > MOST_BEATS * PPQ:
        raise BadInput("song", "part", f"{score.end_tick // PPQ} beats are more than a song has ({MOST_BEATS})")
    beat_ticks = np.arange(0, max(score.end_tick, 2 * PPQ) + 1, PPQ, dtype=np.int64)
    written_s = score.tempo_map.seconds_at(beat_ticks)
    knots = point_knots(score.tempo_map, points)
    curve_s = through(knots, written_s)
    ticks, point_s = [point.tick for point in points], np.array([point.at_s for point in points])
    return _Song(beat_ticks, written_s, curve_s, score.tempo_map.seconds_at(ticks), point_s, knots)


def _by_points(song: _Song) -> Floats:
    sd_s = np.full(len(song.point_s), _GIVEN_SD_S)
    return _rising(smoothed(song.written_s, song.point_score_s, song.point_s, sd_s, song.curve_s))


def _placed(point: BandPoint, curve_s: float) -> PlacedPoint:
    return PlacedPoint(point.tick, point.at_s, 1e3 * (curve_s - point.at_s))


def _coarse(song: _Song, at: Floats, expected: ExpectedOnsets, onsets: SoundOnsets) -> Floats:
    """Times of the beats to about 10 ms; `at` (m,) are the written seconds of what is expected."""
    at_s, point_at_s = (np.interp(times, song.written_s, song.curve_s) for times in (at, song.point_score_s))
    evidence = Evidence(at_s, expected.band, expected.weight, point_at_s, song.point_s, 1.0 / _crowd(song))
    steps_s = _steps(song.curve_s)
    return song.curve_s + np.interp(song.curve_s, steps_s, coarse_way(steps_s, evidence, _on_grid(onsets)))


def _crowd(song: _Song) -> Floats:
    """How many points are within `_CROWD_S` of each (p,), itself among them: together they count as one."""
    at_s = song.point_score_s
    return np.asarray((np.abs(at_s[:, None] - at_s[None, :]) < _CROWD_S).sum(axis=1), np.float64)


_CROWD_S = 4.0
"""Taps one after another lean to the same side, and are no better than one good point (our choice)."""


def _common_s(song: _Song, beat_s: Floats) -> float:
    """By how much all beats move to the points: fully where these agree with one another, hardly where they scatter.

    Attacks say where one instrument begins, and a listener where the beat is. Points set by ear that are all late by
    8 ms tell of strummed chords; taps tell of whoever taps, and move nothing.
    """
    late_s = song.point_s - np.interp(song.point_score_s, song.written_s, beat_s)
    right = late_s[np.abs(late_s) < _WRONG_S]
    if len(late_s) >= _FEWEST_TAPS or len(right) < _FEWEST_RIGHT:
        return 0.0
    error_s = _FEW_ARE_UNSURE * max(float(right.std(ddof=1)), _LEAST_SCATTER_S) / np.sqrt(len(right))
    return float(right.mean() * _LEAN_SD_S**2 / (_LEAN_SD_S**2 + error_s**2))


_WRONG_S, _FEWEST_RIGHT = 0.1, 4
"""A point that is farther off is a wrong one; the rest of so few do not tell how they scatter (our choice)."""

_LEAN_SD_S, _LEAST_SCATTER_S = 0.005, 0.004
"""What attacks lean from the beat (strums last 10–20 ms), and how well a point is set at best (our choice)."""

_FEW_ARE_UNSURE = 1.5
"""The scatter of five points is itself known to a third: Student's 68 % of four degrees of freedom is 1.14 SD, his 95 %
2.8 instead of 2 (our choice between)."""


def _point_lean_s(song: _Song, beat_s: Floats) -> float:
    """How late all points are together: people who tap are early by 20–50 ms; 0 for a few."""
    if len(song.point_s) < _FEWEST_TAPS:
        return 0.0
    return float(np.median(song.point_s - np.interp(song.point_score_s, song.written_s, beat_s)))


_FEWEST_TAPS = 8
"""Fewer points are set one by one, and mean what they say."""


def _steps(curve_s: Floats) -> Floats:
    """Every beat that is `STEP_S` or more after the one before, in the ending half of it; the last one among them."""
    steps, last_s = [float(curve_s[0])], float(curve_s[-1])
    for at_s in curve_s[1:].tolist():
        if at_s - steps[-1] >= (STEP_S if at_s < last_s - ENDING_S else STEP_S / 2):
            steps.append(at_s)
    return np.array([*steps[: max(1, len(steps) - 1)], last_s])


def _on_grid(onsets: SoundOnsets) -> NDArray[np.float32]:
    """The strengths in columns of `GRID_S`, the greatest of those around each."""
    step = round(GRID_S / onsets.hop_s)
    wide = np.pad(onsets.strength, ((0, 0), (step, step + step)))
    windows = np.lib.stride_tricks.sliding_window_view(wide, 2 * step + 1, axis=1)[:, ::step]
    return np.asarray(np.minimum(windows.max(axis=2), _MOST_STRENGTH))


_MOST_STRENGTH = np.float32(1.5)
"""One loud crash says no more than one and a half usual attacks."""


def _fine(
    song: _Song, at: Floats, expected: ExpectedOnsets, onsets: SoundOnsets, beat_s: Floats
) -> tuple[Floats, Floats]:
    """Times of the beats by single attacks, and their confidence."""
    is_near, lean_s = np.zeros(len(at), np.bool_), np.zeros(len(at))
    sd_s = _ATTACK_SD_S / np.sqrt(np.maximum(expected.weight, 1e-3))
    point_sd_s = _POINT_SD_S * np.sqrt(_crowd(song))
    for gate_s in _GATES_S:
        seen_s, worth = _heard_near(np.interp(at, song.written_s, beat_s) + lean_s, expected, onsets, gate_s)
        is_near = worth > 0.0
        own_sd_s = sd_s[is_near] / worth[is_near]
        times = np.concatenate([at[is_near], song.point_score_s])
        seen = np.concatenate([(seen_s - lean_s)[is_near], song.point_s - _point_lean_s(song, beat_s)])
        beat_s = _rising(smoothed(song.written_s, times, seen, np.concatenate([own_sd_s, point_sd_s]), beat_s))
        lean_s = leans(expected, np.where(is_near, seen_s - np.interp(at, song.written_s, beat_s), np.nan))
    return beat_s, _confidence(at, expected, is_near, onsets, song.written_s)


def _heard_near(at_s: Floats, expected: ExpectedOnsets, onsets: SoundOnsets, gate_s: float) -> tuple[Floats, Floats]:
    """The attack of its own band that is likeliest meant at each expected time (n,), and its worth: 0 where none is.

    Likeliest is a strong one near by: weak ones stand everywhere, for a chord that rings beats with itself.
    """
    seen_s, worth = at_s.copy(), np.zeros(len(at_s))
    for band in range(len(onsets.strength)):
        is_own, own = onsets.band == band, expected.band == band
        if not is_own.any():
            continue
        times, strong = onsets.at_s[is_own], np.minimum(onsets.weight[is_own], _MOST_STRENGTH)
        which = np.searchsorted(times, at_s[own])[:, None] + np.arange(-_AROUND, _AROUND)
        which = np.clip(which, 0, len(times) - 1)
        near = 1.0 - np.square((times[which] - at_s[own, None]) / gate_s)
        score = strong[which] * np.maximum(near, 0.0)
        best = np.take_along_axis(which, np.argmax(score, axis=1)[:, None], axis=1)[:, 0]
        seen_s[own], worth[own] = times[best], np.where(score.max(axis=1) > 0.0, strong[best], 0.0)
    return seen_s, worth


_AROUND = 3
"""Attacks of a band to both sides that are looked at: they are 40 ms apart, the gate is 45 wide."""


def _confidence(
    at: Floats, expected: ExpectedOnsets, is_near: NDArray[np.bool_], onsets: SoundOnsets, written_s: Floats
) -> Floats:
    """Share of what is expected around each beat that was found, less what chance finds: 0 … 1, (beats,)."""
    counts = np.bincount(onsets.band, minlength=len(onsets.strength))
    chance = np.minimum(0.9, counts / max(onsets.length_s, 1.0) * 2 * _GATES_S[-1])[expected.band]
    beat = np.clip(np.searchsorted(written_s, at, side="right") - 1, 0, len(written_s) - 1)
    found = np.bincount(beat, expected.weight * (is_near - chance), len(written_s))
    possible = np.bincount(beat, expected.weight * (1 - chance), len(written_s))
    window = np.ones(2 * _WINDOW_BEATS + 1)
    sums = [np.convolve(np.pad(v, _WINDOW_BEATS), window, "valid") for v in (found, possible)]
    return np.asarray(np.clip(sums[0] / np.maximum(sums[1], 1e-9), 0.0, 1.0))


def _rising(beat_s: Floats) -> Floats:
    """`beat_s` (n,), each at least `_LEAST_BEAT_S` after the one before."""
    steps = np.arange(len(beat_s)) * _LEAST_BEAT_S
    return np.asarray(np.maximum.accumulate(beat_s - steps) + steps)


_LEAST_BEAT_S = 0.02
"""3000 a minute: points that run back may not turn time around."""

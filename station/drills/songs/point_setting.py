"""How a listener sets points: taps along with the sound, a rough one drawn to the attack it means, a nudge by ear."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.units import PPQ
from station.drills.songs.band_tempo import BandPoint
from station.drills.songs.expected_onsets import expected_onsets
from station.music.score import Score
from station.music.sound_onsets import SoundOnsets

Floats = NDArray[np.float64]

SNAP_REACH_S = 0.06
"""How far a point may move to an attack: taps scatter by 20–30 ms, so this is two of their SD."""

_TOGETHER_S = 0.012
"""Attacks of several bands that are so near are one: a flam is wider (our choice)."""

_FAR_SHARE = 0.5
"""An attack at the end of the reach counts half of one at the point."""

_MOST_WEIGHT = 1.5
"""As `band_following` has it: a crash says no more than one and a half usual attacks."""

_BOUNCE = 0.4
"""Of a beat: a tap that soon after another is a bounce of the finger or the key (our choice)."""

_PERIOD_TAPS = 5
"""The tapped beat is the median of so many intervals: one forgotten tap does not move it."""


def nudged(point: BandPoint, by_ms: float) -> BandPoint:
    """`point` moved by ear: later by `by_ms`."""
    return replace(point, at_s=point.at_s + by_ms / 1e3)


def snapped(score: Score, point: BandPoint, onsets: SoundOnsets) -> BandPoint:
    """`point` at the attack, within `SNAP_REACH_S`, that fits best what is written there; itself where none is.

    What fits: near, loud, and in the bands that the pieces of that tick start; together in several of them is better.
    """
    expected = expected_onsets(score, point.tick + 1, point.tick)
    likely = np.zeros(len(onsets.strength))
    likely[expected.band] = expected.weight
    first, end = np.searchsorted(onsets.at_s, (point.at_s - SNAP_REACH_S, point.at_s + SNAP_REACH_S))
    at_s = onsets.at_s[first:end]
    worth = likely[onsets.band[first:end]] * np.minimum(onsets.weight[first:end], _MOST_WEIGHT)
    if not worth.any():
        return point
    near = worth * (1.0 - (1.0 - _FAR_SHARE) * np.square((at_s - point.at_s) / SNAP_REACH_S))
    together = np.abs(at_s[:, None] - at_s[None, :]) < _TOGETHER_S
    best = together[int(np.argmax(together @ near))]
    return replace(point, at_s=float(np.average(at_s[best], weights=np.maximum(worth[best], 1e-9))))


def points_of_taps(
    taps_s: Sequence[float], first_tick: int, beat_ticks: int = PPQ, late_s: float = 0.0
) -> tuple[BandPoint, ...]:
    """Points of taps at `taps_s` (seconds of the file, any order), one a beat, the first on `first_tick`.

    `late_s` is how late taps arrive, the sound's way out and the key's way in: it is taken off. Forgotten taps leave
    their beats out, bounces are dropped. Raises `BadInput` for fewer than two beats.
    """
    taps = np.unique(np.asarray(taps_s, np.float64))
    if len(taps):
        period = float(np.median(np.diff(taps))) if len(taps) > 1 else 0.0
        taps = taps[np.concatenate([[True], np.diff(taps) > _BOUNCE * period])]
    if len(taps) < 2:
        raise BadInput("taps", "", f"{len(taps)} of them tell no tempo: tap at least two beats")
    beats = _beats(taps)
    return tuple(
        BandPoint(first_tick + beat * beat_ticks, at_s - late_s)
        for beat, at_s in zip(beats, taps.tolist(), strict=True)
    )


def _beats(taps: Floats) -> list[int]:
    """The beat, from 0, of each tap (n,), n ≥ 2: forgotten ones counted."""
    gaps = np.diff(taps)
    period, steps = float(np.median(gaps)), [0]
    recent: list[float] = []
    for gap in gaps.tolist():
        step = max(1, round(gap / period))
        recent = [*recent, gap / step][-_PERIOD_TAPS:]
        period = float(np.median(recent)) if len(recent) >= _PERIOD_TAPS else period
        steps.append(steps[-1] + step)
    return steps

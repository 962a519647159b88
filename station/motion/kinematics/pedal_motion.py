"""The two footboards over time: the kick's stroke with its beater, the hi-hat's opening, closing and chick.

A board's value is 1 raised (as its spring holds it) … 0 pressed down. The kick's beater follows its board by the chain
and touches the head at 0. Like the hands' strokes the keys are Kochanek–Bartels with continuity broken at the impact.
The hi-hat opens 60–100 ms before its open note and closes exactly on the chick (HUMANS: gap open 2–4 cm).
"""

import math

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Piece
from station.motion.kinematics.splines import SplineChannels, cubics, slopes
from station.motion.kit.kit import Kit
from station.music.score import Score

Array = NDArray[np.float64]

BEATER_SWING_RAD = math.radians(60.0)
"""How far a raised board holds the beater back (HUMANS: 60° in 45 ms)."""
OPEN_GAP_M = 0.035
"""Between the cymbals of a hi-hat that is wide open (2–4 cm)."""

_KICK_KEYS_S = np.array([-0.16, -0.045, 0.0, 0.06, 0.14])
"""Rest, top, strike, rebound, rest again: 45 ms down and a spring's way back (our choice)."""
_KICK_SHARES = np.array([0.85, 1.0, 0.0, 0.5, 0.85])
_BURIED_KEYS_S = np.array([-0.16, -0.045, 0.0, 0.11, 0.24])
_BURIED_SHARES = np.array([0.85, 1.0, 0.0, 0.0, 0.85])
_SOFTEST_SWING = 0.45
"""The share of the full swing that the softest kick takes (our choice)."""
_KICK_TENSION, _HAT_TENSION = -0.7, -0.5
"""Of the splines at the impact: the beater arrives with 1.7 times its mean speed (HUMANS: 2267°/s after 60° in 45 ms),
the hi-hat's foot with 1.5 times (our choice)."""
_LATEST_TOP = 0.75
"""In quick kicks the way up is shortened before the way down: at most to this share of both (our choice)."""
_FASTEST_PER_S = 1 / 0.045
"""No board goes its way quicker than the measured kick's beater (HUMANS); for what comes sooner it opens less."""
_OPENING_S = 0.080
_CLOSING_S = 0.060
_CHICK_LIFT = 0.5
_CHICK_LIFT_S = 0.14


def kick_board(times_s: Array, velocity: Array, buried: bool) -> SplineChannels:
    """The kick's board over time from its strikes (n,), in order, and their velocities 1–127.

    A `buried` beater stays on the head for a moment instead of rebounding.
    """
    if not len(times_s):
        return still(float(_KICK_SHARES[0]))
    gaps = np.concatenate(([10.0], np.diff(times_s), [10.0]))
    keys, shares = (_BURIED_KEYS_S, _BURIED_SHARES) if buried else (_KICK_KEYS_S, _KICK_SHARES)
    squeeze_before = np.minimum(1.0, 0.5 * gaps[:-1] / -keys[0])
    squeeze_after = np.minimum(1.0, 0.45 * gaps[1:] / keys[-1])
    swing = (_SOFTEST_SWING + (1 - _SOFTEST_SWING) * velocity / 127) * np.minimum(1.0, gaps[:-1] / 0.12)
    squeeze = np.where(keys < 0, squeeze_before[:, None], squeeze_after[:, None])
    squeeze[:, 1] = np.minimum(1.0, _LATEST_TOP * squeeze_before * keys[0] / keys[1])
    times = times_s[:, None] + keys * squeeze
    values = shares * swing[:, None]
    at_rest = shares[0]
    values[:, 0] = at_rest * squeeze_before + values[:, 0] * (1 - squeeze_before)
    values[:, -1] = at_rest * squeeze_after + values[:, -1] * (1 - squeeze_after)
    continuity = np.tile([0.0, 0.0, -1.0, 0.0, 0.0], len(times_s))
    return _curve(times.reshape(-1), values.reshape(-1), continuity, _KICK_TENSION)


def hat_board(score: Score, onset_s: Array) -> SplineChannels:
    """The hi-hat's board over time: open for open notes, shut for closed ones, down on every chick."""
    notes = score.notes
    keys: list[tuple[float, float, float]] = []  # time, value, continuity
    level, last = 0.0, -10.0
    hats = np.flatnonzero((notes["piece"] == Piece.HIHAT) | (notes["piece"] == Piece.HIHAT_PEDAL))
    for row in hats[np.argsort(onset_s[hats], kind="stable")].tolist():
        at, gap = float(onset_s[row]), float(onset_s[row]) - last
        if notes["piece"][row] == Piece.HIHAT_PEDAL:
            lift = max(level, _CHICK_LIFT if gap > 0.05 else 0.0)
            if gap > 0.02:
                keys += [(at - min(_CHICK_LIFT_S, 0.6 * gap), level, 0.0), (at - min(_CLOSING_S, 0.3 * gap), lift, 0.0)]
            keys.append((at, 0.0, -1.0))
            level = 0.0
            if notes["articulation"][row] == Articulation.SPLASH:
                keys.append((at + 0.06, 0.6, 0.0))
                level = 0.6
        else:
            openness = notes["openness"][row]
            wanted = 0.0 if np.isnan(openness) else float(openness)
            if wanted != level and gap > 0.02:
                moving = _OPENING_S if wanted > level else _CLOSING_S
                keys += [(at - min(moving, 0.6 * gap), level, -1.0), (at, wanted, -1.0)]
                level = wanted
        last = at
    if not keys:
        return still(0.0)
    table = np.array(keys)
    return _curve(np.maximum.accumulate(table[:, 0]), table[:, 1], table[:, 2], _HAT_TENSION)


BEATER_LENGTH_M, BEATER_HALF_M = 0.20, 0.016
"""From the axle to the middle of the beater, and half its thickness; common pedals set the first to 19–22 cm."""


def beater_m(kit: Kit, angle_rad: float, slave: bool = False) -> Array:
    """The middle of the beater's striking face, or the slave's, which is on the kick's head at angle 0."""
    head = kit.pieces[Piece.KICK].centre + (kit.second_beater_m if slave else 0.0)
    sine, cosine = math.sin(angle_rad), math.cos(angle_rad)
    forward = BEATER_HALF_M * cosine - BEATER_LENGTH_M * sine
    up = BEATER_HALF_M * sine + BEATER_LENGTH_M * cosine
    moved: Array = head + np.array([0.0, forward - BEATER_HALF_M, up - BEATER_LENGTH_M])
    return moved


def still(value: float) -> SplineChannels:
    """A board that does not move."""
    return SplineChannels(np.zeros(1), np.array([[[value, 0.0, 0.0, 0.0]]]))


def _curve(times: Array, values: Array, continuity: Array, impact: float) -> SplineChannels:
    """A curve that stops at every key, but comes to the head, or the other cymbal, with the speed of `impact`."""
    values = _slower(times, values)
    struck = (continuity == -1.0) & (values == 0.0)
    into, out = slopes(times, values, np.where(struck, impact, 1.0), continuity)
    return SplineChannels(times, cubics(times, values, into, out)[:, None, :])


def _slower(times: Array, values: Array) -> Array:
    """The greatest values under `values` (n,) that change no faster than a foot; what is shut stays shut."""
    rise = _FASTEST_PER_S * (times - times[0])
    before = np.minimum.accumulate(values - rise) + rise
    after = np.minimum.accumulate((values + rise)[::-1])[::-1] - rise
    return np.asarray(np.minimum(before, after))

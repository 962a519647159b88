"""Where the drummer looks: eyes and head lead a move to another piece and never follow an ostinato.

A piece is news when nobody has struck it for a bar and a while; the head is on it 200–300 ms before the stroke and
comes back to the middle of what is played. In long rests it may look around, as chance decides.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.splines import SplineChannels, cubics, slopes

Array = NDArray[np.float64]

NEWS_S, NEWS_BARS = 1.6, 1.1
"""A piece that was struck within this time and within so many bars is no news: what comes every bar is an ostinato, be
it ever so slow (our choice)."""
LEAD_S = 0.3
"""The head is turned this long before the stroke (what drummers look for: 200–300 ms); it sets out 200 ms earlier."""
MOVE_S = 0.22
"""A turn of the head takes so long (our choice)."""
PEAK, FASTEST_RAD_S = 1.5, 6.0
"""The peak speed of a turn over its mean, and what a head should not pass: 340°/s, well under vigorous shaking's 540
(`limits`)."""
STAY_S = 0.7
"""It stays with the piece after the stroke, then comes back (our choice)."""
REST_S = 3.2
LOOK_AFTER_S = 1.8
ASIDE_RAD, DOWN_RAD = 0.9, 0.2
"""In rests of this length the drummer may look around, so long after the last stroke, so far to either side, and up to
that far down or half as far up (our choice)."""


PLACES: Mapping[str, Array] = MappingProxyType(
    {
        "hands": np.array([0.10, 0.85]),  # the left hand on the snare
        "friend": np.array([0.95, -0.02]),  # the bass player beyond the hi-hat
        "audience": np.array([0.0, -0.08]),
        "above": np.array([-0.25, -0.40]),  # far away, the chin up
    }
)
"""Where the look goes, bearing to the left and pitch down, but for "kit": half the way to one of the pieces in play
(our choice)."""
HOME_SHARE = 0.7
"""Who looks somewhere all the time has the head so far there in between (our choice)."""
GLANCE_S, GLANCE_STAY_S, GLANCE_SPREAD_RAD = 2.2, (0.5, 1.8), 0.15
"""Seconds from glance to glance of one who looks around all the time, how long one stays and how they scatter."""


@dataclass(frozen=True, eq=False)
class GazeTargets:
    """What there is to look at: the hands' strikes in order.

    `strike_s` (n,), `place` (n,) which piece, `direction` (n, 2) bearing and downward pitch to it from the eyes, and
    `bar_s` (n,) how long the bar is.
    """

    strike_s: Array
    place: NDArray[np.int64]
    direction: Array
    bar_s: Array


def gaze_curve(sights: GazeTargets, around: Array, seed: int, attention: str = "kit") -> SplineChannels:
    """Bearing and downward pitch of the look over time, radians in space.

    `around` (n,) or (1,), 0 … 1, is how likely a long rest before each strike is used to look around, and how often the
    drummer looks where the style's `attention` is while the hands play on.
    """
    strike_s, direction = sights.strike_s, sights.direction
    if not len(strike_s):
        return SplineChannels(np.zeros(1), np.array([[[0.0, 0, 0, 0], [0.35, 0, 0, 0]]]))
    around = np.broadcast_to(around, strike_s.shape)
    middle = np.median(direction, axis=0)
    homes = middle + HOME_SHARE * around[:, None] * (PLACES.get(attention, middle) - middle)
    keys: list[tuple[float, float, float]] = [(float(strike_s[0]) - 60.0, *homes[0].tolist())]
    looks = sorted([*_looks(sights, around, seed), *_glances(sights, around, middle, seed, attention)])
    after = np.minimum(np.searchsorted(strike_s, [at for at, *_ in looks]), len(strike_s) - 1)
    for (at, stay, look), home in zip(looks, homes[after].tolist(), strict=True):
        turn = max(abs(look[0] - keys[-1][1]), abs(look[1] - keys[-1][2]))
        least_s = max(PEAK * turn / FASTEST_RAD_S, 0.1)
        start = max(at - LEAD_S - max(MOVE_S, least_s), keys[-1][0] + 0.02)
        if start > at - 0.05 or start + least_s > at:  # the head has not come back yet: it stays where it is
            continue
        keys += [(start, *keys[-1][1:]), (max(at - LEAD_S, start + least_s), *look)]
        keys += [(at + stay, *look), (at + stay + 2 * MOVE_S, *home)]
    table = np.array(keys)
    times, values = table[:, 0], np.ascontiguousarray(table[:, 1:].T)
    into, out = slopes(np.broadcast_to(times, values.shape), values, 0.9)
    return SplineChannels(times, np.ascontiguousarray(np.moveaxis(cubics(times[None], values, into, out), 0, 1)))


Look = tuple[float, float, tuple[float, float]]
"""When the head is to be there, `LEAD_S` before, how long it stays after, and where it looks."""


def _looks(sights: GazeTargets, around: Array, seed: int) -> list[Look]:
    """At each piece that is news, before it is struck; and in long rests somewhere, by chance."""
    strike_s, place = sights.strike_s, sights.place
    order = np.argsort(place, kind="stable")  # each piece's strikes in order
    last = np.full(len(strike_s), -np.inf)
    last[order[1:]] = np.where(np.diff(place[order]) == 0, strike_s[order[:-1]], -np.inf)
    is_news = strike_s - last > np.maximum(NEWS_BARS * sights.bar_s, NEWS_S)
    looks = [
        (at, STAY_S, (look[0], look[1]))
        for at, look in zip(strike_s[is_news].tolist(), sights.direction[is_news].tolist(), strict=True)
    ]
    drawn, aside, down = np.random.default_rng(seed).random((len(strike_s), 3)).T
    before = np.concatenate((strike_s[:1], strike_s[:-1]))
    for k in np.flatnonzero((strike_s - before > REST_S) & (drawn < around)).tolist():
        somewhere = ASIDE_RAD * (2 * float(aside[k]) - 1), DOWN_RAD * (2 * float(down[k]) - 0.5)
        looks.append((float(before[k]) + LOOK_AFTER_S, STAY_S, somewhere))
    return looks


def _glances(sights: GazeTargets, around: Array, middle: Array, seed: int, attention: str) -> list[Look]:
    """Where the style's attention goes from the `middle` while the hands play on: now and then, by chance."""
    strike_s = sights.strike_s
    first, last = float(strike_s[0]), float(strike_s[-1]) - GLANCE_STAY_S[1] - 1.0
    count = int(max(last - first, 0.0) / GLANCE_S * 1.5) + 1
    steps, stays, aside, picks, drawn = np.random.default_rng([seed, 9]).random((5, count))
    times = first + np.cumsum((0.4 - 0.6 * np.log(1 - steps)) * GLANCE_S)
    kept = (times < last) & (drawn < around[np.searchsorted(strike_s, times).clip(max=len(strike_s) - 1)])
    near = 0.5 * (middle + sights.direction[(picks[kept] * len(sights.direction)).astype(int)])
    where = np.broadcast_to(PLACES.get(attention, near), near.shape).copy()
    where[:, 0] += GLANCE_SPREAD_RAD * (2 * aside[kept] - 1)
    stay = GLANCE_STAY_S[0] + stays[kept] * (GLANCE_STAY_S[1] - GLANCE_STAY_S[0])
    columns = (times[kept].tolist(), stay.tolist(), where.tolist())
    return [(at, stays_s, (bearing, pitch)) for at, stays_s, (bearing, pitch) in zip(*columns, strict=True)]

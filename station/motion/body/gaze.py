"""Where the drummer looks: eyes and head lead a move to another piece and never follow an ostinato.

A piece is news when nobody has struck it for a bar and a while; the head is on it 200–300 ms before the stroke and
comes back to the middle of what is played. In long rests it may look around, as chance decides.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.motion.kinematics.splines import SplineChannels, cubics, slopes

Array = NDArray[np.float64]

NEWS_S, NEWS_BARS = 1.6, 1.1
"""A piece that was struck within this time and within so many bars is no news: what comes every bar is an ostinato, be
it ever so slow (our choice)."""
LEAD_S = 0.25
"""The head is turned this long before the stroke (what drummers look for: 200–300 ms)."""
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


def gaze_curve(sights: GazeTargets, around: Array, seed: int) -> SplineChannels:
    """Bearing and downward pitch of the look over time, radians in space.

    `around` (n,), 0 … 1, is how likely a long rest before each strike is used to look around.
    """
    strike_s, direction = sights.strike_s, sights.direction
    if not len(strike_s):
        return SplineChannels(np.zeros(1), np.array([[[0.0, 0, 0, 0], [0.35, 0, 0, 0]]]))
    home = np.median(direction, axis=0)
    keys: list[tuple[float, float, float]] = [(float(strike_s[0]) - 60.0, *home)]
    for at, look in _looks(sights, around, seed):
        turn = max(abs(look[0] - keys[-1][1]), abs(look[1] - keys[-1][2]))
        least_s = max(PEAK * turn / FASTEST_RAD_S, 0.1)
        start = max(at - LEAD_S - max(MOVE_S, least_s), keys[-1][0] + 0.02)
        if start > at - 0.05 or start + least_s > at:  # the head has not come back yet: it stays where it is
            continue
        keys += [(start, *keys[-1][1:]), (max(at - LEAD_S, start + least_s), *look)]
        keys += [(at + STAY_S, *look), (at + STAY_S + 2 * MOVE_S, *home)]
    table = np.array(keys)
    times, values = table[:, 0], np.ascontiguousarray(table[:, 1:].T)
    into, out = slopes(np.broadcast_to(times, values.shape), values, 0.9)
    return SplineChannels(times, np.ascontiguousarray(np.moveaxis(cubics(times[None], values, into, out), 0, 1)))


def _looks(sights: GazeTargets, around: Array, seed: int) -> list[tuple[float, tuple[float, float]]]:
    """What the drummer looks at, and when it is struck; in order of time."""
    looks = []
    last = np.full(int(sights.place.max()) + 1, -np.inf)
    random = np.random.default_rng(seed).random((len(sights.strike_s), 3))
    before = float(sights.strike_s[0])
    old = np.maximum(NEWS_BARS * sights.bar_s, NEWS_S)
    columns = (sights.strike_s, sights.place, sights.direction, old, np.broadcast_to(around, old.shape), random)
    for at, where, look, news, chance, (drawn, aside, down) in zip(*(c.tolist() for c in columns), strict=True):
        if at - before > REST_S and drawn < chance:
            looks.append((before + LOOK_AFTER_S, (ASIDE_RAD * (2 * aside - 1), DOWN_RAD * (2 * down - 0.5))))
        if at - last[where] > news:
            looks.append((at, (look[0], look[1])))
        last[where] = before = at
    return looks

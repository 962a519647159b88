"""Where the drummer looks: eyes and head lead a move to another piece and never follow an ostinato.

A piece is news when nobody has struck it for a while; the head is on it 200–300 ms before the stroke and comes back to
the middle of what is played. In long rests it may look around, as chance decides.
"""

import numpy as np
from numpy.typing import NDArray

from station.motion.splines import Curves, cubics, slopes

Array = NDArray[np.float64]

NEWS_S = 1.6
"""A piece that was struck within this time is no news (our choice: two beats at 75 bpm)."""
LEAD_S = 0.25
"""The head is turned this long before the stroke (what drummers look for: 200–300 ms)."""
MOVE_S = 0.22
"""A turn of the head takes so long (our choice)."""
STAY_S = 0.7
"""It stays with the piece after the stroke, then comes back (our choice)."""
REST_S = 3.2
LOOK_AFTER_S = 1.8
"""In rests of this length the drummer may look around, so long after the last stroke (our choice)."""


def gaze_curve(strike_s: Array, place: NDArray[np.int64], direction: Array, around: float, seed: int) -> Curves:
    """Bearing and downward pitch of the look over time, radians in space.

    `strike_s` (n,) of the hands in order, `place` (n,) which piece, `direction` (n, 2) bearing and pitch to it;
    `around` 0 … 1 how likely a long rest is used to look around.
    """
    if not len(strike_s):
        return Curves(np.zeros(1), np.array([[[0.0, 0, 0, 0], [0.35, 0, 0, 0]]]))
    home = np.median(direction, axis=0)
    keys: list[tuple[float, float, float]] = [(float(strike_s[0]) - 60.0, *home)]
    for at, look in _looks(strike_s, place, direction, around, seed):
        start = max(at - LEAD_S - MOVE_S, keys[-1][0] + 0.02)
        if start > at - 0.05:  # the head has not come back yet: it stays where it is
            continue
        keys += [(start, *keys[-1][1:]), (max(at - LEAD_S, start + 0.1), *look)]
        keys += [(at + STAY_S, *look), (at + STAY_S + 2 * MOVE_S, *home)]
    table = np.array(keys)
    times, values = table[:, 0], np.ascontiguousarray(table[:, 1:].T)
    into, out = slopes(np.broadcast_to(times, values.shape), values, 0.9)
    return Curves(times, np.ascontiguousarray(np.moveaxis(cubics(times[None], values, into, out), 0, 1)))


def _looks(
    strike_s: Array, place: NDArray[np.int64], direction: Array, around: float, seed: int
) -> list[tuple[float, tuple[float, float]]]:
    """What the drummer looks at, and when it is struck; in order of time."""
    looks = []
    last = np.full(int(place.max()) + 1, -np.inf)
    random = np.random.default_rng(seed)
    before = float(strike_s[0])
    for at, where, look in zip(strike_s.tolist(), place.tolist(), direction.tolist(), strict=True):
        if at - before > REST_S and random.random() < around:
            looks.append((before + LOOK_AFTER_S, (float(random.uniform(-0.9, 0.9)), float(random.uniform(-0.1, 0.3)))))
        if at - last[where] > NEWS_S:
            looks.append((at, (look[0], look[1])))
        last[where] = before = at
    return looks

"""The heels that keep time: where a foot has nothing to play, its heel rises between the beats and falls on them.

The ball stays on its board, so that a closed hi-hat stays closed. In quick music the heel rises less.
"""

import numpy as np
from numpy.typing import NDArray

from station.motion.body.body_keys import Ground
from station.motion.kinematics.leg import ROCK_RAD
from station.motion.kinematics.splines import SplineChannels, cubics
from station.motion.style.style import Style

Array = NDArray[np.float64]

KICK_SHARE = 0.5
"""The kick's foot, which rests more, does it by this share (our choice)."""
FULL_BEAT_S = 0.5
"""In beats shorter than this the heel rises less, by as much (our choice: full up to 120 a minute)."""
CLEAR_S = 0.15
"""Before and after what the foot plays the heel does not rock: a kick's upswing takes 0.16 s."""


def heel_curves(ground: Ground, style: Style, busy_s: tuple[Array, Array]) -> SplineChannels:
    """How far the soles of the kick's and the hi-hat's foot are tipped, radians; two channels.

    `busy_s` are the times at which each foot plays or moves, in order.
    """
    times = ground.time_s
    beats = times[::2]
    slow = np.minimum(1.0, np.diff(beats) / FULL_BEAT_S)
    amount = style.factor("amplitude_heel", ground.bars[1::2]) * ROCK_RAD * slow
    values = np.zeros((2, len(times)))
    for channel, (busy, share) in enumerate(zip(busy_s, (KICK_SHARE, 1.0), strict=True)):
        first, last = np.searchsorted(busy, beats[:-1] - CLEAR_S), np.searchsorted(busy, beats[1:] + CLEAR_S)
        values[channel, 1::2] = share * amount * (first == last)
    level = np.zeros(values.shape)
    return SplineChannels(times, np.ascontiguousarray(np.moveaxis(cubics(times[None], values, level, level), 0, 1)))

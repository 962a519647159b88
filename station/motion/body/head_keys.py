"""The head's keyframes under a style: nods to the beat, to 2 and 4 or to 1 and 3, tilts, the chin, head-banging.

Down on the beat by the music's cofactors and up between (thesis § 4.2.1, figure 4.13); before the music starts again
after a silence it lifts.
"""

import numpy as np
from numpy.typing import NDArray

from station.motion.body.beats import on_odd_beats
from station.motion.body.body_keys import SPLINE_RUSH, Ground, fallen, limited, shifted, spline
from station.motion.kinematics.joint_limits import FASTEST_RAD_S
from station.motion.kinematics.splines import SplineChannels
from station.motion.kinematics.wander import wander
from station.motion.style.style import Style

Array = NDArray[np.float64]

BOB_RAD, TILT_RAD, CHIN_RAD = np.radians((9.0, 6.0, 28.0))
"""Bob and tilt of the head at the natural setting, and how far the chin's control pushes the neck forward on the beat
(our choice)."""
BANG_RAD, BANG_BACK = np.radians(38.0), 0.45
"""A head that bangs goes down so far at most, and back by this share: 55° in all of a neck's 110 (our choice)."""
LIFT = 0.5
"""Before the music starts again the head goes back by this share of a full bob (a wish of SMED's users; our choice)."""
UP_BETWEEN = 0.4
"""On the beats that the style leaves out the head goes back by this share of a bob (our choice)."""
SLOW_BOB, FAST_BOB = 0.75, 1.5
"""Under and from so many bobs a beat the head bobs on every other beat and on the half beats."""
DRIFT = 0.18
"""How much chance makes nods deeper and flatter (our choice: more than strokes, for nobody aims with the head)."""
_NECK_RAD = np.radians((-35.0, 28.0))
"""How far the nod goes back and down of its own; looking down adds up to 32° (necks bend 50–60° each way)."""
_MOST_RAD_S = 0.9 * FASTEST_RAD_S["head_nod"] / SPLINE_RUSH
"""No nod is faster than vigorous shaking."""


def head_curve(ground: Ground, style: Style) -> SplineChannels:
    """Nod (down), tilt (to the right) and the neck's push forward, radians, over time."""
    times, bars = _with_quarters(shifted(ground, style)), _with_quarters(ground.bars)
    place = np.arange(len(times)) % 4  # beat, quarter, middle, quarter
    rate = style.value("bobs_per_beat", bars)
    slow, fast = rate < SLOW_BOB, rate >= FAST_BOB
    odd = np.repeat(on_odd_beats(ground.beats), 4)[: len(times)]
    share = _share(style.value("backbeat", bars), odd, slow)
    beat, half = place == 0, (place == 2) & fast
    share = np.where(half, 1.0, share * beat)
    bang = style.value("headbang", bars) / 100 * BANG_RAD
    amount = style.factor("amplitude_neck", bars) * BOB_RAD
    drift = 1 + DRIFT * style.factor("variation", bars) * wander((style.seed, 6), 1, len(times))[0]
    bob = amount * _with_quarters(ground.bob) * drift
    lift = np.zeros(len(times))
    lift[2::4] = -LIFT * ground.restart[1:]
    up = np.where(
        beat, -UP_BETWEEN * (1 - share) * (0.5 * bob + bang), amount * lift - BANG_BACK * bang * (place == 2) * ~fast
    )
    nod = share * (bob + bang * drift) + np.where(share < 1, up, 0.0)
    halves = np.arange(len(times)) // 2
    to = (share > 0) * (1.0 - 2.0 * ((halves // np.where(slow, 4, np.where(fast, 1, 2))) % 2))
    tilt = style.factor("amplitude_head_side", bars) * TILT_RAD * to * drift
    chin = style.value("chin", bars) / 100 * CHIN_RAD * share
    kept = beat | (place == 2) & (fast | ~slow | (lift < 0) | (bang > 0)) | fast
    times = fallen(times[kept], share[kept] == 0, style.factor("frequency_neck", bars)[kept])
    nod = limited(times, np.clip(nod[kept], *_NECK_RAD), np.full(len(times), _MOST_RAD_S))
    return spline(times, np.stack([nod, tilt[kept], chin[kept]]))


def _share(backbeat: Array, odd: NDArray[np.bool_], slow: NDArray[np.bool_]) -> Array:
    """How much of a nod each place gets by its beat: all alike at 50, 1 and 3 alone at 0, 2 and 4 alone at 100."""
    first, second = np.minimum(2 - backbeat / 50, 1.0), np.minimum(backbeat / 50, 1.0)
    late = backbeat > 50
    first, second = np.where(slow & late, 0.0, first), np.where(slow & ~late, 0.0, second)
    return np.where(odd, first, second)


def _with_quarters(values: Array) -> Array:
    """Values at the beats and middles (n,) with the means between them, (2n − 1,)."""
    return np.insert(values, np.arange(1, len(values)), 0.5 * (values[1:] + values[:-1]))

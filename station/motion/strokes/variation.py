"""What chance does to strokes: no two are alike, and every seed has its own.

Players' strokes scatter in height, in pace and in place, and drift while they do: each number here is half fresh at
every stroke and half a slow wander, so that its spectrum falls with the frequency as that of people's movements does.
Nothing moves a strike in time, and none leaves its spot: the tip meets the head within `SPOT_M` of where it aims.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Piece, Zone
from station.motion.kinematics.wander import wander
from station.motion.kit.kit import Kit
from station.motion.strokes.hand_events import SHOW, HandEvents
from station.motion.strokes.stroke import Sliders

Array = NDArray[np.float64]

HEIGHT_SD, JOINT_SD, PACE_SD = 0.11, 0.08, 0.04
"""Together a scatter of 6–10 % within a dozen strokes, as of professionals' velocities (HUMANS); the joints
share it differently every time, and the preparation comes so much earlier or later (our choice)."""
SPOT_SD_M, SPOT_M = 0.004, 0.010
"""How far from its aim the tip lands on a head or a bow, in each direction and at most: worn heads show a spot of two
centimetres (our choice)."""
_BY_THE_TIP = np.isin(np.arange(len(Zone)), (Zone.HEAD, Zone.BOW))
_ON_THE_SPOT = np.isin(np.arange(SHOW + 1), (Articulation.NORMAL, Articulation.BUZZ))


def varied(sliders: Sliders, rebounds: NDArray[np.bool_], amount: Array, seed: tuple[int, int]) -> Sliders:
    """`sliders` of strokes as chance has them: `amount` (n,) or (1,), 1 natural; `seed` and the hand.

    The `rebounds` (n,) vary with the strokes that throw them up.
    """
    chance = _chance(6, rebounds, amount, (*seed, 3))
    height, pace, joints = chance[0], chance[1], chance[2:]
    gain = np.maximum(1 + HEIGHT_SD * height + JOINT_SD * joints, 0.0)
    return Sliders(sliders.gain * gain, sliders.speed * np.exp(PACE_SD * pace), sliders.whip)


def spots(kit: Kit, events: HandEvents, amount: Array, seed: tuple[int, int]) -> Array:
    """How far from its aim each event of a hand lands, (n, 3) metres in the plane of what it strikes."""
    aside = SPOT_SD_M * _chance(2, events.rebounds | events.bounces, amount, (*seed, 4))
    aside *= SPOT_M / np.maximum(np.hypot(*aside), SPOT_M)
    piece, zone, articulation = events.key.T
    aside *= _BY_THE_TIP[zone] & _ON_THE_SPOT[articulation]
    planes = np.zeros((len(Piece), 2, 3))
    for played in set(piece.tolist()):
        planes[played] = kit.pieces[kit.stand_in(Piece(played))].axes[:2]
    return np.asarray(aside[0, :, None] * planes[piece, 0] + aside[1, :, None] * planes[piece, 1])


def _chance(channels: int, rebounds: NDArray[np.bool_], amount: Array, seed: tuple[int, ...]) -> Array:
    """`wander` for strokes, (channels, n), `amount` as wide; what a stroke throws up shares its numbers."""
    found = wander(seed, channels, len(rebounds))
    if rebounds.any():
        found = found[:, np.maximum.accumulate(np.where(rebounds, 0, np.arange(len(rebounds))))]
    return np.asarray(amount * found)

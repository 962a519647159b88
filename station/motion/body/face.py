"""The face: brow, mouth, smile and effort, by the style's mood and by what is played.

Each mood is a face at rest and how it answers loud playing, fills and crashes; people say "drum face". No study gives
numbers for it: all are our choice, in the ranges of `Pose.face`.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.motion.body.intensity import Intensity
from station.motion.kinematics.wander import wander
from station.motion.style.style import Style

Array = NDArray[np.float64]

CHANNELS = ("brow", "mouth", "smile", "effort")
LOW, HIGH = np.array([-1.0, 0.0, -1.0, 0.0]), np.ones(4)
"""Brow: frown −1 … 1 raised. Mouth: shut 0 … 1 open. Smile −1 … 1. Effort, narrowed eyes and a tense jaw: 0 … 1."""
_FACES: Mapping[str, tuple[tuple[float, ...], ...]] = MappingProxyType(
    # at rest; and what it adds when loud, in a fill and at a crash: brow, mouth, smile, effort
    {
        "focused": (
            (-0.10, 0.00, 0.00, 0.05),
            (-0.15, 0.00, 0.00, 0.25),
            (-0.25, 0.05, -0.1, 0.25),
            (0.3, 0.2, 0.1, 0.2),
        ),
        "calm": ((0.10, 0.00, 0.15, 0.00), (0.00, 0.00, 0.00, 0.10), (0.05, 0.00, 0.00, 0.10), (0.15, 0.05, 0.1, 0.1)),
        "joyful": ((0.30, 0.10, 0.60, 0.00), (0.10, 0.10, 0.20, 0.15), (0.20, 0.20, 0.1, 0.20), (0.4, 0.5, 0.3, 0.1)),
        "intense": ((-0.55, 0.05, -0.25, 0.35), (-0.2, 0.1, -0.1, 0.4), (-0.2, 0.15, -0.2, 0.3), (-0.1, 0.6, 0.0, 0.3)),
        "cool": ((-0.05, 0.00, 0.05, 0.20), (0.05, 0.00, 0.00, 0.10), (0.20, 0.05, 0.10, 0.10), (0.3, 0.1, 0.15, 0.1)),
        "soulful": ((0.40, 0.05, -0.10, 0.30), (0.1, 0.1, -0.1, 0.3), (0.15, 0.2, -0.1, 0.3), (0.1, 0.35, 0.2, 0.2)),
    }
)
_LOUD_FROM, _LOUD_TO = 0.45, 0.95
"""Playing strains the face from mezzo-forte on (velocity 57)."""
_PLAY = 0.10
"""How far chance moves a face (our choice)."""


def face_keys(now: Intensity, bars: Array, style: Style) -> Array:
    """The face at keys in `bars` (k,) from 1, when so much goes on there: (4, k) by `CHANNELS`."""
    rest, *answers = (np.array(row) for row in _FACES[style.mood])
    loud = np.clip((now.loud - _LOUD_FROM) / (_LOUD_TO - _LOUD_FROM), 0.0, 1.0)
    felt = rest[:, None] + np.array(answers).T @ np.stack([loud, now.fill, now.rise])
    drift = _PLAY * style.factor("variation", bars) * wander((style.seed, 5), 4, len(bars))
    shown = style.factor("expression", bars) * (felt + drift)
    return np.asarray(np.clip(shown, LOW[:, None], HIGH[:, None]))

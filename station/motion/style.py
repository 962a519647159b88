"""How the drummer moves: the controls of expression, and styles as files.

Amplitudes and frequencies are 0–100 as in the thesis (§ 4.1.1, figure 4.3), but the natural drummer stands in the
middle of each and the whole range is of use, which the thesis asks for: a gain times a joint's share is compared with
the natural product, and the factor is bent so that it never passes `MOST`.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from station.motion.stroke import Sliders

NATURAL = 50.0


MOST = 2.5
"""No control more than this multiplies what a natural drummer does (our choice)."""
_SHARES = {"wrist": 40.0, "elbow": 30.0, "shoulder": 30.0}
_PACES = {"wrist": 34.0, "elbow": 33.0, "shoulder": 33.0}


def factor(gain: float, share: float, natural_share: float) -> float:
    """What multiplies the natural movement: proportional up to the natural setting, bent towards `MOST` beyond it."""
    x = gain * share / (NATURAL * natural_share)
    return x if x <= 1.0 else 1.0 + (MOST - 1.0) * (1.0 - float(np.exp(-(x - 1.0) / (MOST - 1.0))))


@dataclass(frozen=True)
class Style:
    """All controls; see the module's head for their scale. Shares are per cent of their gain."""

    name: str = "natural"
    amplitude_gain: float = NATURAL
    amplitude_wrist: float = _SHARES["wrist"]
    amplitude_elbow: float = _SHARES["elbow"]
    amplitude_shoulder: float = _SHARES["shoulder"]
    frequency_gain: float = NATURAL
    frequency_wrist: float = _PACES["wrist"]
    frequency_elbow: float = _PACES["elbow"]
    frequency_shoulder: float = _PACES["shoulder"]
    amplitude_neck: float = NATURAL
    amplitude_back: float = NATURAL
    amplitude_twist: float = NATURAL
    wing_deg: float = 12.0
    posture_deg: float = 6.0

    @cached_property
    def sliders(self) -> Sliders:
        """The strokes' factors: shoulder, elbow, wrist and the stick, which goes with the wrist."""
        gains = [factor(self.amplitude_gain, getattr(self, f"amplitude_{j}"), _SHARES[j]) for j in _JOINTS]
        paces = [factor(self.frequency_gain, getattr(self, f"frequency_{j}"), _PACES[j]) for j in _JOINTS]
        return Sliders(np.array(gains)[:, None], np.maximum(np.array(paces)[:, None], _SLOWEST))

    @property
    def body_factors(self) -> tuple[float, float, float]:
        """Factors of back, neck and twist."""
        back, neck, twist = (
            factor(a, 1.0, 1.0) for a in (self.amplitude_back, self.amplitude_neck, self.amplitude_twist)
        )
        return back, neck, twist


_JOINTS = ("shoulder", "elbow", "wrist", "wrist")
_SLOWEST = 0.3
"""A stroke never takes longer than its natural time over this (our choice)."""

"""Any channel as a sound that goes on: its value becomes a MIDI controller's, while the phase is locked.

"Although we synchronize with just four channels … once we are synchronized, we can rhythmically sonify any and all
channels" (Boyd and Godbout 2012, § 5).
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

GREATEST = 127


class ControlCue(NamedTuple):
    """A controller takes a value, 0 … 127."""

    at_ns: int
    controller: int
    value: int


@dataclass(frozen=True, slots=True)
class ChannelLevel:
    """`channel` from `low` to `high`, in its own unit, moves `controller` from 0 to 127; `high` below `low` inverts."""

    channel: str
    low: float
    high: float
    controller: int = 1

    def values(self, samples: NDArray[np.float64]) -> NDArray[np.int64]:
        """The controller's value for each of `samples` (n,); beyond the range it stands at its end."""
        share = (samples - self.low) / (self.high - self.low)
        return np.rint(GREATEST * np.clip(share, 0.0, 1.0)).astype(np.int64)


def level_cues(
    level: ChannelLevel, at_ns: NDArray[np.int64], samples: NDArray[np.float64], sure: NDArray[np.bool_]
) -> list[ControlCue]:
    """The controller's moves over a recording (n,): a cue where its value is new and the tracker is `sure`.

    Where sureness ends the controller goes to 0, so that nothing hangs.
    """
    wanted = np.where(sure, level.values(samples), 0)
    is_new = np.diff(wanted, prepend=0) != 0
    return [ControlCue(at, level.controller, value) for at, value in zip(
        at_ns[is_new].tolist(), wanted[is_new].tolist(), strict=True
    )]  # fmt: skip

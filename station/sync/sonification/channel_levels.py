"""Any channel as a sound that goes on: its value becomes a MIDI controller's, while the phase is locked.

"Although we synchronize with just four channels … once we are synchronized, we can rhythmically sonify any and all
channels" (Boyd and Godbout 2012, § 5).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.counts import is_count
from station.core.errors import BadInput
from station.music.formats.smf.track_writer import ControlMove
from station.sync.signals.signal import Signal

GREATEST = 127


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
) -> list[ControlMove]:
    """The controller's moves over a recording (n,): a cue where its value is new and the tracker is `sure`.

    Where sureness ends the controller goes to 0, so that nothing hangs.
    """
    wanted = np.where(sure, level.values(samples), 0)
    is_new = np.diff(wanted, prepend=0) != 0
    return [ControlMove(at, level.controller, value) for at, value in zip(
        at_ns[is_new].tolist(), wanted[is_new].tolist(), strict=True
    )]  # fmt: skip


def parse_level(text: str, signal: Signal, source: str) -> ChannelLevel:
    """The level that a user wrote as CHANNEL=CONTROLLER, over the range that the channel has in `signal`.

    Raises `BadInput` that names `source`, or the signal where it has no such channel or the channel never moves.
    """
    channel, _, controller = text.rpartition("=")
    if not channel or not is_count(controller) or int(controller) > GREATEST:
        raise BadInput(source, text, f"expected CHANNEL=CONTROLLER, the controller from 0 to {GREATEST}")
    samples = signal.only([channel]).values
    if not len(samples) or np.ptp(samples) == 0:
        raise BadInput(signal.name, channel, "never moves")
    return ChannelLevel(channel, float(samples.min()), float(samples.max()), int(controller))

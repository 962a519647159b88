"""The model of a drill, as it crosses the pipe to whoever tracks it; `drummed_model` makes it of the drummer.

The model is the paper's (`sync.phase.periodic_model`): circular Gaussians over the phase, one for each of a few tempi.
It spans the loop's shortest repeat (`loop_repeats`), for no more can be told apart.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.sync.drill.phase_paths import MatchTable
from station.sync.phase.periodic_model import PeriodicModel, centres

Array = NDArray[np.float64]

HANDS = (Limb.RIGHT_HAND, Limb.LEFT_HAND)
"""The order in which sticks stand in arrays."""
AXES = 3
CHANNELS = ("force_x", "force_y", "force_z", "rate_x", "rate_y", "rate_z")
"""What one sensor measures: specific force in m/s², angular rate in rad/s, in the stick's axes."""


def channel_names() -> list[str]:
    """Every channel's name, the right stick's first."""
    return [f"{side}_{name}" for side in ("right", "left") for name in CHANNELS]


CENTRES_A_STROKE = 16
"""n_m of the paper, for each stroke of the busiest hand."""


@dataclass(frozen=True, slots=True, eq=False)
class DrillModel:
    """A loop of `loop_s` at its own tempo, whose motion returns `repeats` times.

    `models` one for each of the `tempi`, parts of that tempo, of channels (c,) without their `mean`, divided by their
    `scale`; `smoothing_s` the SD of the low-pass; of the loop's notes `onset_s`, `piece` and `limb` (n,).
    """

    loop_s: float
    repeats: int
    tempi: tuple[float, ...]
    models: tuple[PeriodicModel, ...]
    mean: Array
    scale: Array
    smoothing_s: float
    onset_s: Array
    piece: NDArray[np.int64]
    limb: NDArray[np.int64]

    @property
    def cycle_s(self) -> float:
        """How long the shortest repeat lasts at the loop's tempo."""
        return self.loop_s / self.repeats

    @property
    def centre_count(self) -> int:
        """n_m of the shortest repeat."""
        return self.models[0].centre_count

    def scaled(self, values: Array) -> Array:
        """Measured channels (…, 12) as the models have them."""
        return np.asarray((values - self.mean) / self.scale)

    def table(self) -> MatchTable:
        """The models at their centres, from the beginning of a repeat on."""
        phases = centres(self.centre_count)
        begin = self.centre_count // 2 - 1  # the centres ascend to π, an even number of them: this one lies at 0
        values = np.stack([np.roll(model.values(phases), -begin, axis=0) for model in self.models])
        return MatchTable(values, self.tempi, self.cycle_s)

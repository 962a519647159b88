"""A signal of several channels, sampled at known times; and sets of channels that have a name."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput

FloatArray = npt.NDArray[np.float64]

CHANNEL_SETS = {"walk": ("rfemur_rx", "lfemur_rx", "rtibia_rx", "ltibia_rx")}
"""`walk`: hips and knees in the sagittal plane, the channels of Boyd and Godbout 2012, § 3."""


@dataclass(frozen=True, slots=True, eq=False)
class Signal:
    """`values` (n, c), a column for each of `names`, measured at `time_s` (n,), which increases strictly.

    `name` is the file or whatever else it came from, as errors call it. Angles of motion files are in degrees.
    """

    time_s: FloatArray
    names: tuple[str, ...]
    values: FloatArray
    name: str = "signal"

    def __len__(self) -> int:
        return len(self.time_s)

    @property
    def rate_hz(self) -> float:
        """Samples a second, by the median interval; raises `BadInput` with fewer than two samples."""
        if len(self) < 2:
            raise BadInput(self.name, "", f"expected at least 2 samples, found {len(self)}")
        return 1.0 / float(np.median(np.diff(self.time_s)))

    def only(self, names: Sequence[str]) -> "Signal":
        """The channels of these names, in this order; raises `BadInput` for one that is not here."""
        columns = [self._column(name) for name in names]
        return Signal(self.time_s, tuple(names), self.values[:, columns], self.name)

    def between(self, first: int, last: int) -> "Signal":
        """The samples `first` to `last` − 1, at the times they had."""
        return Signal(self.time_s[first:last], self.names, self.values[first:last], self.name)

    def _column(self, name: str) -> int:
        if name not in self.names:
            raise BadInput(self.name, "", f"no such channel: {name}{did_you_mean(name, self.names)}")
        return self.names.index(name)

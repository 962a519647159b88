"""A segment of a performance as the examiner sees it: what docs/motion.md publishes, sampled at 1 kHz."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from benchmarks.examiner.findings import BarAt
from station.core.pieces import Articulation
from station.motion.drummer import Drummer
from station.motion.export.npz import motion_arrays
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.pose import ANGLE_NAMES

Array = NDArray[np.float64]
RATE_HZ = 1000
BEFORE_S = 0.9
"""The first preparation is looked at too."""
SIDES = ("right", "left")


@dataclass(frozen=True, eq=False)
class Sampled:
    """Poses at `time_s` (n,): `points_m` (n, 21, 3), `tip_m`, `butt_m`, `back` (n, 2, 3), `angles_deg` (n, 28).

    `slave_rad` (n, 2): a double pedal's second board and beater.
    """

    time_s: Array
    points_m: Array
    tip_m: Array
    butt_m: Array
    back: Array
    angles_deg: Array
    boards_rad: Array
    beater_rad: Array
    gap_m: Array
    slave_rad: Array

    def point(self, name: str) -> Array:
        """The positions of one joint, (n, 3)."""
        return self.points_m[:, Joint[name.upper()]]

    def angle(self, name: str) -> Array:
        """One joint's angle in degrees, (n,)."""
        return self.angles_deg[:, ANGLE_NAMES.index(name)]


def sampled(drummer: Drummer, time_s: Array) -> Sampled:
    """The poses of `drummer` at `time_s` (n,)."""
    rows = drummer.rows(time_s)
    return Sampled(
        time_s,
        rows[:, frame.JOINTS].reshape(-1, 21, 3),
        rows[:, frame.TIP].reshape(-1, 2, 3),
        rows[:, frame.BUTT].reshape(-1, 2, 3),
        rows[:, frame.PALM].reshape(-1, 2, 3),
        np.degrees(rows[:, frame.ANGLES]),
        rows[:, frame.BOARDS],
        rows[:, frame.BEATER],
        rows[:, frame.GAP],
        rows[:, [frame.SLAVE_BOARD, frame.SLAVE_BEATER]],
    )


@dataclass(frozen=True, eq=False)
class Take:
    """A performance from `BEFORE_S` before `start_s` for `length_s`, and its strikes."""

    drummer: Drummer
    start_s: float
    length_s: float

    @cached_property
    def poses(self) -> Sampled:
        """Every millisecond."""
        count = int((self.length_s + BEFORE_S) * RATE_HZ) + 1
        return sampled(self.drummer, self.start_s - BEFORE_S + np.arange(count) / RATE_HZ)

    @cached_property
    def strikes(self) -> "Strikes":
        """The strikes of the segment, in order of time."""
        arrays = motion_arrays(self.drummer, np.array([self.start_s]))
        score = self.drummer.score
        times = arrays["strike_time_s"]
        first, last = self.poses.time_s[0] + 0.01, self.poses.time_s[-1] - 0.01
        kept = np.flatnonzero((times >= first) & (times <= last))
        rows = arrays["strike_row"][kept]
        notes = score.notes[rows]
        ticks = notes["tick"]
        ends = score.tempo_map.seconds_at(ticks + notes["duration_ticks"]) - score.tempo_map.seconds_at(ticks)
        return Strikes(
            times[kept],
            arrays["strike_piece"][kept],
            arrays["strike_limb"][kept],
            arrays["strike_velocity"][kept].astype(float),
            notes["articulation"],
            np.where(notes["articulation"] == Articulation.BUZZ, ends, 0.0),
            notes["piece"],
            score.tempo_map.seconds_at(ticks + notes["choke_ticks"]) - score.tempo_map.seconds_at(ticks),
            arrays["strike_radius_m"][kept],
            arrays["strike_centre_m"][kept],
        )

    @cached_property
    def bar_at(self) -> BarAt:
        """Bars by time."""
        tempo, count = self.drummer.score.tempo_map, self.drummer.score.bar_count
        return BarAt(tempo.seconds_at([tempo.bar_start(b) for b in range(count)]))

    @property
    def sample(self) -> Callable[[Array], Sampled]:
        """Poses at other times."""
        return lambda time_s: sampled(self.drummer, time_s)


@dataclass(frozen=True, eq=False)
class Strikes:
    """Strikes (m,) in order of time; `lasts_s` is a buzz's length, `choke_s` the time to its grab; or 0."""

    time_s: Array
    piece: NDArray[np.str_]
    limb: NDArray[np.str_]
    velocity: Array
    articulation: NDArray[np.uint8]
    lasts_s: Array
    written: NDArray[np.uint8]
    choke_s: Array
    radius_m: Array
    centre_m: Array

    def of(self, limb: str) -> NDArray[np.int64]:
        """Which are `limb`'s."""
        return np.flatnonzero(self.limb == limb)

    def near(self, time_s: Array, limb: str, before_s: float, after_s: float, piece: str = "") -> NDArray[np.bool_]:
        """Which instants (n,) lie from `before_s` before to `after_s` after a strike of `limb` (on `piece`)."""
        mine = (self.limb == limb) & ((self.piece == piece) | (piece == ""))
        starts, ends = self.time_s[mine] - before_s, self.time_s[mine] + self.lasts_s[mine] + after_s
        edges = np.searchsorted(time_s, np.stack([starts, ends]))
        depth = np.zeros(len(time_s) + 1)
        np.add.at(depth, edges[0], 1)
        np.add.at(depth, edges[1], -1)
        return np.cumsum(depth)[:-1] > 0

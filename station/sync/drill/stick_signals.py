"""What sensors on the drummer's sticks would measure: specific force and angular rate in each stick's own axes.

The drummer's poses give the butts and the tips of the sticks and the backs of the hands. A stick is a rigid body: its x
runs from the butt to the tip, its z is the hand's back made square to x, turned about x by one angle for each hand, so
that at the strokes z points up on the average (`core.imu`: z away from the head that is struck). Its position and its
turn are sampled on a fine grid and differentiated: a sensor at rest reads 1 g upwards,
    force = Rᵀ (p̈ + g ẑ),    rate = the rotation vector of R(t)ᵀ R(t + h), over h.

At a strike the drummer's tip turns round at once; a real one takes the contact's 3–6 ms (HUMANS, after Wagner 2006).
So the position of the sensor and the rate are smoothed by a Gaussian of `CONTACT_SD_S`.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.imu import STANDARD_GRAVITY_M_S2, Mounting
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.sync.drill.drill_model import AXES, HANDS

Array = NDArray[np.float64]

GRID_HZ = 2000.0
"""How finely the poses are sampled: twice as fine as the fastest sensor samples (our choice)."""
CONTACT_SD_S = 0.0015
"""A Gaussian of this SD has 95 % of its weight within 6 ms, the longest contact that Wagner measured."""
_REACH = 4
"""Beyond so many standard deviations a Gaussian is nothing (6e-5 of its weight)."""


@dataclass(frozen=True, eq=False)
class StickSignals:
    """Both sticks' sensors at `time_s` (n,), seconds from the score's tick 0.

    `force_m_s2` and `rate_rad_s` (n, 2, 3), in the order of `HANDS`; `turn` (n, 2, 3, 3) takes the stick's axes to the
    station's.
    """

    time_s: Array
    force_m_s2: Array
    rate_rad_s: Array
    turn: Array

    def channels(self) -> Array:
        """All of it beside one another, (n, 12): `drill_model.CHANNELS` of the right stick, then of the left."""
        return np.concatenate([self.force_m_s2, self.rate_rad_s], axis=2).reshape(len(self.time_s), -1)


def stick_signals(
    drummer: Drummer, start_s: float, end_s: float, mountings: Sequence[Mounting] = (), rate_hz: float = GRID_HZ
) -> StickSignals:
    """What sensors on `drummer`'s sticks measure from `start_s` on and before `end_s`, `rate_hz` times a second.

    `mountings` say where on its stick each hand's sensor sits, else it sits where a `Mounting` has it by itself;
    signals are in the stick's axes however a sensor is turned. Raises ValueError for a segment without a sample.
    """
    wanted = start_s + np.arange(round((end_s - start_s) * rate_hz)) / rate_hz
    if not len(wanted):
        raise ValueError(f"no sample between {start_s} s and {end_s} s")
    butt_m = [next((m.butt_m for m in mountings if m.limb == hand), Mounting().butt_m) for hand in HANDS]
    spare = _REACH * CONTACT_SD_S + 2 / GRID_HZ
    grid = np.arange(np.floor((start_s - spare) * GRID_HZ), np.ceil((end_s + spare) * GRID_HZ) + 1) / GRID_HZ
    rows = drummer.rows(grid)
    strikes = _strike_rows(drummer, grid)
    sides = [_measured(_turns(rows, side, strikes[side]), _places(rows, side, butt_m[side])) for side in (0, 1)]
    force, rate, turn = (np.stack(each, axis=1) for each in zip(*sides, strict=True))
    force, rate = (_at(wanted, grid, values) for values in (force, rate))
    nearest = np.rint((wanted - grid[0]) * GRID_HZ).astype(int)
    return StickSignals(wanted, force, rate, turn[nearest])


def _strike_rows(drummer: Drummer, grid: Array) -> list[NDArray[np.int64]]:
    """For each hand, the rows of `grid` next to its strokes."""
    onsets, limbs = drummer.score.onset_s, drummer.assignment.limbs
    mine = [onsets[(limbs == hand) & (onsets >= grid[0]) & (onsets <= grid[-1])] for hand in HANDS]
    return [np.searchsorted(grid, each).clip(0, len(grid) - 1) for each in mine]


def _along(rows: Array, side: int) -> tuple[Array, Array]:
    """The butt (n, 3) and the unit vector from there to the tip (n, 3)."""
    butt, tip = (rows[:, part].reshape(-1, 2, AXES)[:, side] for part in (frame.BUTT, frame.TIP))
    return butt, _unit(tip - butt)


def _places(rows: Array, side: int, butt_m: float) -> Array:
    """Where the sensor is (n, 3), `butt_m` from the butt along the stick."""
    butt, along = _along(rows, side)
    return butt + butt_m * along


def _turns(rows: Array, side: int, strikes: NDArray[np.int64]) -> Array:
    """The stick's axes in the station's, as columns: (n, 3, 3)."""
    _, x = _along(rows, side)
    back = rows[:, frame.PALM].reshape(-1, 2, AXES)[:, side]
    z = _unit(back - np.sum(back * x, axis=1, keepdims=True) * x)
    y = np.cross(z, x)
    roll = _roll(x, y, z, strikes if len(strikes) else np.arange(len(rows)))
    return np.stack([x, np.cos(roll) * y - np.sin(roll) * z, np.sin(roll) * y + np.cos(roll) * z], axis=2)


def _roll(x: Array, y: Array, z: Array, at: NDArray[np.int64]) -> float:
    """The turn about x that brings z up on the average over the rows `at`."""
    up_y, up_z = float(y[at, 2].sum()), float(z[at, 2].sum())
    return float(np.arctan2(up_y, up_z))


def _measured(turn: Array, place_m: Array) -> tuple[Array, Array, Array]:
    """Specific force (n, 3), angular rate (n, 3), turn (n, 3, 3) of a sensor, from its turns and places on the grid."""
    smooth = _smoothed(place_m)
    pull = np.gradient(np.gradient(smooth, 1 / GRID_HZ, axis=0), 1 / GRID_HZ, axis=0)
    pull[:, 2] += STANDARD_GRAVITY_M_S2
    return np.einsum("nij,ni->nj", turn, pull), _smoothed(_rates(turn)), turn


def _rates(turn: Array) -> Array:
    """The angular rate (n, 3) in the body's own axes: the rotation vector from the row before to the row after."""
    way = np.einsum("nij,nik->njk", turn[:-2], turn[2:])
    vector = np.stack([way[:, 2, 1] - way[:, 1, 2], way[:, 0, 2] - way[:, 2, 0], way[:, 1, 0] - way[:, 0, 1]], axis=1)
    sine = 0.5 * np.linalg.norm(vector, axis=1)
    angle = np.arctan2(sine, 0.5 * (np.trace(way, axis1=1, axis2=2) - 1.0))
    factor = np.divide(angle, 2.0 * sine, out=np.full_like(sine, 0.5), where=sine > 0)
    rate = vector * factor[:, None] * (GRID_HZ / 2)
    return np.concatenate([rate[:1], rate, rate[-1:]])


def _smoothed(values: Array) -> Array:
    """`values` (n, k) of the grid, through the Gaussian of the contact; beyond the ends they stay as they are there."""
    reach = int(np.ceil(_REACH * CONTACT_SD_S * GRID_HZ))
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / (CONTACT_SD_S * GRID_HZ)) ** 2)
    padded = np.pad(values, ((reach, reach), (0, 0)), mode="edge")
    return np.stack([np.convolve(column, weights / weights.sum(), "valid") for column in padded.T], axis=1)


def _at(wanted: Array, grid: Array, values: Array) -> Array:
    """`values` (m, 2, 3) of the grid read at other times, straight in between."""
    flat = values.reshape(len(grid), -1)
    return np.stack([np.interp(wanted, grid, column) for column in flat.T], axis=1).reshape(-1, 2, AXES)


def _unit(vectors: Array) -> Array:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))

"""Keeps a hand's air zones in place while its sensor's heading drifts: every stroke that is clear corrects it.

Without a magnetometer nothing tells the heading but the gyro's sum, which drifts by degrees a minute; players leave air
drums because of it. The state of one hand is a Kalman filter's: how far its heading has turned, at which rate it turns
(it goes on while nobody plays), and of each zone a bias of its own, where the player has come to strike. A stroke whose
zone is clear is a measurement of their sum; a pad's hit, or a stroke that the player was asked for, is one whose zone
is known. At first nobody knows where a stick points: the first stroke counts as one at the hand's first zone, and
so again after `lose`.
"""

from collections.abc import Sequence
from math import radians

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.sync.air.air_swing import wrapped
from station.sync.air.air_zones import CLEAR, AirZone, shares

_RATE_SD = radians(5.0) / 60.0
"""Drift to expect, rad/s: the bias that is left of a MEMS gyro's, a tenth of a degree a second (our choice)."""
_RATE_WALK = radians(1.0) / 60.0
"""How much the drift's rate changes in a minute, rad/s (our choice: sensors warm up in some minutes)."""
_TURN_WALK = radians(0.3)
"""How much the heading wanders beyond that in a second: a player shifts in their seat (our choice: 2.3° a minute)."""
_OWN_SD = radians(4.0)
"""How far a zone may come to lie from where it was learnt: as far as strokes scatter (our choice)."""
_OWN_WALK = radians(0.05)
"""How much it moves from stroke to stroke (our choice: half a degree in a hundred strokes)."""
_ASTRAY = 3.0
"""A stroke that is known to mean a zone and lies so many deviations beside it says that the heading was wrong: of
strokes whose heading is right one in 370 does (normal distribution)."""
_TURN, _RATE, _FIRST = 0, 1, 2
"""Places in the state: heading turned, its rate, and the zones' own from there on."""


class HeadingTracker:
    """One hand's zones and how its heading has turned since they were learnt."""

    def __init__(self, zones: Sequence[AirZone]) -> None:
        self.zones = tuple(zones)
        self._state: NDArray[np.float64] = np.zeros(_FIRST + len(self.zones))
        """(2 + zones,) radians; the second radians a second."""
        self._spread: NDArray[np.float64] = np.zeros((0, 0))
        self._raised = [0.0] * len(self.zones)
        self._raised_var = [_OWN_SD**2] * len(self.zones)
        self._at_ns = 0
        self.lost = True
        self.lose()

    def lose(self) -> None:
        """The heading starts anywhere from now on, as after a sensor was away; the zones' own biases stay."""
        self.lost = True
        own = np.full(len(self.zones), _OWN_SD**2)
        self._spread = np.diag(np.concatenate([[0.0, _RATE_SD**2], own]))
        self._state[_TURN] = 0.0

    @property
    def drift_rad(self) -> float:
        """How far the heading has turned since the zones were learnt, as far as strokes have told."""
        return wrapped(float(self._state[_TURN]))

    @property
    def doubt_rad(self) -> float | None:
        """One standard deviation of that; None while the heading is not known at all."""
        return None if self.lost else float(self._spread[_TURN, _TURN] ** 0.5)

    def confidences(self, at_ns: int, heading_rad: float, elevation_rad: float) -> list[float]:
        """How likely each zone was meant by a stroke, 0 … 1; all 0 while the heading is lost."""
        if self.lost:
            return [0.0] * len(self.zones)
        state, spread = self._moved(at_ns)
        return shares(
            [self._miss(index, state, spread, heading_rad, elevation_rad) for index in range(len(self.zones))]
        )

    def clear_zone(self, at_ns: int, heading_rad: float, elevation_rad: float) -> AirZone | None:
        """The zone that a stick in this direction means, None where that is unclear; changes nothing."""
        clear = self._clear(at_ns, heading_rad, elevation_rad)
        return None if clear is None else self.zones[clear[0]]

    def strike(self, at_ns: int, heading_rad: float, elevation_rad: float) -> tuple[AirZone, float] | None:
        """The zone that a stroke meant and how likely that is, or None where it is unclear; corrects the drift."""
        if not self.zones:
            return None
        if self.lost:
            self.fix(at_ns, 0, heading_rad)
            return self.zones[0], 1.0
        clear = self._clear(at_ns, heading_rad, elevation_rad)
        if clear is None:
            return None
        best, confidence = clear
        self._correct(at_ns, best, heading_rad)
        self._lift(best, elevation_rad)
        return self.zones[best], confidence

    def fix(self, at_ns: int, index: int, heading_rad: float) -> None:
        """A stroke that is known to have meant zone `index`: a pad was hit there, or the player was asked for it."""
        if not self.lost:
            miss, deviation, _, _ = self._miss(index, *self._moved(at_ns), heading_rad, 0.0)
            if abs(miss) > _ASTRAY * deviation:
                self.lose()
        if self.lost:
            zone = self.zones[index]
            self._state[_TURN] = wrapped(heading_rad - zone.heading_rad - self._state[_FIRST + index])
            self._spread[_TURN, _TURN] = zone.heading_sd_rad**2 + _OWN_SD**2
            self._at_ns, self.lost = at_ns, False
            return
        self._correct(at_ns, index, heading_rad)

    def _clear(self, at_ns: int, heading_rad: float, elevation_rad: float) -> tuple[int, float] | None:
        found = self.confidences(at_ns, heading_rad, elevation_rad)
        best = max(range(len(found)), key=found.__getitem__, default=None)
        return None if best is None or found[best] < CLEAR else (best, found[best])

    def _moved(self, at_ns: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """State and covariance at a later time."""
        gone_s = max(0.0, (at_ns - self._at_ns) / NS_PER_S)
        step = np.eye(len(self._state))
        step[_TURN, _RATE] = gone_s
        spread = step @ self._spread @ step.T
        spread[_TURN, _TURN] += _TURN_WALK**2 * gone_s
        spread[_RATE, _RATE] += _RATE_WALK**2 * gone_s / 60.0
        return step @ self._state, spread

    def _miss(
        self,
        index: int,
        state: NDArray[np.float64],
        spread: NDArray[np.float64],
        heading_rad: float,
        elevation_rad: float,
    ) -> tuple[float, float, float, float]:
        zone, own = self.zones[index], _FIRST + index
        heading = wrapped(heading_rad - zone.heading_rad - float(state[_TURN] + state[own]))
        doubt = spread[_TURN, _TURN] + 2.0 * spread[_TURN, own] + spread[own, own]
        raised_sd = (zone.elevation_sd_rad**2 + self._raised_var[index]) ** 0.5
        elevation = elevation_rad - zone.elevation_rad - self._raised[index]
        return heading, float(zone.heading_sd_rad**2 + doubt) ** 0.5, elevation, raised_sd

    def _correct(self, at_ns: int, index: int, heading_rad: float) -> None:
        """The Kalman filter's step: the miss in heading corrects turn, rate and the zone's own."""
        state, spread = self._moved(at_ns)
        own = _FIRST + index
        spread[own, own] += _OWN_WALK**2
        miss, deviation, _, _ = self._miss(index, state, spread, heading_rad, 0.0)
        seen = spread[:, _TURN] + spread[:, own]
        self._state = state + seen / deviation**2 * miss
        self._spread = spread - np.outer(seen, seen) / deviation**2
        self._at_ns = max(at_ns, self._at_ns)

    def _lift(self, index: int, elevation_rad: float) -> None:
        """The same for the zone's elevation, which has only its own bias."""
        zone, before = self.zones[index], self._raised_var[index] + _OWN_WALK**2
        gain = before / (before + zone.elevation_sd_rad**2)
        self._raised[index] += gain * (elevation_rad - zone.elevation_rad - self._raised[index])
        self._raised_var[index] = (1.0 - gain) * before

"""An air kit learnt in a minute: the player strikes each piece eight times in the air where they want it to be.

The zone of a hand's piece is the median direction of its strokes and their scatter; a slip among them moves neither.
Two zones of a hand that would be confused more often than `MOST_CONFUSED` are told, for the player to move one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import radians
from statistics import NormalDist, median
from typing import NamedTuple

from station.core.pieces import Limb, Piece, Zone
from station.sync.air.air_swing import wrapped
from station.sync.air.air_zones import AirKit, AirZone, separation

STROKES = 8
"""So many strokes of each piece; at two a second six pieces take half a minute."""
MOST_CONFUSED = 0.02
"""Two zones that are taken for each other more often lie too close (our choice: a stroke in fifty)."""
_LEAST_HEADING_SD_RAD, _LEAST_ELEVATION_SD_RAD = radians(6.0), radians(8.0)
"""Strokes scatter by this at the least, whatever eight of them say: so do half a minute of one player's strokes at one
piece (imu/airdrums, recordings 1 and 2, medians of both sticks), and the first eight by half of it."""
_FROM_MEDIAN = 1.4826
"""The normal distribution's deviation over its median absolute deviation, 1/Φ⁻¹(3/4)."""


class AskedZone(NamedTuple):
    """What the player is asked to strike, with which hand."""

    limb: Limb
    piece: Piece
    zone: Zone = Zone.HEAD


class AirAim(NamedTuple):
    """Where a stroke in the air pointed, and how fast its tip was."""

    heading_rad: float
    elevation_rad: float
    speed_m_s: float


class CloseZones(NamedTuple):
    """Two zones of one hand that are confused with each other in `confused`, 0 … 0.5, of the strokes."""

    one: AirZone
    other: AirZone
    confused: float


@dataclass(frozen=True, slots=True)
class LearntAir:
    """What a minute taught: the kit, and the zones that lie too close, the worst first."""

    kit: AirKit
    close: tuple[CloseZones, ...]


class ZoneLearning:
    """Asks for one zone after the other; `strike` every stroke in the air."""

    def __init__(self, asked: Sequence[AskedZone], strokes: int = STROKES) -> None:
        self._asked = tuple(asked)
        self._strokes = strokes
        self._aims: list[list[AirAim]] = [[]]

    @property
    def now(self) -> AskedZone | None:
        """What to strike now, None once all is learnt."""
        return self._asked[len(self._aims) - 1] if len(self._aims) <= len(self._asked) else None

    @property
    def left(self) -> int:
        """How many strokes of it are still to come."""
        return 0 if self.now is None else self._strokes - len(self._aims[-1])

    def strike(self, limb: Limb, aim: AirAim) -> bool:
        """Takes a stroke, if it is of the hand that was asked for; returns whether it was."""
        if self.now is None or limb is not self.now.limb:
            return False
        self._aims[-1].append(aim)
        if len(self._aims[-1]) == self._strokes:
            self._aims.append([])
        return True

    def learnt(self) -> LearntAir:
        """The zones that have all their strokes so far."""
        full = [
            (asked, aims) for asked, aims in zip(self._asked, self._aims, strict=False) if len(aims) == self._strokes
        ]
        zones = tuple(zone_of(asked, aims) for asked, aims in full)
        if not zones:
            return LearntAir(AirKit(()), ())
        kit = AirKit(zones, median(aim.speed_m_s for _, aims in full for aim in aims))
        return LearntAir(kit, too_close(zones))


def zone_of(asked: AskedZone, aims: Sequence[AirAim]) -> AirZone:
    """The zone that these strokes, one or more, show."""
    near = aims[0].heading_rad
    heading, heading_sd = _middle([wrapped(aim.heading_rad - near) for aim in aims], _LEAST_HEADING_SD_RAD)
    elevation, elevation_sd = _middle([aim.elevation_rad for aim in aims], _LEAST_ELEVATION_SD_RAD)
    return AirZone(*asked, wrapped(near + heading), elevation, heading_sd, elevation_sd)


def too_close(zones: Sequence[AirZone]) -> tuple[CloseZones, ...]:
    """The pairs of one hand's zones that are confused more often than they may, the worst first."""
    pairs = [(one, other) for index, one in enumerate(zones) for other in zones[index + 1 :] if one.limb is other.limb]
    close = [CloseZones(one, other, NormalDist().cdf(-separation(one, other) / 2.0)) for one, other in pairs]
    return tuple(sorted((pair for pair in close if pair.confused > MOST_CONFUSED), key=lambda pair: -pair.confused))


def _middle(angles_rad: Sequence[float], least_rad: float) -> tuple[float, float]:
    """Median and scatter, which one slip does not move."""
    middle = median(angles_rad)
    return middle, max(least_rad, _FROM_MEDIAN * median(abs(angle - middle) for angle in angles_rad))

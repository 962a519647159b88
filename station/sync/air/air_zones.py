"""Air kits: which piece lies in which direction, for each hand, and how sure a direction names one.

A zone is a heading and an elevation of the stick at the beat, and how far a player's strokes scatter about them. The
elevation is told by gravity and does not drift; headings are as the sensor's orientation had them when the zones were
learnt, and `HeadingTracker` tells how they have turned since. A direction names a zone where the zone's share of all
that could have been meant, a stroke at no zone included, is `CLEAR` or more; elsewhere it names none.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, pi, sqrt

from station.core.pieces import Limb, Piece, Zone
from station.sync.air.air_swing import FULL_SPEED_M_S, wrapped

CLEAR = 0.8
"""Share from which on a zone is named; our choice: four in five, so that a stroke midway names neither."""
STRAY_SHARE = 0.02
"""Of all strokes so many are meant for no zone; our choice."""
_STRAY_DENSITY = STRAY_SHARE / (2.0 * pi * pi)
"""They may point anywhere: 2π of heading, π of elevation."""
NORMAL_VELOCITY = 78.0
"""What a player's usual stroke counts as: the middle of normal strokes, 60–95 (HUMANS)."""
NORMAL_SPEED_M_S = FULL_SPEED_M_S * (NORMAL_VELOCITY / 127.0) ** 2
"""Tip's speed of a usual stroke before it is learnt, 3.5 m/s: a full stroke then counts as 127."""
AIR_DEVICE = "air sticks"


@dataclass(frozen=True, slots=True)
class AirZone:
    """Where a hand's stick points when it means a piece, and one deviation of its strokes about that."""

    limb: Limb
    piece: Piece
    zone: Zone
    heading_rad: float
    elevation_rad: float
    heading_sd_rad: float
    elevation_sd_rad: float


@dataclass(frozen=True, slots=True)
class AirKit:
    """The zones of both hands; a stroke whose tip has `normal_speed_m_s` counts as `NORMAL_VELOCITY`."""

    zones: tuple[AirZone, ...]
    normal_speed_m_s: float = NORMAL_SPEED_M_S

    def of(self, limb: Limb) -> tuple[AirZone, ...]:
        """The zones of one hand, in the kit's order; the first is where it finds itself again."""
        return tuple(zone for zone in self.zones if zone.limb is limb)


def velocity_of(speed_m_s: float, normal_speed_m_s: float) -> float:
    """Velocity 1 ≤ v < 128: a sound's pressure goes with the tip's speed and its level with 40·log10(v) (HUMANS).

    So v grows with the root of the speed; twice the speed is 6 dB more.
    """
    velocity = NORMAL_VELOCITY * sqrt(max(0.0, speed_m_s / normal_speed_m_s))
    return min(127.0, max(1.0, velocity))


def shares(misses: Sequence[tuple[float, float, float, float]]) -> list[float]:
    """How likely each zone was meant, 0 … 1, by its miss and deviation in heading, and in elevation (radians).

    They sum to 1 less what strays. All zones are as likely beforehand.
    """
    if not misses:
        return []
    prior = (1.0 - STRAY_SHARE) / len(misses)
    each = [prior * _density(heading, heading_sd) * _density(up, up_sd) for heading, heading_sd, up, up_sd in misses]
    total = sum(each) + _STRAY_DENSITY
    return [density / total for density in each]


def separation(one: AirZone, other: AirZone) -> float:
    """How many deviations of their strokes lie between two zones; two of d apart are confused Φ(−d/2) of the time."""
    heading = wrapped(one.heading_rad - other.heading_rad)
    elevation = one.elevation_rad - other.elevation_rad
    heading_var = (one.heading_sd_rad**2 + other.heading_sd_rad**2) / 2.0
    elevation_var = (one.elevation_sd_rad**2 + other.elevation_sd_rad**2) / 2.0
    return sqrt(heading**2 / heading_var + elevation**2 / elevation_var)


def _density(miss: float, deviation: float) -> float:
    return exp(-0.5 * (miss / deviation) ** 2) / (deviation * sqrt(2.0 * pi))

"""One piece of the kit as geometry: where it stands, how it leans, and the point of it that a limb aims at.

Metres; x to the drummer's right, y forward to the kit, z up; origin on the floor under the throne. A piece's plane
comes from its tilts ε (about x) and φ (about y): n = R_y(φ) R_x(ε) ẑ = (sin φ cos ε, −sin ε, cos φ cos ε) (DESIGN
§ 5; the thesis, figure 4.18, prints the second component with an extra cos φ). The kick's head is upright and faces
the player.

The wrist radius and height of a piece say on which line the wrist lies as seen from the struck point: so far from it
in plan towards the shoulder, so far above it. How far out on that line follows from the hand and stick that reach for
it, so that any figure with any stick touches the very point (docs/motion.md).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, Zone

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ZoneSpot:
    """Where a zone is struck, in the piece's own plane.

    `right` and `away` are fractions of the radius from the centre, to the drummer's right and away from the drummer;
    each hand stands half of `spread_m` to its own side. `raised_m` is how far the zone stands above the piece's plane
    (a cymbal's bell, a drum's rim). With `shoulder` the stick meets it with its shoulder instead of its tip.
    """

    right: float
    away: float
    spread_m: float = 0.0
    raised_m: float = 0.0
    shoulder: bool = False
    wrist_radius_m: float | None = None
    wrist_height_m: float | None = None


HAND_SPREAD_M = 0.05
"""Two snare tips stand 5 cm apart (HUMANS, Kit)."""
RIM_ABOVE_HEAD_M = 0.012
"""A counter-hoop stands about 1–1.5 cm above the head (our choice)."""
BELL_ABOVE_BOW_M = 0.02
"""Height of a ride's bell over the plane of its bow (our choice)."""

BELL_SHARE = 0.25
"""A bell's radius as a share of its cymbal's (our choice: about 13 cm across a 20-inch ride)."""
_INSIDE = 0.99
"""No target is farther out than this share of the radius (our choice: still the edge, and on the surface)."""
HOOP_M = 0.01
"""A raised zone away from the middle is so much around its point: a counter-hoop's top (our choice)."""

_DRUM_SPOTS = {
    Zone.HEAD: ZoneSpot(0.0, 0.0, HAND_SPREAD_M),
    Zone.RIM: ZoneSpot(0.60, -0.78, 0.16, RIM_ABOVE_HEAD_M, shoulder=True),
}
_CYMBAL_SPOTS = {
    Zone.BOW: ZoneSpot(0.0, -0.6, 0.03),
    Zone.BELL: ZoneSpot(0.0, -0.12, 0.05, BELL_ABOVE_BOW_M, shoulder=True, wrist_radius_m=0.41, wrist_height_m=0.06),
    Zone.EDGE: ZoneSpot(0.0, -0.98, 0.14, shoulder=True),
}
SPOTS: Mapping[str, Mapping[Zone, ZoneSpot]] = MappingProxyType(
    {
        "drum": _DRUM_SPOTS,
        "cymbal": _CYMBAL_SPOTS,
        "hihat": {Zone.BOW: ZoneSpot(0.0, -0.55, 0.04), Zone.EDGE: ZoneSpot(0.30, -0.92, 0.18, shoulder=True)},
        "kick": {Zone.HEAD: ZoneSpot(0.0, 0.0)},
        "block": {Zone.HEAD: ZoneSpot(0.0, 0.0, 0.02)},
    }
)
"""Zones of each kind of piece where its file says nothing else: ride bow at .6 of the radius, crash on the edge with
the stick's shoulder (HUMANS, Kit). Of a piece on the left or the right `right` is inward, to the player: so one hand's
stick on the edge or the rim stays clear of the other's on the bow or the head."""

_FALLBACK: Mapping[Zone, tuple[Zone, ...]] = MappingProxyType(
    {
        Zone.HEAD: (Zone.BOW,),
        Zone.RIM: (Zone.HEAD, Zone.EDGE, Zone.BOW),
        Zone.BOW: (Zone.HEAD,),
        Zone.BELL: (Zone.BOW, Zone.HEAD),
        Zone.EDGE: (Zone.RIM, Zone.HEAD),
        Zone.PEDAL: (Zone.HEAD, Zone.BOW),
    }
)


@dataclass(frozen=True, slots=True)
class Target:
    """The point of a zone that one limb aims at.

    `point_m` (3,) the point itself, `normal` (3,) of the surface there, `centre_m` (3,) and `radius_m` of that
    surface, `rise_rad` the slope of the line from the point up to the wrist, `shoulder` whether the stick's shoulder
    meets it, `raised_m` how far the zone stands over the piece's plane.
    """

    point_m: Vector
    normal: Vector
    centre_m: Vector
    radius_m: float
    rise_rad: float
    shoulder: bool
    raised_m: float


@dataclass(frozen=True)
class KitPiece:
    """One piece: a disc of `radius_m` at `centre_m` with tilts ε and φ, and a shell of `depth_m` under it.

    An `electronic` one is a pad.
    """

    piece: Piece
    kind: str
    centre_m: tuple[float, float, float]
    radius_m: float
    depth_m: float
    tilt_x_rad: float = 0.0
    tilt_y_rad: float = 0.0
    wrist_radius_m: float = 0.40
    wrist_height_m: float = 0.06
    spots: Mapping[Zone, ZoneSpot] = field(default_factory=dict)
    electronic: bool = False

    @property
    def mirrored(self) -> "KitPiece":
        """The piece on the other side, leaning and struck the other way."""
        x, y, z = self.centre_m
        spots = {zone: replace(spot, right=-spot.right) for zone, spot in self.spots.items()}
        return replace(self, centre_m=(-x, y, z), tilt_y_rad=-self.tilt_y_rad, spots=MappingProxyType(spots))

    @cached_property
    def centre(self) -> Vector:
        """Centre of the struck surface, (3,) metres."""
        return np.array(self.centre_m, np.float64)

    @cached_property
    def normal(self) -> Vector:
        """Unit normal of the struck surface, towards the player's side; a kick's points straight at the player."""
        normal: Vector = self.axes[2]
        return normal

    @cached_property
    def axes(self) -> NDArray[np.float64]:
        """Rows: the piece's right, away and normal unit vectors, (3, 3)."""
        if self.kind == "kick":
            return np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
        se, ce = np.sin(self.tilt_x_rad), np.cos(self.tilt_x_rad)
        sp, cp = np.sin(self.tilt_y_rad), np.cos(self.tilt_y_rad)
        return np.array([[cp, 0.0, -sp], [sp * se, ce, cp * se], [sp * ce, -se, cp * ce]])

    def target(self, zone: Zone, limb: Limb) -> Target:
        """The point that `limb` aims at in `zone`, or in the zone nearest to it that this piece has."""
        spot = self._spot(zone)
        side = {Limb.RIGHT_HAND: 0.5, Limb.LEFT_HAND: -0.5}.get(limb, 0.0)
        right, away, normal = self.axes
        centre = self.centre + spot.raised_m * normal
        point = centre + (spot.right * self.radius_m + side * spot.spread_m) * right + spot.away * self.radius_m * away
        over = np.linalg.norm(point - centre) / (_INSIDE * self.radius_m)
        if over > 1.0:  # half the spread must not leave the edge
            point = centre + (point - centre) / over
        radius = spot.wrist_radius_m if spot.wrist_radius_m is not None else self.wrist_radius_m
        height = spot.wrist_height_m if spot.wrist_height_m is not None else self.wrist_height_m
        rise = float(np.arctan2(height, radius))
        surface, size = self._surface(centre, point, spot)
        return Target(point, normal, surface, size, rise, spot.shoulder, spot.raised_m)

    def _surface(self, centre: Vector, point: Vector, spot: ZoneSpot) -> tuple[Vector, float]:
        """Centre and radius of the surface that `point` is on: a raised zone is no disc over the whole piece."""
        if spot.raised_m <= 0.0:
            return centre, self.radius_m
        bell = BELL_SHARE * self.radius_m
        return (centre, bell) if float(np.linalg.norm(point - centre)) <= bell else (point, HOOP_M)

    def _spot(self, zone: Zone) -> ZoneSpot:
        for candidate in (zone, *_FALLBACK[zone]):
            if candidate in self.spots:
                return self.spots[candidate]
        return next(iter(self.spots.values()))

"""Where a stand may stand: clear of drums, cymbals that swing, pedals, the drummer's legs and the stands before it.

All that is in the way is cylinders (shells, and what a cymbal sweeps) and capsules (legs, poles, boards, limbs). Of a
few hundred places, booms and turns the one is taken that keeps clear of all with the least boom. Metres.
"""

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from station.motion.kit.kit import Kit
from station.motion.kit.piece import KitPiece
from station.motion.kit.swing_room import swing_room

Array = NDArray[np.float64]
Line = tuple[Array, Array, float]
"""A capsule: its two ends (3,) and its radius."""

_MARGIN_M = 0.02
"""So far a stand keeps from all else (our choice)."""
_BOOMS_M = (0.0, 0.10, 0.18, 0.26, 0.34, 0.42)
_WAYS = np.linspace(0.0, 2 * np.pi, 16, endpoint=False)
_TURNS = np.linspace(0.0, 2 * np.pi / 3, 6, endpoint=False)
_BOOM_DROP = 0.45
"""A boom falls by this share of its length from the cymbal to the pole (our choice)."""
_BOOM_PRICE = 0.05
"""What a metre of boom is worth in metres of what it is in the way (our choice: a boom is cheap)."""
_ALONG = np.linspace(0.0, 1.0, 9)[:, None]
_UP = np.array([0.0, 0.0, 0.08])
"""An ankle over its heel."""
_PIPE_M, _POLE_LOW_M = 0.012, 0.12
"""How thick pipes are, and how low a pole reaches."""
_KNEE_M, _THIGH_M, _SHIN_M, _BOARD_M = 0.46, 0.09, 0.065, 0.055
"""How far from the seat's middle a knee is, and how thick thighs, shins and boards are (our choice: a tall drummer)."""


@dataclass(frozen=True, slots=True)
class Standing:
    """A stand's foot on the floor, the top of its pole, and the turn of its tripod."""

    foot: Array
    pole_top: Array
    turn: float


@dataclass(frozen=True, eq=False)
class StandingRoom:
    """What is in the way: `drums` as cylinders, `swept` what cymbals sweep, `lines` all that is long and thin."""

    drums: tuple[KitPiece, ...]
    swept: tuple[tuple[KitPiece, float], ...]
    lines: list[Line] = field(default_factory=list)

    @classmethod
    def of(cls, kit: Kit) -> "StandingRoom":
        """The room of a kit without any stand."""
        room = swing_room(kit)
        swept = tuple((kit.pieces[piece], tip) for piece, tip in room.items())
        return cls(tuple(p for p in kit.pieces.values() if p.piece not in room), swept, _legs_and_boards(kit))

    def without(self, piece: KitPiece) -> "StandingRoom":
        """The room as the stand of `piece` sees it, which is to touch it."""
        drums = tuple(drum for drum in self.drums if drum is not piece)
        return replace(self, drums=drums, swept=tuple(pair for pair in self.swept if pair[0] is not piece))

    def clear_m(self, points: Array) -> Array:
        """How far each of `points` (…, 3) is from the nearest thing, negative inside it."""
        clear = np.full(points.shape[:-1], 10.0)
        for drum in self.drums:
            off = points - drum.centre
            height = off @ drum.normal
            radial = np.sqrt(np.maximum((off**2).sum(-1) - height**2, 0.0))
            outside = np.maximum(np.maximum(height - 0.012, -height - drum.depth_m), radial - drum.radius_m - 0.025)
            clear = np.minimum(clear, outside)
        for cymbal, tip in self.swept:
            off = points - cymbal.centre
            height, far = np.abs(off @ cymbal.normal), np.sqrt((off**2).sum(-1))
            clear = np.minimum(clear, np.maximum(far - cymbal.radius_m, height - far * np.sin(tip)))
        for a, b, radius in self.lines:
            along = b - a
            share = np.clip((points - a) @ along / max(float(along @ along), 1e-9), 0.0, 1.0)
            away = points - a - share[..., None] * along
            clear = np.minimum(clear, np.sqrt((away**2).sum(-1)) - radius)
        return clear

    def place(self, top: Array, spread_m: float, height_m: float, may_boom: bool = True) -> Standing:
        """The best place for a stand whose pole or boom ends at `top`; it is then in the way of all others.

        Its tripod's legs reach `spread_m` from the pole and meet `height_m` over the floor.
        """
        best, least = None, np.inf
        for boom_m in _BOOMS_M if may_boom else _BOOMS_M[:1]:
            some = _candidates(top, boom_m)
            lines = np.stack([stand_lines(each, top, spread_m, height_m) for each in some])
            points = lines[:, :, None, 0] + _ALONG * (lines[:, :, None, 1] - lines[:, :, None, 0])
            lack = np.maximum(_MARGIN_M - self.clear_m(points), 0.0).sum((1, 2))
            if (price := lack.min() + _BOOM_PRICE * boom_m) < least:
                best, least = some[int(np.argmin(lack))], price
            if not lack.min():
                break
        assert best is not None
        self.lines.extend([(a, b, _PIPE_M) for a, b in stand_lines(best, top, spread_m, height_m)])
        return best


def stand_lines(standing: Standing, top: Array, spread_m: float, height_m: float) -> Array:
    """The pole, the boom and the three legs from end to end, (5, 2, 3)."""
    x, y, _ = standing.foot
    hub, low = np.array([x, y, height_m]), np.array([x, y, _POLE_LOW_M])
    legs = [(hub, toe) for toe in toes(standing.foot, spread_m, standing.turn)]
    return np.array([(low, standing.pole_top), (standing.pole_top, top), *legs])


def toes(foot: Array, spread_m: float, turn: float) -> list[Array]:
    """Where the three legs of a tripod end."""
    angles = turn + 2 * np.pi * np.arange(3) / 3
    return [np.array([foot[0] + spread_m * np.cos(a), foot[1] + spread_m * np.sin(a), 0.012]) for a in angles]


def _candidates(top: Array, boom_m: float) -> list[Standing]:
    found = []
    for way in _WAYS if boom_m else _WAYS[:1]:
        foot = np.array([top[0] + boom_m * np.cos(way), top[1] + boom_m * np.sin(way), 0.0])
        pole_top = np.array([foot[0], foot[1], top[2] - _BOOM_DROP * boom_m])
        found += [Standing(foot, pole_top, float(turn + way)) for turn in _TURNS]
    return found


def _legs_and_boards(kit: Kit) -> list[Line]:
    """The drummer's legs and the pedals' boards."""
    lines: list[Line] = []
    x, y, z = kit.seat_m
    for pedal in kit.pedals.values():
        heel, toe = np.array(pedal.heel_m), np.array(pedal.toe_m)
        hip = np.array([x + 0.09 * np.sign(heel[0] - x), y, z + 0.05])
        way = (heel - hip) * [1, 1, 0]
        knee = hip + way / np.linalg.norm(way) * _KNEE_M + _UP / 2
        lines += [(hip, knee, _THIGH_M), (knee, heel + _UP, _SHIN_M), (heel, toe, _BOARD_M)]
    if kit.slave is not None:
        lines.append((np.array(kit.slave.heel_m), np.array(kit.slave.toe_m), _BOARD_M))
    return lines

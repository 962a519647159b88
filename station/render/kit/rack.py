"""The rack of an electronic kit: tubes that carry its pads, its cymbals and its module, and the kick's tower.

All of it follows from where the pieces are, on the drummer's own side for left-handed kits too; metres.
"""

from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kit.kit import Kit
from station.motion.kit.piece import KitPiece
from station.render.geometry.materials import Material
from station.render.geometry.mesh import Mesh, ball, box, joined, lathe, rod, tube
from station.render.geometry.transforms import frame, translation, unit
from station.render.kit import instrument_meshes
from station.render.kit.instrument_meshes import Detail
from station.render.kit.pad_meshes import module

Point = NDArray[np.float64]

_BAR_Z: Final = 0.60
_TUBE_M = 0.019
_OUT_M, _BEHIND_M = 0.03, 0.10
"""How far the rack's bars lie outside the outermost pads, and behind the toms (our choice, as compact racks are)."""
_TILT, _MODULE_M = np.radians(35.0), 0.17
"""How far the module leans to the drummer, and how high it stands over its bar."""
_UP = np.array([0.0, 0.0, 1.0])


def rack(kit: Kit, detail: Detail) -> list[Mesh]:
    """The rack with an arm for each pad and cymbal, and the module beside the hi-hat."""
    n = 12 if detail.hardware else 7
    posts = _posts(kit)
    bars = list(pairwise(posts))
    parts = [_post(post, posts[1:-1], n) for post in posts]
    parts += [rod(_at(a, _BAR_Z), _at(b, _BAR_Z), _TUBE_M, Material.LACQUER, n) for a, b in bars]
    for piece in kit.pieces.values():
        if piece.kind in ("cymbal", "hihat"):
            parts.append(_cymbal_arm(piece, posts, n, detail))
        elif piece.kind == "drum" and piece.piece is not Piece.SNARE:
            parts.append(_pad_arm(piece, bars, n))
    return [joined(parts), _module(kit, bars, n, detail)]


def _posts(kit: Kit) -> list[Point]:
    """The feet of the four posts in plan, from the hi-hat's side round the front: near, far, far, near."""
    side = 1.0 if kit.left_handed else -1.0
    pads = [p for p in kit.pieces.values() if p.kind != "kick"]
    hat, floor = kit.pieces[Piece.HIHAT], kit.pieces[Piece.FLOOR_TOM_1]
    far = max(p.centre_m[1] + p.radius_m for p in pads if p.kind == "drum") + _BEHIND_M
    outer = max(abs(hat.centre_m[0]) + hat.radius_m, abs(floor.centre_m[0]) + floor.radius_m) + _OUT_M
    near = hat.centre_m[1] - 0.12
    return [
        np.array([side * outer, near]),
        np.array([side * 0.72 * outer, far]),
        np.array([-side * 0.80 * outer, far]),
        np.array([-side * (outer + 0.04), near - 0.02]),
    ]


def _at(plan: Point, z: float) -> Point:
    return np.array([plan[0], plan[1], z])


def _post(plan: Point, taller: list[Point], segments: int) -> Mesh:
    """An upright tube in its clamp, on a foot that lies along the floor."""
    high = _BAR_Z + (0.22 if any(plan is other for other in taller) else 0.12)
    foot = [np.array([plan[0], plan[1] + y, 0.016]) for y in (-0.14, 0.14)]
    return joined(
        [
            rod(_at(plan, 0.016), _at(plan, high), _TUBE_M, Material.LACQUER, segments),
            ball(_at(plan, high), _TUBE_M, Material.RUBBER, 8),
            box((0.06, 0.06, 0.075), Material.BLACK, 0.012).moved(translation(_at(plan, _BAR_Z))),
            rod(foot[0], foot[1], 0.016, Material.LACQUER, segments),
            *(ball(end, 0.020, Material.RUBBER, 8) for end in foot),
        ]
    )


def _clamp(at: Point) -> Mesh:
    return box((0.05, 0.05, 0.055), Material.BLACK, 0.01).moved(translation(at))


def _nearest(bars: list[tuple[Point, Point]], to: Point) -> Point:
    """The point of the bars that is nearest to `to` in plan, not at their very ends."""
    best = []
    for a, b in bars:
        share = float(np.clip((to[:2] - a) @ (b - a) / ((b - a) @ (b - a)), 0.1, 0.9))
        point = a + share * (b - a)
        best.append((float(np.linalg.norm(point - to[:2])), _at(point, _BAR_Z)))
    return min(best, key=lambda pair: pair[0])[1]


def _pad_arm(piece: KitPiece, bars: list[tuple[Point, Point]], segments: int) -> Mesh:
    """A bent rod from the nearest bar to under the pad."""
    under = piece.centre - piece.normal * (piece.depth_m + 0.005)
    low = under - piece.normal * 0.05
    bar = _nearest(bars, low)
    knee = np.array([bar[0], bar[1], low[2]])
    return joined(
        [
            _clamp(bar),
            tube([bar, knee - 0.03 * _UP, knee + 0.06 * unit(low - knee), low], 0.008, Material.CHROME, segments),
            ball(low, 0.018, Material.BLACK, 10),
            rod(low, under + piece.normal * 0.012, (0.012, 0.022), Material.BLACK, segments),
        ]
    )


def _cymbal_arm(piece: KitPiece, posts: list[Point], segments: int, detail: Detail) -> Mesh:
    """A boom from the nearest post to the cymbal, and what holds that."""
    joint = piece.centre - 0.05 * piece.normal
    plan = min(posts, key=lambda post: float(np.linalg.norm(post - joint[:2])))
    away = joint[:2] - plan
    far = float(np.linalg.norm(away))
    high = _at(plan, max(joint[2] - 0.5 * far, _BAR_Z + 0.08))
    back = high - 0.12 * unit(joint - high)
    return joined(
        [
            rod(_at(plan, _BAR_Z), high, 0.012, Material.CHROME, segments),
            ball(high, 0.022, Material.BLACK, 10),
            rod(back, joint, 0.0085, Material.CHROME, segments),
            ball(joint, 0.016, Material.BLACK, 10),
            rod(joint, piece.centre - 0.008 * piece.normal, 0.006, Material.STEEL, segments),
            instrument_meshes.nut(detail).moved(frame(piece.centre, piece.normal, piece.axes[0])),
        ]
    )


def _module(kit: Kit, bars: list[tuple[Point, Point]], segments: int, detail: Detail) -> Mesh:
    """The module on the bar at the hi-hat's side, where the drummer reads it."""
    a, b = bars[0]
    bar = _at(a + 0.05 * (b - a), _BAR_Z)
    at = bar + _MODULE_M * _UP
    look = unit(np.array([*kit.seat_m[:2], 0.0]) - at * [1, 1, 0])
    normal = np.cos(_TILT) * _UP + np.sin(_TILT) * look
    right = np.cross(-look, _UP)
    face = module(detail).moved(frame(at, normal, right))
    return joined([face, _clamp(bar), rod(bar, at - 0.02 * normal, 0.010, Material.CHROME, segments)])


def tower(piece: KitPiece, segments: int) -> Mesh:
    """What an electronic kick's pad stands in: two uprights, a foot plate, and two stays behind."""
    x, y, z = piece.centre
    back = y + piece.depth_m
    parts = [box((0.20, 0.20, 0.012), Material.LACQUER, 0.003).moved(translation([x, back + 0.02, 0.006]))]
    for side in (-1.0, 1.0):
        top = np.array([x + side * 0.085, back, z - 0.02])
        foot = np.array([x + side * 0.20, back + 0.22, 0.012])
        parts += [
            rod([top[0], back, 0.01], top + 0.05 * _UP, 0.014, Material.LACQUER, segments),
            rod(top, foot, 0.010, Material.CHROME, segments),
            ball(foot, 0.016, Material.RUBBER, 8),
        ]
    plate = [(0, 0), (0.10, 0), (0.10, 0.03), (0, 0.03)]
    parts.append(lathe(plate, segments, Material.LACQUER).moved(frame([x, back - 0.005, z], [0, 1, 0], [1, 0, 0])))
    return joined(parts)

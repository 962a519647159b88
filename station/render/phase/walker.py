"""A skeleton as lines on a flat picture, seen from its side at a slant: right limbs in one colour, left in the other.

The camera goes along with the root; the floor's lines show how far. Positions in metres: y up, as motion capture has
them.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.render.palette import INK_FAINT, INK_SOFT, with_opacity
from station.render.phase.phase_plot import LIMB_COLOURS, PLAIN
from station.render.report.report_layout import ReportBox
from station.render.text.draw_list import Colour

YAW_RAD, PITCH_RAD = np.radians(-62.0), np.radians(10.0)
"""How the camera looks at a body that walks along z: almost from its right, a little from above (our choice: it walks
as time runs in the plot)."""
_HEIGHT_M, _LOW_M = 2.15, -0.22
"""What is seen of the room between the picture's edges, and where its lower edge lies (our choice: a tall man)."""
_TILE_M, _TILES = 0.5, 5
"""The floor's lines, and how many to each side."""
_BONE, _JOINT, _STRUCK = 6.0, 4.2, 15.0


class Brush(Protocol):
    """What draws it: a `DrawList`, or a panel of the window; x right, y down."""

    def line(self, start: tuple[float, float], end: tuple[float, float], width: float, colour: Colour) -> None:
        """A straight line."""
        ...

    def ellipse(
        self,
        centre: tuple[float, float],
        half: tuple[float, float],
        colour: Colour,
        turn_rad: float = 0.0,
        style: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> None:
        """An ellipse; the second of `style` is the width of its line, 0 fills it."""
        ...


@dataclass(frozen=True, slots=True)
class Walker:
    """The bones of a skeleton as pairs of joints, and the `feet`; `root` is a joint.

    A bone's near end tells its side, UNKNOWN in the middle.
    """

    bones: tuple[tuple[int, int], ...]
    sides: tuple[Limb, ...]
    feet: tuple[tuple[Limb, int], ...]
    root: int = 0

    @classmethod
    def of(cls, names: tuple[str, ...], bones: tuple[tuple[int, int], ...]) -> "Walker":
        """By the joints' names: r and l, or R and L in the BVH edition, begin those of a side."""
        sides = tuple(_side(names[parent]) for parent, _ in bones)
        feet = tuple((_side(name), k) for k, name in enumerate(names) if name in ("rfoot", "lfoot"))
        return cls(bones, sides, feet)


_FIRST = {"r": Limb.RIGHT_FOOT, "R": Limb.RIGHT_FOOT, "l": Limb.LEFT_FOOT, "L": Limb.LEFT_FOOT}
_MIDDLE = ("root", "lowerback", "lowerneck", "LowerBack")
"""Names that begin with the letter of a side and are of none."""


def _side(name: str) -> Limb:
    if name.startswith(_MIDDLE):
        return Limb.UNKNOWN
    return next((limb for begin, limb in _FIRST.items() if name.startswith(begin)), Limb.UNKNOWN)


def draw_walker(
    brush: Brush, walker: Walker, places: NDArray[np.float64], box: ReportBox, struck: dict[Limb, float]
) -> None:
    """Draw the body at `places` (joints, 3) into `box`; `struck` says how brightly a foot's trigger still shows."""
    view = _View.at(places[walker.root], box)
    _floor(brush, view)
    points = [view.point(place) for place in places]
    depth = places @ view.towards
    for number in np.argsort([depth[list(bone)].mean() for bone in walker.bones]).tolist():
        (parent, child), side = walker.bones[number], walker.sides[number]
        colour = _colour(side)
        brush.line(points[parent], points[child], _BONE * view.pixels_m / 220, colour)
        brush.ellipse(points[child], (_JOINT * view.pixels_m / 220,) * 2, colour)
    for limb, joint in walker.feet:
        if glow := struck.get(limb, 0.0):
            radius = _STRUCK * (2.0 - glow)
            ring = with_opacity(_colour(limb), glow)
            brush.ellipse(view.floor_below(places[joint]), (radius, 0.45 * radius), ring, 0.0, (0.0, 3.0, 0.0))


def _colour(side: Limb) -> Colour:
    return LIMB_COLOURS.get(side, PLAIN)


@dataclass(frozen=True, slots=True, eq=False)
class _View:
    """An orthographic camera: `across` and `up` span the picture, `towards` points at who looks."""

    origin: NDArray[np.float64]
    across: NDArray[np.float64]
    up: NDArray[np.float64]
    towards: NDArray[np.float64]
    pixels_m: float
    place: tuple[float, float]
    box: ReportBox

    @classmethod
    def at(cls, root: NDArray[np.float64], box: ReportBox) -> "_View":
        towards = np.array(
            [np.cos(PITCH_RAD) * np.sin(YAW_RAD), np.sin(PITCH_RAD), np.cos(PITCH_RAD) * np.cos(YAW_RAD)]
        )
        across = np.cross([0.0, 1.0, 0.0], towards)
        across /= np.linalg.norm(across)
        pixels_m = box.height / _HEIGHT_M
        place = (box.left + box.width / 2, box.bottom + _LOW_M * pixels_m)
        return cls(np.array([root[0], 0.0, root[2]]), across, np.cross(towards, across), towards, pixels_m, place, box)

    def point(self, place: NDArray[np.float64]) -> tuple[float, float]:
        away = place - self.origin
        x, y = self.place
        return (x + self.pixels_m * float(away @ self.across), y - self.pixels_m * float(away @ self.up))

    def floor_below(self, place: NDArray[np.float64]) -> tuple[float, float]:
        return self.point(place * (1.0, 0.0, 1.0))


def _floor(brush: Brush, view: _View) -> None:
    """Lines that stand on the floor, so that the body goes past them; paler the farther from it."""
    base = np.floor(view.origin / _TILE_M) * _TILE_M
    reach = _TILES * _TILE_M
    for k in range(-_TILES, _TILES + 1):
        for axis, along in ((0, 2), (2, 0)):
            ends = np.zeros((2, 3))
            ends[:, axis] = base[axis] + k * _TILE_M
            ends[:, along] = view.origin[along] + np.array([-reach, reach])
            near = 1.0 - abs(ends[0, axis] - view.origin[axis]) / (reach + _TILE_M)
            colour = with_opacity(INK_SOFT if k == 0 else INK_FAINT, 0.55 * max(near, 0.0))
            _clipped_line(brush, view.point(ends[0]), view.point(ends[1]), view.box, colour)


def _clipped_line(brush: Brush, a: tuple[float, float], b: tuple[float, float], box: ReportBox, colour: Colour) -> None:
    """The part of a line within `box`, if there is one (Liang and Barsky 1984)."""
    first, last = 0.0, 1.0
    way = (b[0] - a[0], b[1] - a[1])
    for run, room in ((-way[0], a[0] - box.left), (way[0], box.right - a[0]), (-way[1], a[1] - box.top),
                      (way[1], box.bottom - a[1])):  # fmt: skip
        if run == 0 and room < 0:
            return
        if run < 0:
            first = max(first, room / run)
        elif run > 0:
            last = min(last, room / run)
    if first < last:
        start, end = ((a[0] + t * way[0], a[1] + t * way[1]) for t in (first, last))
        brush.line(start, end, 1.2, colour)

"""Outlines of the musical signs that no text font has, drawn by hand for this project.

Units are staff spaces (the distance between two staff lines), y up; each sign's origin is named in its line. Paths are
written in the letters of SVG path data (M, L, C, Z; absolute). Contours of one sign unite, whatever their direction.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from station.render.text.truetype import Contours

_CURVE_STEPS = 10

_BALL = "M {x0} {y} C {x0} {y1} {x1} {y1} {x1} {y} C {x1} {y2} {x0} {y2} {x0} {y} Z"


def _ball(x: float, y: float, radius: float) -> str:
    """A disc; the factor makes two cubic arcs come within 2 % of a circle."""
    k = 4 / 3 * radius
    return _BALL.format(x0=x - radius, x1=x + radius, y=y, y1=y + k, y2=y - k)


def _short_rest(hooks: int) -> str:
    """A rest of an eighth (1 hook), sixteenth (2) or thirty-second (3) note; origin on the staff's middle line."""
    lean, bottom, top = 0.29, -1.0 - (hooks - 1) // 2, 0.70 + hooks // 2
    x_top = lean * (top - bottom)
    parts = [f"M {x_top - 0.09} {top} L {x_top} {top} L 0.07 {bottom} L -0.09 {bottom} Z"]
    for hook in range(hooks):
        y = top - hook
        x = x_top - lean * hook
        ball_x, ball_y = x - 0.72, y - 0.20
        parts.append(_ball(ball_x, ball_y, 0.25))
        parts.append(
            f"M {ball_x - 0.12} {ball_y - 0.21} C {ball_x + 0.2} {ball_y - 0.36} {x - 0.28} {y - 0.36} {x - 0.02} {y}"
            f" L {x - 0.10} {y - 0.34} C {x - 0.34} {y - 0.56} {ball_x + 0.2} {ball_y - 0.42}"
            f" {ball_x - 0.12} {ball_y - 0.21} Z"
        )
    return " ".join(parts)


SIGNS: dict[str, str] = {
    # the rest of a quarter note; origin on the middle line
    "rest_4": "M -0.20 1.50 L 0.42 0.66 C 0.12 0.34 0.14 0.06 0.50 -0.42 L 0.43 -0.50"
    " C 0.08 -0.30 -0.14 -0.68 0.15 -1.20 L 0.07 -1.28 C -0.58 -0.92 -0.60 -0.28 0.06 -0.34"
    " L -0.40 0.30 C -0.08 0.62 -0.06 0.90 -0.27 1.43 Z",
    "rest_8": _short_rest(1),
    "rest_16": _short_rest(2),
    "rest_32": _short_rest(3),
    # a flag on an upward stem; origin at the stem's tip, on its right edge; mirrored for downward stems
    "flag": "M 0 0 C 0.10 -0.80 1.18 -1.10 0.78 -2.62 L 0.70 -2.60 C 0.84 -1.72 0.46 -1.30 0 -1.02 Z",
    "accent": "M -0.80 0.48 L 0.80 0.06 L 0.80 -0.06 L -0.80 -0.48 L -0.80 -0.28 L 0.28 0 L -0.80 0.28 Z",
    # brackets of ghost notes; origin at the crescent's middle
    "bracket_left": "M 0.12 0.92 C -0.36 0.42 -0.36 -0.42 0.12 -0.92 C -0.14 -0.40 -0.14 0.40 0.12 0.92 Z",
    "bracket_right": "M -0.12 0.92 C 0.36 0.42 0.36 -0.42 -0.12 -0.92 C 0.14 -0.40 0.14 0.40 -0.12 0.92 Z",
    # note heads; origin at their middle
    "head_diamond": "M -0.66 0 L 0 0.58 L 0.66 0 L 0 -0.58 Z",
    "head_triangle": "M -0.64 -0.48 L 0.64 -0.48 L 0 0.60 Z",
    "slash": "M -0.85 -0.62 L -0.75 -0.76 L 0.85 0.62 L 0.75 0.76 Z",
    # one stroke of a tremolo, across a stem
    "tremolo": "M -0.55 -0.38 L 0.55 0.04 L 0.55 0.38 L -0.55 -0.04 Z",
    "buzz": "M -0.45 0.50 L 0.45 0.50 L 0.45 0.34 L -0.18 -0.34 L 0.45 -0.34 L 0.45 -0.50 L -0.47 -0.50 L -0.47 -0.34"
    " L 0.16 0.34 L -0.45 0.34 Z",
    # the slur from a grace note to its main note, hanging; origin in the middle of its ends
    "slur": "M -0.70 0 C -0.40 -0.52 0.40 -0.52 0.70 0 C 0.38 -0.34 -0.38 -0.34 -0.70 0 Z",
    # a choked cymbal; origin at the comma's middle
    "choke": "M -0.16 -0.52 C 0.06 -0.30 0.10 -0.10 0.02 0.06 C -0.18 0.02 -0.26 0.18 -0.22 0.32 C -0.18 0.52 0.10 0.56"
    " 0.20 0.34 C 0.32 0.04 0.14 -0.36 -0.10 -0.58 Z",
}


def sign(name: str) -> Contours:
    """The closed polygons (k, 2) of a sign of the table, counter-clockwise."""
    return tuple(_counter_clockwise(np.array(list(points))) for points in _paths(SIGNS[name].split()))


def _paths(words: list[str]) -> Iterator[list[tuple[float, float]]]:
    points: list[tuple[float, float]] = []
    i = 0
    while i < len(words):
        command = words[i]
        pairs = 3 if command == "C" else 0 if command == "Z" else 1
        v = [(float(words[i + 1 + 2 * k]), float(words[i + 2 + 2 * k])) for k in range(pairs)]
        if command == "C":
            points += _cubic(points[-1], v)
        elif command == "Z":
            yield points
            points = []
        else:
            points.append(v[0])
        i += 1 + 2 * pairs


def _cubic(start: tuple[float, float], rest: list[tuple[float, float]]) -> list[tuple[float, float]]:
    p = np.array([start, *rest])
    t = np.linspace(0, 1, _CURVE_STEPS + 1)[1:, None]
    curve = (1 - t) ** 3 * p[0] + 3 * t * (1 - t) ** 2 * p[1] + 3 * t**2 * (1 - t) * p[2] + t**3 * p[3]
    return [(float(x), float(y)) for x, y in curve]


def _counter_clockwise(polygon: NDArray[np.float64]) -> NDArray[np.float64]:
    x, y = polygon.T
    area = np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)
    return polygon if area > 0 else polygon[::-1]

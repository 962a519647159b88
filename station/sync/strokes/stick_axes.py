"""Turns of three axes as unit quaternions (w, x, y, z), in plain floats: a sample at a time, far from numpy's overhead.

`product(a, b)` turns by b first. Source: Diebel, Representing Attitude (2006), § 6.
"""

import math
from collections.abc import Sequence

from station.core.imu import NO_TURN, Quaternion, Vector

Rows = tuple[Vector, Vector, Vector]
"""A rotation matrix by its rows: row i gives component i of the turned vector."""


def product(a: Quaternion, b: Quaternion) -> Quaternion:
    """The turn `b`, then the turn `a`."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def inverse(turn: Quaternion) -> Quaternion:
    """The turn back."""
    w, x, y, z = turn
    return (w, -x, -y, -z)


def rows_of(turn: Quaternion) -> Rows:
    """The rotation matrix of `turn`."""
    w, x, y, z = turn
    return (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
        (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
    )


def turned(rows: Rows, vector: Vector) -> Vector:
    """The vector, turned by a matrix."""
    x, y, z = vector
    (a, b, c), (d, e, f), (g, h, i) = rows
    return (a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z)


def turn_of(rows: Sequence[Sequence[float]]) -> Quaternion:
    """The turn whose matrix is `rows` (orthonormal, right-handed); w ≥ 0 (Shepperd 1978: the largest part first)."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    squares = (1.0 + a + e + i, 1.0 + a - e - i, 1.0 - a + e - i, 1.0 - a - e + i)
    parts = (
        (squares[0], h - f, c - g, d - b),
        (h - f, squares[1], b + d, c + g),
        (c - g, b + d, squares[2], f + h),
        (d - b, c + g, f + h, squares[3]),
    )[squares.index(max(squares))]
    return unit(parts)


def unit(turn: Quaternion) -> Quaternion:
    """The turn at length 1 with w ≥ 0."""
    length = math.copysign(math.sqrt(sum(part * part for part in turn)), turn[0])
    w, x, y, z = turn
    return (w / length, x / length, y / length, z / length) if length else NO_TURN


def between(before: Quaternion, after: Quaternion, dt_s: float) -> Vector:
    """The steady angular rate, rad/s in the body's own axes, that takes one orientation into the next in `dt_s`."""
    w, x, y, z = unit(product(inverse(before), after))
    sine = math.sqrt(x * x + y * y + z * z)
    scale = 2.0 / dt_s if sine < 1e-9 else 2.0 * math.atan2(sine, w) / (sine * dt_s)
    return (x * scale, y * scale, z * scale)

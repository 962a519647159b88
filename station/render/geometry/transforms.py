"""The little geometry that pictures need: frames, views and projections as 4 × 4 matrices for column vectors.

World axes are the station's: x to the drummer's right, y forward, z up, metres. Clip space is OpenGL's.
"""

from math import cos, sin, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

Matrix = NDArray[np.float64]
Vector = NDArray[np.float64]


def unit(v: ArrayLike) -> Vector:
    """`v` (…, 3) at length 1; a zero vector stays zero."""
    a = np.asarray(v, np.float64)
    length = np.sqrt((a * a).sum(axis=-1, keepdims=True))
    return np.asarray(a / np.where(length > 0, length, 1.0), np.float64)


def cross(a: Vector, b: Vector) -> Vector:
    """The vector product of (…, 3) and (…, 3); for few vectors a tenth of the time that numpy's takes."""
    out = np.empty(np.broadcast_shapes(a.shape, b.shape))
    out[..., 0] = a[..., 1] * b[..., 2] - a[..., 2] * b[..., 1]
    out[..., 1] = a[..., 2] * b[..., 0] - a[..., 0] * b[..., 2]
    out[..., 2] = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return out


def frame(origin: ArrayLike, along: ArrayLike, side: ArrayLike) -> Matrix:
    """A rigid frame: its z axis points `along`, its x axis as nearly to `side` as can be; y = z × x."""
    rows = [np.asarray(v, np.float64)[None] for v in (origin, along, side)]
    return np.asarray(frames(*rows)[0])


def frames(origin: Vector, along: Vector, side: Vector) -> Matrix:
    """Many frames at once, (n, 4, 4) from three (n, 3); any side will do where the wanted one lies along the axis."""
    z = unit(along)
    x = side - z * np.sum(z * side, axis=1, keepdims=True)
    lost = np.sum(x * x, axis=1) < _PARALLEL_2
    if lost.any():
        other = np.where(np.abs(z[:, 2:]) < 0.9, [0.0, 0.0, 1.0], [0.0, 1.0, 0.0])
        x = np.where(lost[:, None], cross(z, other), x)
    x = unit(x)
    m = np.zeros((len(z), 4, 4))
    m[:, :3, 0], m[:, :3, 1], m[:, :3, 2], m[:, :3, 3] = x, cross(z, x), z, origin
    m[:, 3, 3] = 1.0
    return m


_PARALLEL_2 = 1e-12
"""Square of a side's part across the axis below which it is lost in rounding."""


def translation(offset: ArrayLike) -> Matrix:
    """A shift."""
    m = np.eye(4)
    m[:3, 3] = offset
    return m


def rotation(axis: ArrayLike, angle_rad: float) -> Matrix:
    """A right-handed turn about an axis through the origin (Rodrigues' formula); numbers outrun small arrays."""
    x, y, z = np.asarray(axis, np.float64).tolist()
    length = sqrt(x * x + y * y + z * z) or 1.0
    x, y, z = x / length, y / length, z / length
    s, v = sin(angle_rad), 1 - cos(angle_rad)
    m = np.eye(4)
    m[:3, :3] = (
        (1 - v * (y * y + z * z), v * x * y - s * z, v * x * z + s * y),
        (v * x * y + s * z, 1 - v * (x * x + z * z), v * y * z - s * x),
        (v * x * z - s * y, v * y * z + s * x, 1 - v * (x * x + y * y)),
    )
    return m


def look_at(eye: ArrayLike, target: ArrayLike, up: ArrayLike = (0.0, 0.0, 1.0)) -> Matrix:
    """World to view: the camera at `eye` looks along −z."""
    e = np.asarray(eye, np.float64)
    back = unit(e - np.asarray(target, np.float64))
    right = unit(cross(np.asarray(up, np.float64), back))
    m = np.eye(4)
    m[0, :3], m[1, :3], m[2, :3] = right, cross(back, right), back
    m[:3, 3] = -m[:3, :3] @ e
    return m


def perspective(fov_y_rad: float, aspect: float, near: float, far: float) -> Matrix:
    """View to clip; `aspect` is width over height."""
    f = 1 / np.tan(fov_y_rad / 2)
    m = np.zeros((4, 4))
    m[0, 0], m[1, 1] = f / aspect, f
    m[2, 2], m[2, 3], m[3, 2] = (far + near) / (near - far), 2 * far * near / (near - far), -1.0
    return m


def gl_bytes(matrices: Matrix) -> bytes:
    """Matrices (…, 4, 4) as OpenGL wants them: float32, column by column."""
    return np.ascontiguousarray(np.swapaxes(matrices, -1, -2), np.float32).tobytes()

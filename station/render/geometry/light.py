"""The key spotlight and the room's dim light, shared by the shader and by what is painted beforehand."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.render.geometry.transforms import Matrix, Vector, look_at, perspective, unit

_REACH = 9.0
_EDGE = (0.70, 0.93)
"""Cosines off the axis at which the spot is dark and full; the shader's `spot` has the same."""


@dataclass(frozen=True, slots=True)
class Light:
    """A warm spotlight at `at` towards `target` (metres), its linear `colour`; `sky` and `ground` light the rest.

    `ground` is what the rug and the boards throw back. A cool light shines from behind, where `rim_from` points; the
    lamps at the wall are of its colour and of `warm_colour`.
    """

    at: tuple[float, float, float] = (1.15, 2.0, 3.3)
    target: tuple[float, float, float] = (0.03, 0.35, 0.6)
    colour: tuple[float, float, float] = (2.05, 1.76, 1.44)
    sky: tuple[float, float, float] = (0.215, 0.245, 0.320)
    ground: tuple[float, float, float] = (0.140, 0.085, 0.070)
    rim_from: tuple[float, float, float] = (-0.55, -0.65, 0.52)
    warm_colour: tuple[float, float, float] = (0.75, 0.36, 0.14)
    rim_colour: tuple[float, float, float] = (0.30, 0.54, 0.86)
    fov_rad: float = 0.82

    @property
    def axis(self) -> Vector:
        """Where it points, (3,)."""
        return unit(np.subtract(self.target, self.at))

    def matrix(self) -> Matrix:
        """World to the shadow map's clip space."""
        return perspective(self.fov_rad, 1.0, 1.2, 5.5) @ look_at(self.at, self.target)

    def on_floor(self, x: NDArray[np.float32], y: NDArray[np.float32]) -> NDArray[np.float32]:
        """How brightly it falls on points of the floor, as the shader reckons it."""
        dx, dy, dz = self.at[0] - x, self.at[1] - y, np.float32(self.at[2])
        far_2 = dx**2 + dy**2 + dz**2
        far = np.sqrt(far_2)
        ax, ay, az = self.axis
        t = np.clip((-(dx * ax + dy * ay + dz * az) / far - _EDGE[0]) / (_EDGE[1] - _EDGE[0]), 0, 1)
        return np.asarray(t * t * (3 - 2 * t) * _REACH / (far_2 + 1) * dz / far, np.float32)

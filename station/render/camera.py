"""Viewpoints: what the named ones are called, and orbiting, panning and zooming; `framing` says where they stand."""

from dataclasses import dataclass, replace

import numpy as np

from station.core.named_view import NamedView
from station.render.geometry.transforms import Matrix, look_at, perspective

NARROW = 1.5
"""Width over height below which pictures widen their angle (our choice: a kit is wider than high)."""
_NEAR_M, _FAR_M = 0.06, 16.0
_MIN_DISTANCE_M, _MAX_DISTANCE_M = 0.5, 4.4
"""Orbiting stays within the room."""
_LOWEST_M, _HIGHEST_RAD, _LOWEST_RAD = 0.15, 1.53, -0.35


VIEW_NAMES = {
    NamedView.FRONT: "Front",
    NamedView.SHOULDER: "Over the shoulder",
    NamedView.EYES: "Drummer's eyes",
    NamedView.TOP: "Top",
    NamedView.HANDS: "Hands",
    NamedView.FEET: "Feet",
    NamedView.LEFT_HAND: "Left hand",
    NamedView.RIGHT_HAND: "Right hand",
}


@dataclass(frozen=True, slots=True)
class Camera:
    """Looks at `target` from `distance_m` away: `azimuth_rad` about z from +x, `height_rad` above the horizon.

    What is nearer than `near_m` is not drawn.
    """

    target: tuple[float, float, float]
    azimuth_rad: float
    height_rad: float
    distance_m: float
    fov_rad: float = 0.70
    mirrored: bool = False
    near_m: float = _NEAR_M

    @property
    def eye(self) -> tuple[float, float, float]:
        """Where the camera stands."""
        flat = self.distance_m * np.cos(self.height_rad)
        x, y, z = self.target
        return (
            float(x + flat * np.cos(self.azimuth_rad)),
            float(y + flat * np.sin(self.azimuth_rad)),
            float(z + self.distance_m * np.sin(self.height_rad)),
        )

    def matrix(self, aspect: float) -> Matrix:
        """World to clip for a picture `aspect` times as wide as high; narrow pictures widen their angle."""
        fov = self.fov_rad if aspect >= NARROW else 2 * np.arctan(np.tan(self.fov_rad / 2) * NARROW / aspect)
        clip = perspective(float(fov), aspect, self.near_m, _FAR_M)
        if self.mirrored:
            clip[0] = -clip[0]
        return clip @ look_at(self.eye, self.target)

    def orbited(self, right_rad: float, up_rad: float) -> "Camera":
        """Turned about its target."""
        height = float(np.clip(self.height_rad + up_rad, _LOWEST_RAD, _HIGHEST_RAD))
        moved = replace(self, azimuth_rad=self.azimuth_rad - right_rad, height_rad=height)
        return moved if moved.eye[2] > _LOWEST_M else self

    def panned(self, right_m: float, up_m: float) -> "Camera":
        """Its target shifted in the picture's plane."""
        view = look_at(self.eye, self.target)
        shift = view[0, :3] * right_m + view[1, :3] * up_m
        x, y, z = np.clip(np.array(self.target) + shift, [-1.5, -1.0, 0.1], [1.5, 2.0, 2.0])
        return replace(self, target=(float(x), float(y), float(z)))

    def zoomed(self, factor: float) -> "Camera":
        """Nearer for factors above 1."""
        return replace(self, distance_m=float(np.clip(self.distance_m / factor, _MIN_DISTANCE_M, _MAX_DISTANCE_M)))

"""Viewpoints: named ones that follow the kit and the drummer, and orbiting, panning and zooming from any of them."""

from dataclasses import dataclass, replace
from enum import IntEnum

import numpy as np

from station.render.geometry.transforms import Matrix, look_at, perspective

_NEAR_M, _FAR_M = 0.06, 16.0
_MIN_DISTANCE_M, _MAX_DISTANCE_M = 0.5, 4.4
"""Orbiting stays within the room."""
_LOWEST_M, _HIGHEST_RAD, _LOWEST_RAD = 0.15, 1.53, -0.35


class NamedView(IntEnum):
    """The named views."""

    FRONT = 0
    SHOULDER = 1
    EYES = 2
    TOP = 3
    HANDS = 4
    FEET = 5
    LEFT_HAND = 6
    RIGHT_HAND = 7


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
    """Looks at `target` from `distance_m` away: `azimuth_rad` about z from +x, `height_rad` above the horizon."""

    target: tuple[float, float, float]
    azimuth_rad: float
    height_rad: float
    distance_m: float
    fov_rad: float = 0.70
    mirrored: bool = False

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
        fov = self.fov_rad if aspect >= 1.5 else 2 * np.arctan(np.tan(self.fov_rad / 2) * 1.5 / aspect)
        clip = perspective(float(fov), aspect, _NEAR_M, _FAR_M)
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


_DEG = np.pi / 180


def named(view: NamedView, left_handed: bool = False) -> Camera:
    """The camera of a named view, on the other side for a kit that leads with the left hand."""
    camera = _CAMERAS[_OTHER_HAND.get(view, view) if left_handed else view]
    if not left_handed:
        return camera
    x, y, z = camera.target
    return replace(camera, target=(-x, y, z), azimuth_rad=np.pi - camera.azimuth_rad)


_CAMERAS = {
    NamedView.FRONT: Camera((0.06, 0.40, 0.70), 70 * _DEG, 13 * _DEG, 2.95, 0.66),
    NamedView.SHOULDER: Camera((0.02, 0.60, 0.70), -54 * _DEG, 50 * _DEG, 1.85, 0.78),
    NamedView.EYES: Camera((0.05, 0.74, 0.62), -90 * _DEG, 54 * _DEG, 0.86, 1.15),
    NamedView.TOP: Camera((0.08, 0.48, 0.6), -90 * _DEG, 88 * _DEG, 2.1, 0.80),
    NamedView.HANDS: Camera((-0.03, 0.42, 0.78), 70 * _DEG, 44 * _DEG, 1.20, 0.62),
    NamedView.FEET: Camera((-0.02, 0.50, 0.18), 222 * _DEG, 22 * _DEG, 1.50, 0.62),
    NamedView.LEFT_HAND: Camera((-0.12, 0.33, 0.74), 176 * _DEG, 46 * _DEG, 0.86, 0.60),
    NamedView.RIGHT_HAND: Camera((0.00, 0.42, 0.82), 38 * _DEG, 34 * _DEG, 0.86, 0.66),
}
_OTHER_HAND = {NamedView.LEFT_HAND: NamedView.RIGHT_HAND, NamedView.RIGHT_HAND: NamedView.LEFT_HAND}
"""A kit that leads with the left hand is the other one in a mirror: so are its hands."""

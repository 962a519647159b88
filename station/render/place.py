"""Where somebody's kit stands in the room: a turn about the vertical and a shift; and where two of them stand.

Kit, figure and pose are given in axes of their own, with the throne's foot as origin; a place carries them into the
room. Two drummers stand side by side, turned towards each other, so that both see one another and the audience both.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from math import cos, radians, sin

import numpy as np

from station.render.camera import Camera
from station.render.geometry.light import Light
from station.render.geometry.transforms import Matrix


@dataclass(frozen=True)
class Place:
    """The throne's foot at (`x_m`, `y_m`), what was forward turned by `turn_rad` to the left."""

    x_m: float = 0.0
    y_m: float = 0.0
    turn_rad: float = 0.0

    @cached_property
    def matrix(self) -> Matrix:
        """Own axes to the room's, (4, 4)."""
        c, s = cos(self.turn_rad), sin(self.turn_rad)
        return np.array([[c, -s, 0, self.x_m], [s, c, 0, self.y_m], [0, 0, 1, 0], [0, 0, 0, 1]], np.float64)

    @cached_property
    def inverse(self) -> Matrix:
        """The room's axes to own ones, (4, 4)."""
        return np.asarray(np.linalg.inv(self.matrix), np.float64)

    def own(self, point: tuple[float, float, float]) -> tuple[float, float, float]:
        """A point of the room in own axes."""
        x, y, z, _ = (self.inverse @ [*point, 1.0]).tolist()
        return x, y, z

    def placed(self, point: tuple[float, float, float]) -> tuple[float, float, float]:
        """A point in own axes as one of the room."""
        x, y, z, _ = (self.matrix @ [*point, 1.0]).tolist()
        return x, y, z

    def camera(self, own: Camera) -> Camera:
        """A camera in own axes as one of the room."""
        return replace(own, target=self.placed(own.target), azimuth_rad=own.azimuth_rad + self.turn_rad)

    def light(self, own: Light) -> Light:
        """A light in own axes as one of the room."""
        way = self.matrix[:3, :3] @ own.rim_from
        x, y, z = way.tolist()
        return replace(own, at=self.placed(own.at), target=self.placed(own.target), rim_from=(x, y, z))


ALONE = Place()
"""The room's middle, where one drummer plays."""
_APART_M, _BACK_M, _TURN_RAD = 1.25, -0.35, radians(24)
"""Half the way between two thrones, how far back they are, and how far both turn inward (our choice: the rims of the
largest two kits stay a hand's breadth apart, and no kit is before the other's drummer as the audience sees them)."""
TWO = (Place(_APART_M, _BACK_M, _TURN_RAD), Place(-_APART_M, _BACK_M, -_TURN_RAD))
"""The first is on the left of who looks from the front, as their name is."""

"""How loud a stroke of each dynamic is where nobody says: the middle of HUMANS' ranges."""

from station.core.pieces import Dynamic
from station.music.grace_strokes import MAX_VELOCITY, MIN_VELOCITY

USUAL_VELOCITIES: tuple[int, int, int] = (32, 80, 116)
"""Ghost, normal and accent, by `Dynamic`. HUMANS: ghost 20–45, normal 60–95, accent 105–127."""


def usual_velocity(dynamic: Dynamic) -> int:
    """Velocity 1–127 of a stroke of which only the dynamic is known."""
    return USUAL_VELOCITIES[dynamic]


def shaded(velocity: int, dynamic: Dynamic, beside: Dynamic = Dynamic.NORMAL) -> int:
    """Velocity 1–127 of a stroke marked `dynamic` where one that is marked `beside` has `velocity`."""
    loud = velocity * USUAL_VELOCITIES[dynamic] / USUAL_VELOCITIES[beside]
    return min(max(round(loud), MIN_VELOCITY), MAX_VELOCITY)

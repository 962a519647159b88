"""The views of the drummer by name: what a teacher asks for at a bar, and what the camera shows."""

from enum import IntEnum


class NamedView(IntEnum):
    """A place to look from."""

    FRONT = 0
    SHOULDER = 1
    EYES = 2
    TOP = 3
    HANDS = 4
    FEET = 5
    LEFT_HAND = 6
    RIGHT_HAND = 7

"""Whether a kit can stand and be sat at: pieces that are in one another, in the drummer, boards under one foot."""

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import word
from station.core.toml.toml_faults import wrong
from station.motion.kit.piece import KitPiece

Place = tuple[float, float, float]

_LEAST_APART_M, _MOST_INSIDE_M = 0.04, 0.03
"""Nearer centres, or a surface deeper in another's shell, are no kit that stands (our choice; hoops may touch)."""
_BELLY_M, _TRUNK_M = 0.12, 0.6
"""A trunk reaches so far before the spine (ANSUR II: a man's chest is 25 cm deep) and so far up from the seat."""
_BOARDS_APART_M = 0.09
"""Footboards are so broad, and so is a shoe: nearer middles are under one foot (our choice)."""


def check_apart(pieces: list[KitPiece]) -> None:
    """Refuse pieces in one place, or of which one's head or bow is inside another's shell."""
    for k, one in enumerate(pieces):
        for other in pieces[:k]:
            apart_m = math.dist(one.centre_m, other.centre_m)
            deep_m = max(_inside_m(one, other), _inside_m(other, one))
            if apart_m < _LEAST_APART_M or deep_m > _MOST_INSIDE_M:
                how = f"{100 * deep_m:.0f} cm deep" if deep_m > _MOST_INSIDE_M else "their centres are in one place"
                fault = f"overlaps the {word(other.piece)}: {how}"
                raise wrong(fault, word(one.piece), "centre_m")


def _inside_m(one: KitPiece, other: KitPiece) -> float:
    """How deep the struck surface of `one` is in the shell of `other`, negative outside."""
    around = np.linspace(0.0, 2 * math.pi, 24, endpoint=False)
    right, away, _ = one.axes
    edge = one.centre + one.radius_m * (np.cos(around)[:, None] * right + np.sin(around)[:, None] * away)
    off = np.vstack((one.centre, edge)) - other.centre
    height = off @ other.normal
    radial = np.sqrt(np.maximum((off**2).sum(1) - height**2, 0.0))
    return float(np.minimum(np.minimum(-height, height + other.depth_m), other.radius_m - radial).max())


def check_off_the_player(pieces: list[KitPiece], seat_m: Place) -> None:
    """Refuse pieces of which a part is where the trunk of who sits there is."""
    x, y, seat = seat_m
    for piece in pieces:
        px, py, top = piece.centre_m
        off_m = math.hypot(px - x, py - y) - piece.radius_m
        if piece.kind != "kick" and off_m < _BELLY_M and seat < top and top - piece.depth_m < seat + _TRUNK_M:
            fault = f"is where the drummer sits: its rim is {100 * off_m:.0f} cm from the middle of the seat"
            raise wrong(f"{fault}, expected at least {100 * _BELLY_M:.0f}", word(piece.piece), "centre_m")


def check_boards(boards: Mapping[str, tuple[Place, Place]]) -> None:
    """Refuse footboards, each from heel to toe, that are in one place."""
    along = np.linspace(0.0, 1.0, 32)[:, None]
    known: dict[str, NDArray[np.float64]] = {}
    for key, (heel, toe) in boards.items():
        middle = (np.array(heel) + along * (np.array(toe) - np.array(heel)))[:, :2]
        for other, there in known.items():
            apart_m = float(np.linalg.norm(middle[:, None] - there, axis=-1).min())
            if apart_m < _BOARDS_APART_M:
                fault = f"is {100 * apart_m:.0f} cm from the board of the {other}'s pedal"
                raise wrong(f"{fault}, expected at least {100 * _BOARDS_APART_M:.0f}", "pedals", key, "heel_m")
        known[key] = middle

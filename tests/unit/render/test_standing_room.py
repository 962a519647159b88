"""Stands end in what they hold and stand in nothing: looked at here by segments and solids of this test's own."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kinematics.body_solids import segments_apart
from station.motion.kit.kit import Kit, kit_names, load_kit
from station.render.geometry.materials import Material
from station.render.kit.hardware import hardware
from station.render.kit.instrument_meshes import Detail
from station.render.kit.standing_room import StandingRoom, stand_lines

Array = NDArray[np.float64]
SPREAD, HEIGHT = 0.27, 0.36
ACOUSTIC = [name for name in kit_names() if load_kit(name).make == "acoustic"]


def stands(kit: Kit) -> dict[Piece, Array]:
    """The lines (5, 2, 3) of every cymbal's stand."""
    room, found = StandingRoom.of(kit), {}
    for piece in kit.pieces.values():
        if piece.kind == "cymbal":
            top = piece.centre - 0.06 * piece.normal
            found[piece.piece] = stand_lines(room.without(piece).place(top, SPREAD, HEIGHT), top, SPREAD, HEIGHT)
    return found


@pytest.mark.parametrize("name", ACOUSTIC)
def test_no_cymbal_stand_goes_through_a_drum(name: str) -> None:
    kit = load_kit(name)
    for piece, lines in stands(kit).items():
        for drum in kit.pieces.values():
            if drum.kind in ("drum", "kick"):
                points = np.concatenate([a + np.linspace(0, 1, 60)[:, None] * (b - a) for a, b in lines])
                height = (points - drum.centre) @ drum.normal
                radial = np.linalg.norm(points - drum.centre - np.outer(height, drum.normal), axis=1)
                inside = (height < 0) & (height > -drum.depth_m) & (radial < drum.radius_m + 0.005)
                assert not inside.any(), (piece, drum.piece)


def _long(lines: Array) -> NDArray[np.bool_]:
    """A straight stand has no boom."""
    long: NDArray[np.bool_] = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1) > 0.001
    return long


@pytest.mark.parametrize("name", ACOUSTIC)
def test_no_tripod_stands_in_another_s(name: str) -> None:
    """Pipes of 17 mm at most."""
    found = list(stands(load_kit(name)).values())
    for k, one in enumerate(found):
        for other in found[:k]:
            for a, b in one[_long(one)]:
                for c, d in other[_long(other)]:
                    assert segments_apart(a[None], b[None], c[None], d[None])[0] > 0.018


@pytest.mark.parametrize("name", kit_names())
def test_every_cymbal_has_a_felt_and_a_rod_through_its_hole(name: str) -> None:
    kit = load_kit(name)
    parts = hardware(kit, Detail(28, hardware=True))
    felt, steel = (
        np.concatenate([p.position[p.material == m] for p in parts]) for m in (Material.FELT, Material.STEEL)
    )
    for piece in kit.pieces.values():
        if piece.kind == "cymbal":
            for what, low, high in ((felt, 0.015, 0.05), (steel, 0.03, 0.08), (steel, -0.10, -0.005)):
                off = what - piece.centre
                along = off @ piece.normal
                beside = np.linalg.norm(off - np.outer(along, piece.normal), axis=1)
                assert ((beside < 0.02) & (along > low) & (along < high)).any(), (piece.piece, low)


@pytest.mark.parametrize("name", kit_names())
def test_hardware_stands_on_the_floor_near_its_kit(name: str) -> None:
    """No part is farther out than a boom and a tripod from what it holds."""
    kit = load_kit(name)
    reach = max(math.hypot(*p.centre_m[:2]) + p.radius_m for p in kit.pieces.values()) + 0.75
    points = np.concatenate([p.position for p in hardware(kit, Detail(12, hardware=False))])
    assert points[:, 2].min() > -0.02
    assert np.hypot(points[:, 0], points[:, 1]).max() < reach

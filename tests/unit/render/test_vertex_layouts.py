"""Solids: volumes by formula, surfaces closed, normals outward."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.render.geometry.implicit import Field, Surface, cone, cut, egg, plane, smooth_min, surface, united, without
from station.render.geometry.mesh import Mesh, ball, box, joined, lathe, rod, tube
from station.render.geometry.transforms import rotation, translation

Floats = NDArray[np.float64]


def volume(solid: Mesh | Surface) -> float:
    """By the divergence theorem: positive where faces wind counter-clockwise seen from outside."""
    a, b, c = (solid.position[solid.faces[:, k]] for k in range(3))
    return float(np.sum(a * np.cross(b, c)) / 6)


def normals_agree(solid: Mesh | Surface) -> bool:
    """Whether every face with an area looks the way its corners' normals do."""
    a, b, c = (solid.position[solid.faces[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    looks = solid.normal[solid.faces].sum(axis=1)
    large = np.linalg.norm(across, axis=1) > 1e-12
    return bool((np.sum(across * looks, axis=1)[large] > 0).all())


def is_closed(solid: Surface) -> bool:
    """Whether every edge is walked once in each direction."""
    f = solid.faces.astype(np.int64)
    edges = np.concatenate([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]])
    code = edges[:, 0] * (f.max() + 1) + edges[:, 1]
    back = edges[:, 1] * (f.max() + 1) + edges[:, 0]
    return len(np.unique(code)) == len(code) and np.array_equal(np.sort(code), np.sort(back))


@pytest.mark.parametrize(
    ("mesh", "expected"),
    [
        (ball((1, 2, 3), 0.5, 0, 64), 4 / 3 * np.pi * 0.125),
        (rod((0, 0, 0), (0, 3, 4), 0.1, 0, 96), np.pi * 0.01 * 5),
        (rod((0, 0, 0), (0, 0, 2), (0.2, 0.1), 0, 96), np.pi * 2 / 3 * (0.04 + 0.02 + 0.01)),
        (box((1, 2, 3), 0), 6.0),
        # a bevel of b takes b²/2 off each edge's length between the corners, and 2/3 b³ + ... off each corner
        (lathe([(0, 0), (0.3, 0), (0.3, 1), (0, 1)], 128, 0), np.pi * 0.09),
    ],
)
def test_volumes_of_meshes(mesh: Mesh, expected: float) -> None:
    assert volume(mesh) == pytest.approx(expected, rel=0.01)
    assert normals_agree(mesh)


def test_a_chamfered_box_is_smaller_and_looks_outward() -> None:
    mesh = box((1, 2, 3), 0, 0.1)
    # b²/2 off every edge, less the three edges' overlap in each corner: by adding up prisms 6 − 0.12 + 8·b³·(5/6 − …)
    assert 5.86 < volume(mesh) < 5.90
    assert normals_agree(mesh)


def test_a_pipe_has_its_radius() -> None:
    mesh = tube([(0, 0, 0), (0, 0, 1), (0, 0.3, 2)], 0.05, 0, 12)
    assert normals_agree(mesh)
    assert np.allclose(np.hypot(mesh.position[:13, 0], mesh.position[:13, 1]), 0.05)


def test_moving_and_joining() -> None:
    first, second = box((1, 1, 1), 3), ball((0, 0, 0), 1, 4)
    moved = first.moved(translation([5, 0, 0]) @ rotation([0, 0, 1], 0.7))
    both = joined([moved, second.on_bone(2)])
    assert volume(moved) == pytest.approx(1)
    assert volume(both) == pytest.approx(volume(first) + volume(second))
    assert set(both.material.tolist()) == {3, 4}
    assert both.bone[-1] == 2


@pytest.mark.parametrize(
    ("field", "expected"),
    [
        (egg((0, 0, 0), (0.1, 0.2, 0.3)), 4 / 3 * np.pi * 0.006),
        (cone((0, 0, -0.2), (0, 0, 0.2), 0.1, 0.1), 4 / 3 * np.pi * 0.001 + np.pi * 0.01 * 0.4),
        (cut(egg((0, 0, 0), (0.3, 0.3, 0.3)), plane((0, 0, 0), (0, 0, 1)), 0.001), 2 / 3 * np.pi * 0.027),
        (without(egg((0, 0, 0), (0.3,) * 3), egg((0, 0, 0), (0.2,) * 3), 0.001), 4 / 3 * np.pi * (0.027 - 0.008)),
    ],
)
def test_volumes_of_fields(field: Field, expected: float) -> None:
    skin = surface(field, (-0.4,) * 3, (0.4,) * 3, 0.02)
    assert volume(skin) == pytest.approx(expected, rel=0.03)
    assert is_closed(skin)
    assert normals_agree(skin)


def test_the_surface_lies_on_its_field() -> None:
    blob = united([egg((0, 0, 0), (0.1, 0.1, 0.2)), cone((0, 0, 0), (0.2, 0, 0), 0.05, 0.08)], 0.05)
    skin = surface(blob, (-0.3,) * 3, (0.4,) * 3, 0.02)
    assert is_closed(skin)
    assert np.abs(blob(skin.position)).max() < 1e-4


def test_a_smooth_minimum_is_the_minimum_away_from_the_joint() -> None:
    a, b = np.array([0.0, 1.0, 5.0]), np.array([1.0, 0.0, 5.0])
    assert smooth_min(a, b, 0.5).tolist() == [0.0, 0.0, 5.0 - 0.5 / 4]  # a quarter of the width at the very joint

"""Every drummer that ships, and every word that a look may say, makes a whole skin."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from station.motion.kinematics.figure import Figure, Joint, figure_names, figure_of, load_figure
from station.motion.kinematics.look import WORDS, WORN, Colours, Look
from station.render.figure.body import build_body
from station.render.figure.bones import Bone
from station.render.figure.hair import _surface
from station.render.figure.skeleton import Skeleton, bind_stance
from station.render.figure.skin import Skin
from station.render.geometry import implicit
from station.render.geometry.implicit import clipped, egg, plane, surface
from station.render.geometry.materials import Material, shader_table
from station.render.quality import QUALITIES
from tests.unit.render.poses import pose_of

COARSE = QUALITIES[0].figure_cell
PEOPLE = {name: load_figure(name) for name in figure_names()}
SKINS = {name: build_body(figure, COARSE) for name, figure in PEOPLE.items()}
MOST_TRIANGLES = 25_000
"""Of a figure at the lowest quality: with a kit 37,000, which take two cores 12 ms, of 16 that a picture may take."""


def skin_in(figure: Figure, joints_m: NDArray[np.float64], facing: NDArray[np.float64]) -> Skin:
    """The skin where a pose carries it."""
    skin = build_body(figure, COARSE)
    m = Skeleton(figure).matrices(pose_of(figure, joints_m=joints_m, facing=facing))
    carried = np.einsum("nbij,nj->nbi", m[skin.bones], np.c_[skin.position, np.ones(len(skin.position))])
    return replace(skin, position=np.einsum("nb,nbi->ni", skin.weights, carried)[:, :3])


@pytest.mark.parametrize("name", figure_names())
def test_a_drummer_is_whole(name: str) -> None:
    skin, figure = SKINS[name], PEOPLE[name]
    assert np.isfinite(skin.position).all()
    assert np.allclose(np.linalg.norm(skin.normal, axis=1), 1, atol=1e-6)
    assert np.allclose(skin.weights.sum(axis=1), 1)
    assert len(skin.faces) < MOST_TRIANGLES
    crown = bind_stance(figure).joints_m[Joint.CROWN][2]
    assert crown - 0.01 < skin.position[:, 2].max() < crown + 0.10, "hair or a hat above the crown"
    assert {Material.SKIN, Material.HAIR, Material.IRIS, Material.LIP} <= {
        Material(m) for m in np.unique(skin.material)
    }


def test_drummers_differ_in_breadth_and_height() -> None:
    boxes = {name: np.ptp(skin.position, axis=0) for name, skin in SKINS.items()}
    assert boxes["beard"][2] > boxes["headphones"][2] + 0.05 > boxes["ponytail"][2] + 0.05
    waist = {name: _breadth(name, Joint.SPINE) for name in SKINS}
    assert waist["curls"] > waist["headphones"] > waist["ponytail"]


def _breadth(name: str, joint: Joint) -> float:
    """How broad the trunk is at a joint's height."""
    skin, at = SKINS[name], bind_stance(PEOPLE[name]).joints_m[joint]
    trunk = np.isin(skin.bones[:, 0], (Bone.WAIST, Bone.CHEST)) & (np.abs(skin.position[:, 2] - at[2]) < 0.05)
    return float(np.ptp(skin.position[trunk, 0]))


@pytest.mark.parametrize(("part", "word"), [(part, word) for part, words in WORDS.items() for word in words])
def test_every_word_of_a_look_can_be_worn(part: str, word: str) -> None:
    look = replace(Look(), **{part: word})  # type: ignore[arg-type] # words alone
    skin = build_body(replace(figure_of(), look=look), 4.0)
    assert np.isfinite(skin.position).all()


def test_what_is_worn_beside_is_seen() -> None:
    bare = len(build_body(replace(figure_of(), look=Look(worn=())), 4.0).faces)
    for thing in WORN:
        assert len(build_body(replace(figure_of(), look=Look(worn=(thing,))), 4.0).faces) > bare, thing


def test_colours_are_the_drummers_own() -> None:
    first, _ = shader_table(Colours(skin=(0.5, 0.4, 0.3)))
    assert first[Material.SKIN, :3] == pytest.approx([0.25, 0.16, 0.09])
    assert np.array_equal(first[Material.CHROME], shader_table()[0][Material.CHROME])


def test_a_trunk_that_twists_keeps_its_waist() -> None:
    """Chest and shoulders turned by 40°: halfway, linear blending leaves cos 20° of the breadth, no less."""
    figure = figure_of()
    joints = bind_stance(figure).joints_m.copy()
    c, s = np.cos(np.radians(40)), np.sin(np.radians(40))
    above = [j for j in Joint if j not in (Joint.PELVIS, Joint.SPINE) and j < Joint.RIGHT_HIP]
    axis = joints[Joint.NECK] * [1, 1, 0]
    joints[above] = (joints[above] - axis) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T + axis
    facing = np.array([-s, c, 0.0])
    before, after = build_body(figure, COARSE), skin_in(figure, joints, facing)
    spine = bind_stance(figure).joints_m[Joint.SPINE]
    ring = (before.material == Material.SHIRT) & (np.abs(before.position[:, 2] - spine[2]) < 0.05)
    ring &= np.isin(before.bones[:, 0], (Bone.WAIST, Bone.CHEST))
    was, now = (np.linalg.norm((skin.position - spine)[ring, :2], axis=1) for skin in (before, after))
    assert (now > 0.9 * was - 0.004).all()


def test_a_clipped_surface_ends_exactly_at_the_wall() -> None:
    """A unit ball cut at z = 0.3: what is left ends in a circle of radius √(1 − 0.09)."""
    ball = surface(egg((0, 0, 0), (1, 1, 1)), (-1.3, -1.3, -1.3), (1.3, 1.3, 1.3), 0.2)
    wall = plane((0, 0, 0.3), (0, 0, 1))
    left = clipped(ball, wall)
    assert left.position[:, 2].max() == pytest.approx(0.3, abs=1e-9)
    rim = np.abs(left.position[:, 2] - 0.3) < 1e-9
    assert np.hypot(*left.position[rim, :2].T) == pytest.approx(np.sqrt(0.91), abs=0.02)
    corners = left.position[left.faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("ij,ij->i", normal, corners.mean(axis=1)) > 0).all(), "faces still look outward"
    area = np.linalg.norm(normal, axis=1).sum() / 2
    assert area == pytest.approx(2 * np.pi * 1.3, rel=0.02)  # Archimedes: 2πrh


def test_what_lies_far_from_a_surface_need_not_be_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """The whole skin is the same where every cell is looked at."""
    figure = replace(figure_of(), look=Look(hair="curls", top="hoodie"))
    quick = build_body(figure, 2.0)
    monkeypatch.setattr(implicit, "_BLOCK", 1)
    _surface.cache_clear()
    whole = build_body(figure, 2.0)
    assert np.array_equal(quick.faces, whole.faces)
    assert np.allclose(quick.position, whole.position, atol=1e-12)

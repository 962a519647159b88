"""The kit's bones: what strikes meets what is struck."""

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from station.core.pieces import Piece
from station.motion.kinematics.figure import figure_of
from station.motion.kinematics.pose import LEFT, RIGHT, Pose
from station.motion.kit.kit import load_kit
from station.render.geometry.materials import Material
from station.render.kit.held_meshes import HELD_BONES, STICK_M
from station.render.kit.instrument_meshes import HOLE_M, Detail, cymbal, drum
from station.render.kit.kit_rig import WORLD, KitRig, bone_matrices, floor_discs, kit_mesh, rig_of
from station.render.quality import QUALITIES
from tests.unit.render.poses import pose_of

KIT = load_kit()
RIG = rig_of(KIT, kit_mesh(KIT, Detail(28, hardware=False)))


def pose(**changes: ArrayLike) -> Pose:
    return pose_of(figure_of(), len(KIT.pieces), **changes)


def corners(rig: KitRig, bone: int, at: Pose | None) -> NDArray[np.float64]:
    mine = rig.mesh.position[rig.mesh.bone == bone]
    m = bone_matrices(rig, at)[bone]
    return np.asarray(mine @ m[:3, :3].T + m[:3, 3], np.float64)


def test_at_angle_zero_the_beater_touches_the_head_and_no_more() -> None:
    head_y = KIT.pieces[Piece.KICK].centre_m[1]
    struck, back = (corners(RIG, RIG.pedals.beater, pose(beater_rad=angle)) for angle in (0.0, 0.8))
    assert struck[:, 1].max() == pytest.approx(head_y, abs=1e-9)
    touching = struck[:, 1].argmax()
    assert back[touching, 1] < head_y - 0.1, "drawn back towards the player"


@pytest.mark.parametrize("side", [RIGHT, LEFT])
def test_sticks_reach_from_butt_to_tip(side: int) -> None:
    butt, tip = np.array([[0.1, 0.2, 0.9], [-0.1, 0.2, 0.9]]), np.array([[0.2, 0.6, 0.8], [-0.2, 0.5, 0.8]])
    stick = corners(RIG, RIG.sticks[HELD_BONES * side], pose(butt_m=butt, tip_m=tip))
    along = (tip[side] - butt[side]) / np.linalg.norm(tip[side] - butt[side])
    reach = (stick - butt[side]) @ along
    assert reach.min() == pytest.approx(0, abs=1e-9)
    assert reach.max() == pytest.approx(np.linalg.norm(tip[side] - butt[side]))
    beside = np.linalg.norm((stick - butt[side]) - reach[:, None] * along, axis=1)
    assert beside.max() < 0.009, "as thick as a 5A"


def test_without_a_drummer_no_stick_is_seen() -> None:
    assert np.ptp(corners(RIG, RIG.sticks[RIGHT], None)) == 0


def test_a_raised_footboard_turns_about_its_heel() -> None:
    pedal = KIT.pedals[Piece.KICK]
    flat = corners(RIG, RIG.pedals.right_board, pose())
    raised = corners(RIG, RIG.pedals.right_board, pose(footboard_rad=(0.35, 0.0)))
    assert raised[:, 2].max() > flat[:, 2].max() + 0.05
    heel = np.linalg.norm(flat - pedal.heel_m, axis=1).argmin()
    assert np.linalg.norm(raised[heel] - flat[heel]) < 0.02


def test_the_upper_hat_rises_with_the_pedal() -> None:
    bone = RIG.piece_bones[Piece.HIHAT]
    closed, opened = corners(RIG, bone, pose()), corners(RIG, bone, pose(hat_gap_m=0.03))
    assert np.allclose(opened - closed, 0.03 * KIT.pieces[Piece.HIHAT].normal)


def test_a_struck_cymbal_tips_about_its_own_axes() -> None:
    index = list(KIT.pieces).index(Piece.CRASH_1)
    swing = np.zeros((len(KIT.pieces), 2))
    swing[index, 0] = 0.1
    still, tipped = (corners(RIG, RIG.piece_bones[Piece.CRASH_1], pose(swing_rad=s)) for s in (swing * 0, swing))
    crash = KIT.pieces[Piece.CRASH_1]
    centre = crash.centre + HOLE_M * crash.normal  # where it hangs
    assert np.allclose(np.linalg.norm(tipped - centre, axis=1), np.linalg.norm(still - centre, axis=1))
    assert np.abs(tipped - still).max() == pytest.approx(0.1 * KIT.pieces[Piece.CRASH_1].radius_m, rel=0.05)


@pytest.mark.parametrize("piece", list(KIT.pieces))
def test_every_piece_stands_where_the_kit_says(piece: Piece) -> None:
    part = KIT.pieces[piece]
    mine = corners(RIG, RIG.piece_bones[piece], None)
    away = np.linalg.norm((mine - part.centre) - np.outer((mine - part.centre) @ part.normal, part.normal), axis=1)
    assert part.radius_m * 0.97 < away.max() < part.radius_m + 0.035


def test_a_head_is_flat_at_its_plane() -> None:
    mesh = drum(0.178, 0.14, 10, Detail(28, hardware=True))
    skin = mesh.position[(mesh.material == Material.HEAD) & (mesh.normal[:, 2] > 0.9)]
    assert np.abs(skin[np.hypot(skin[:, 0], skin[:, 1]) < 0.9 * 0.178, 2]).max() < 1e-9


def test_a_cymbal_s_bow_lies_in_its_plane_where_it_is_struck() -> None:
    mesh = cymbal(0.254, Detail(28, hardware=True))
    top = mesh.position[(mesh.material == Material.BRONZE) & (mesh.normal[:, 2] > 0)]
    struck = top[np.abs(np.hypot(top[:, 0], top[:, 1]) - 0.6 * 0.254) < 1e-6]
    assert len(struck)
    assert np.abs(struck[:, 2]).max() < 1e-9


def test_nothing_of_the_hardware_is_under_the_floor() -> None:
    assert RIG.mesh.position[RIG.mesh.bone == WORLD][:, 2].min() > -0.02


def test_the_palette_holds_the_largest_kit() -> None:
    from station.motion.kit.kit import kit_names
    from station.render.figure.bones import BONES
    from station.render.gpu.light_shader import MAX_BONES

    for name in kit_names():
        rig = rig_of(kit := load_kit(name), kit_mesh(kit, Detail(12, hardware=False)))
        assert rig.bone_count + 2 * BONES + 2 * HELD_BONES <= MAX_BONES, (
            "the drummer, the student's double and his sticks"
        )
        assert floor_discs(load_kit(name))


def test_a_stick_is_a_5a() -> None:
    assert pytest.approx(0.406) == STICK_M


@pytest.mark.parametrize("detail", [*(quality.detail for quality in QUALITIES), Detail(28, hardware=False)])
def test_a_cymbal_is_whole_from_its_hole_to_its_rim(detail: Detail) -> None:
    """Its upper side's rings lie no farther apart than a fifth of its radius, and reach from the hole to the rim."""
    mesh = cymbal(0.254, detail)
    upper = mesh.normal[:, 2] > 0
    radii = np.unique(np.hypot(*mesh.position[upper, :2].T).round(4))
    assert radii[0] < 0.05 * 0.254 + 1e-3
    assert radii[-1] == pytest.approx(0.254, abs=1e-4)
    assert np.diff(radii).max() < 0.21 * 0.254

"""The model against the motion itself, read by a reader of its own: tips on drums at strokes, near it in between."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.motion.drummer import Drummer
from station.motion.kit.kit import load_kit
from station.motion.style.style import Style
from station.music.score import Score
from station.render.figure.skeleton import Skeleton, Stance, bone_frames, sole_of
from station.render.gpu.scene_cache import cached_body
from station.render.kit.kit_rig import KitRig, bone_matrices, kit_mesh, rig_of
from station.render.model.drummer_model import CELL, DETAIL, model_bytes
from tests.fakes.glb_reader import GlbReader
from tests.unit.motion.patterns import ROCK, score_of

Array = NDArray[np.float64]

SCORE = score_of((*ROCK, (14, Piece.CRASH_1), (15, Piece.FLOOR_TOM_1), (4, Piece.HIHAT_PEDAL)))
DRUMMER = Drummer(SCORE)
START_S, END_S = -0.5, 3.0
SIDES = {Limb.RIGHT_HAND: "right", Limb.LEFT_HAND: "left"}


def to_scene(point: Array) -> list[float]:
    """glTF: y up, and whoever looks along the station's y looks along −z turned round: x goes to the left."""
    x, y, z = point.tolist()
    return [-x, z, y]


@pytest.fixture(scope="module")
def model() -> GlbReader:
    return GlbReader(model_bytes(DRUMMER, START_S, END_S))


def tip(model: GlbReader, side: str, time_s: float) -> list[float]:
    """Where the end of a stick is in the scene: 40.6 cm from its butt, before it is stretched."""
    point: list[float] = (model.world(f"{side}_stick", time_s - START_S) @ [0, 0, 0.406, 1])[:3].tolist()
    return point


def test_every_stroke_of_a_hand_is_a_keyframe_with_the_tip_where_the_motion_has_it(model: GlbReader) -> None:
    limbs, checked = DRUMMER.assignment.limbs, 0
    for row, onset_s in enumerate(SCORE.onset_s.tolist()):
        side = SIDES.get(Limb(limbs[row]))
        if side is None or not START_S < onset_s < END_S:
            continue
        keys = model.times_of(f"{side}_stick")
        assert np.abs(keys - (onset_s - START_S)).min() < 1e-4
        wanted = DRUMMER.pose(onset_s).tip_m[0 if side == "right" else 1]
        assert tip(model, side, onset_s) == pytest.approx(to_scene(wanted), abs=5e-4)
        checked += 1
    assert checked > 10


def test_between_strokes_tips_and_joints_are_within_millimetres(model: GlbReader) -> None:
    for time_s in np.linspace(START_S, END_S, 97).tolist():
        pose = DRUMMER.pose(time_s)
        for k, side in enumerate(("right", "left")):
            away = np.array(tip(model, side, time_s)) - to_scene(pose.tip_m[k])
            assert np.linalg.norm(away) < 0.012  # a fall at 5 m/s passes that in 2 ms


def test_the_skin_is_where_the_pictures_have_it(model: GlbReader) -> None:
    """Arms and legs, whose corners hang on no bone of face or fingers, against the pictures' own matrices."""
    skin, skeleton = cached_body(DRUMMER.figure, CELL), Skeleton(DRUMMER.figure)
    onset_s = float(SCORE.onset_s[4])
    matrices = skeleton.matrices(DRUMMER.pose(onset_s))
    of_body = (skin.bones < 20).all(axis=1) & (skin.bones[:, 0] >= 4)
    pulled = np.einsum("vk,vkij->vij", skin.weights[of_body], matrices[skin.bones[of_body]])
    wanted = np.einsum("vij,vj->vi", pulled[:, :3, :3], skin.position[of_body]) + pulled[:, :3, 3]
    found = np.concatenate(model.skinned("figure", onset_s - START_S))
    for point in wanted[:: len(wanted) // 60]:
        assert np.linalg.norm(found - to_scene(point), axis=1).min() < 0.006


def test_every_corner_hangs_wholly_on_bones_each_named_once(model: GlbReader) -> None:
    document = model.document
    (figure,) = (node for node in document["nodes"] if node["name"] == "figure")
    for part in document["meshes"][figure["mesh"]]["primitives"]:
        weights, joints = (model.array(part["attributes"][name]) for name in ("WEIGHTS_0", "JOINTS_0"))
        assert (np.rint(weights * 255).sum(axis=1) == 255).all()
        assert joints.max() < len(document["skins"][figure["skin"]]["joints"])
        for row, pulls in zip(joints[::37].tolist(), weights[::37].tolist(), strict=True):
            used = [joint for joint, pull in zip(row, pulls, strict=True) if pull]
            assert len(used) == len(set(used))


def test_shapes_have_unit_normals_and_triangles_of_their_own_corners(model: GlbReader) -> None:
    for mesh in model.document["meshes"]:
        for part in mesh["primitives"]:
            normals = model.array(part["attributes"]["NORMAL"])
            assert np.linalg.norm(normals, axis=1) == pytest.approx(np.ones(len(normals)), abs=1e-3)
            assert model.array(part["indices"]).max() == len(normals) - 1


@pytest.mark.parametrize("piece", [Piece.CRASH_1, Piece.HIHAT])
def test_cymbals_swing_as_the_pictures_have_them(model: GlbReader, piece: Piece) -> None:
    rig = rig_of(DRUMMER.kit, kit_mesh(DRUMMER.kit, DETAIL))
    hung, name = rig.kit.pieces[piece], piece.name.lower()
    rim = hung.centre + hung.radius_m * hung.axes[0]
    rest = np.linalg.inv(model.world(name, 0.0)) @ [*to_scene(_moved(rig, 0, piece, rim)), 1]
    for time_s in (1.9, 2.2):
        wanted = _moved(rig, time_s - START_S, piece, rim)
        found = (model.world(name, time_s - START_S) @ rest)[:3]
        assert np.linalg.norm(found - to_scene(wanted)) < 0.004


def _moved(rig: KitRig, since_s: float, piece: Piece, point: Array) -> Array:
    matrix = bone_matrices(rig, DRUMMER.pose(START_S + since_s))[rig.piece_bones[piece]]
    return np.asarray((matrix @ [*point.tolist(), 1])[:3])


def test_frames_of_many_poses_are_those_of_each() -> None:
    times = np.linspace(0, 2, 7)
    pose = DRUMMER.pose(0.0)
    sole_m = sole_of(DRUMMER.figure)
    many = bone_frames(Stance.of_rows(DRUMMER.rows(times), pose.holds, sole_m))
    each = np.stack([bone_frames(Stance.of(DRUMMER.pose(float(t)), sole_m)) for t in times])
    assert many == pytest.approx(each, abs=1e-9)


def test_who_plays_nothing_sits_there() -> None:
    model = GlbReader(model_bytes(Drummer(Score.from_notes([], SCORE.tempo_map, SCORE.end_tick)), 0.0, 1.0))
    assert model.has("figure")
    assert model.has("snare")


@pytest.mark.parametrize(
    ("kit", "style"),
    [("left_handed_electronic", Style()), ("jazz", Style(held="brush")), ("large", Style(held="mallet"))],
)
def test_other_kits_and_what_else_hands_hold(kit: str, style: Style) -> None:
    drummer = Drummer(SCORE, load_kit(kit), style=style)
    model = GlbReader(model_bytes(drummer, 0.0, 1.0))
    names = {mesh["name"] for mesh in model.document["meshes"]}
    assert {"right_stick", "left_stick", "snare", "kick", "hihat", "beater", "figure"} <= names

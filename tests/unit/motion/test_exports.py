"""Exports against readers that know nothing of ours: a BVH reader and glTF checks written here after the formats."""

import json
import re
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.core.pieces import Articulation, Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.export.bvh import bvh_text, write_bvh
from station.motion.export.gltf import glb_bytes, write_glb
from station.motion.export.joint_tree import TURN
from station.motion.export.npz import motion_arrays, write_npz
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.kit.kit import load_kit
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from tests.unit.motion.patterns import ROCK, score_of

Array = NDArray[np.float64]

TIMES = np.arange(0.0, 3.0, 1 / 30)
SCORE = score_of((*ROCK, (14, Piece.CRASH_1), (15, Piece.FLOOR_TOM_1), (4, Piece.HIHAT_PEDAL)))
DRUMMER = Drummer(SCORE)


# --- npz --------------------------------------------------------------------------------------------------------------


def test_the_arrays_have_the_shapes_that_the_design_names() -> None:
    arrays = motion_arrays(DRUMMER, TIMES)
    n, m = len(TIMES), len(SCORE)
    assert arrays["angles_rad"].shape == (n, len(arrays["joint_names"]))
    assert arrays["joint_names"].tolist() == list(ANGLE_NAMES)
    assert arrays["tip_m"].shape == (n, 2, 3)
    for key in ("strike_time_s", "strike_piece", "strike_limb", "strike_radius_m"):
        assert arrays[key].shape == (m,)
    for key in ("strike_tip_m", "strike_centre_m", "strike_normal"):
        assert arrays[key].shape == (m, 3)


@pytest.mark.parametrize("kit", ["four_piece", "seven_piece", "left_handed"])
def test_what_touches_is_on_the_struck_surface_and_inside_it(kit: str) -> None:
    arrays = motion_arrays(Drummer(SCORE, load_kit(kit)), TIMES)
    away = arrays["strike_tip_m"] - arrays["strike_centre_m"]
    normal = arrays["strike_normal"]
    off = (away * normal).sum(1)
    assert np.abs(off).max() < 1e-4
    assert np.linalg.norm(normal, axis=1) == pytest.approx(np.ones(len(SCORE)))
    assert (np.linalg.norm(away - off[:, None] * normal, axis=1) <= arrays["strike_radius_m"]).all()


def test_strikes_are_in_order_and_named() -> None:
    arrays = motion_arrays(DRUMMER, TIMES)
    assert (np.diff(arrays["strike_time_s"]) >= 0).all()
    assert set(arrays["strike_piece"].tolist()) == {"kick", "snare", "hihat", "crash_1", "floor_tom_1"}
    assert set(arrays["strike_limb"].tolist()) <= {"right_hand", "left_hand", "right_foot", "left_foot"}


def test_an_npz_reads_back_without_pickle(tmp_path: Path) -> None:
    path = tmp_path / "x.npz"
    write_npz(DRUMMER, path, TIMES)
    with np.load(path, allow_pickle=False) as read:
        struck = SCORE.onset_s[(SCORE.onset_s >= TIMES[0]) & (SCORE.onset_s <= TIMES[-1])]
        assert set(read["time_s"].tolist()) == {*TIMES.tolist(), *struck.tolist()}
        assert str(read["schema"]).startswith("drum-station-motion/")


def test_a_pose_that_rounding_parts_from_a_strike_is_not_told_twice(tmp_path: Path) -> None:
    """Speeds taken between the poses of a file must be of the motion, not of the last bits of its times."""
    path = tmp_path / "x.npz"
    struck = SCORE.onset_s[2:5]
    write_npz(DRUMMER, path, np.sort(np.concatenate((TIMES[:1], struck - 1e-12, struck[:1] + 1e-12, TIMES[-1:]))))
    with np.load(path, allow_pickle=False) as read:
        assert np.diff(read["time_s"]).min() > 1e-6
        assert set(struck.tolist()) <= set(read["time_s"].tolist())


# --- BVH --------------------------------------------------------------------------------------------------------------


class Bvh:
    """A reader after the format's description: a tree of offsets, channels in order, rotations multiplied as listed."""

    def __init__(self, text: str) -> None:
        head, motion = text.split("MOTION")
        self.words: Iterator[str] = iter(head.split())
        self.joints: list[tuple[str, int, Array, list[str]]] = []  # name, parent, offset, channels
        self.ends: dict[str, Array] = {}
        assert next(self.words) == "HIERARCHY"
        assert next(self.words) == "ROOT"
        self._joint(-1)
        lines = motion.strip().splitlines()
        self.frames = int(lines[0].split(":")[1])
        self.step_s = float(lines[1].split(":")[1])
        self.table = np.array([[float(v) for v in line.split()] for line in lines[2:]])

    def _joint(self, parent: int) -> None:
        name = next(self.words)
        assert next(self.words) == "{"
        assert next(self.words) == "OFFSET"
        offset = np.array([float(next(self.words)) for _ in range(3)])
        assert next(self.words) == "CHANNELS"
        channels = [next(self.words) for _ in range(int(next(self.words)))]
        index = len(self.joints)
        self.joints.append((name, parent, offset, channels))
        while (word := next(self.words)) != "}":
            if word == "JOINT":
                self._joint(index)
            else:
                assert [word, next(self.words), next(self.words), next(self.words)] == ["End", "Site", "{", "OFFSET"]
                self.ends[name] = np.array([float(next(self.words)) for _ in range(3)])
                assert next(self.words) == "}"

    def positions(self, row: int) -> dict[str, tuple[Array, Array]]:
        """Every joint's start and, where it ends the chain, its end, in metres."""
        values = iter(self.table[row].tolist())
        worlds: list[tuple[Array, Array]] = []
        found = {}
        for name, parent, offset, channels in self.joints:
            place, turn = offset.copy(), np.eye(3)
            for channel in channels:
                value = next(values)
                axis = "XYZ".index(channel[0])
                if channel.endswith("position"):
                    place[axis] = value
                else:
                    turn = turn @ about(axis, np.radians(value))
            if parent >= 0:
                at, turned = worlds[parent]
                place, turn = at + turned @ place, turned @ turn
            worlds.append((place, turn))
            found[name] = (place / 100, (place + turn @ self.ends.get(name, np.zeros(3))) / 100)
        return found


def about(axis: int, angle: float) -> Array:
    turn = np.eye(3)
    a, b = (axis + 1) % 3, (axis + 2) % 3
    turn[a, a] = turn[b, b] = np.cos(angle)
    turn[b, a], turn[a, b] = np.sin(angle), -np.sin(angle)
    return turn


def test_a_bvh_reader_finds_every_joint_where_the_pose_has_it() -> None:
    drummer = Drummer(SCORE, style=Style(heel="up", amplitude_back=90, shrug=90))
    read = Bvh(bvh_text(drummer, TIMES))
    assert read.frames == len(TIMES)
    assert read.step_s == pytest.approx(1 / 30)
    starts = {
        "neck": Joint.NECK,
        "right_upper_arm": Joint.RIGHT_SHOULDER,
        "right_forearm": Joint.RIGHT_ELBOW,
        "left_hand": Joint.LEFT_WRIST,
        "right_foot": Joint.RIGHT_ANKLE,
        "left_shank": Joint.LEFT_KNEE,
    }
    for row in (0, 17, 60):
        pose = drummer.pose(float(TIMES[row]))
        found = read.positions(row)
        for name, joint in starts.items():
            assert found[name][0] == pytest.approx(TURN @ pose.joints_m[joint], abs=2e-3), name
        for side, name in enumerate(("right_stick", "left_stick")):
            assert found[name][1] == pytest.approx(TURN @ pose.tip_m[side], abs=3e-3), name


def test_angles_do_not_jump_between_frames() -> None:
    table = Bvh(bvh_text(DRUMMER, np.arange(0.0, 2.0, 1 / 240))).table
    assert np.abs(np.diff(table, axis=0)).max() < 40  # degrees in 4 ms; the whip's stick makes 1900° a second


# --- glTF -------------------------------------------------------------------------------------------------------------


def chunks(data: bytes) -> tuple[dict[str, Any], bytes]:
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    json_length, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON"
    text = data[20 : 20 + json_length]
    binary_length, kind = struct.unpack_from("<I4s", data, 20 + json_length)
    assert kind == b"BIN\0"
    binary = data[28 + json_length :]
    assert len(binary) == binary_length
    return json.loads(text), binary


def accessor(document: dict[str, Any], binary: bytes, index: int) -> NDArray[Any]:
    entry = document["accessors"][index]
    view = document["bufferViews"][entry["bufferView"]]
    kind = np.dtype({5126: "<f4", 5123: "<u2"}[entry["componentType"]])
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[entry["type"]]
    start = view["byteOffset"]
    assert start % 4 == 0
    values: NDArray[Any] = np.frombuffer(binary, kind, entry["count"] * width, start)
    return values.reshape(-1, width)


def test_a_glb_is_sound_from_its_header_to_its_last_triangle() -> None:
    document, binary = chunks(glb_bytes(DRUMMER, TIMES))
    for mesh in document["meshes"]:
        for primitive in mesh["primitives"]:
            points = accessor(document, binary, primitive["attributes"]["POSITION"])
            normals = accessor(document, binary, primitive["attributes"]["NORMAL"])
            indices = accessor(document, binary, primitive["indices"])
            assert indices.max() < len(points) == len(normals)
            assert np.linalg.norm(normals.astype(float), axis=1) == pytest.approx(1.0, abs=1e-5)
            entry = document["accessors"][primitive["attributes"]["POSITION"]]
            assert points.min(axis=0).tolist() == pytest.approx(entry["min"])


def test_the_animated_tips_are_where_the_poses_have_them() -> None:
    document, binary = chunks(glb_bytes(DRUMMER, TIMES))
    names = [str(node["name"]) for node in document["nodes"]]
    animation = document["animations"][0]
    tracks: dict[tuple[str, str], NDArray[Any]] = {}
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        target = channel["target"]
        tracks[names[target["node"]], target["path"]] = accessor(document, binary, sampler["output"])
        assert accessor(document, binary, sampler["input"])[:, 0] == pytest.approx(TIMES, abs=1e-6)
    for row in (0, 20, 55):
        x, y, z, w = tracks["right_stick", "rotation"][row].astype(float).tolist()
        forward = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
        tip = tracks["right_stick", "translation"][row] + 0.406 * forward
        pose = DRUMMER.pose(float(TIMES[row]))
        assert tip == pytest.approx(TURN @ pose.tip_m[0], abs=1e-3)
    for (_, path), values in tracks.items():
        if path == "rotation":
            assert np.linalg.norm(values.astype(float), axis=1) == pytest.approx(1.0, abs=1e-5)


def test_struck_cymbals_swing_in_the_file() -> None:
    document, _ = chunks(glb_bytes(DRUMMER, TIMES))
    names = [str(node["name"]) for node in document["nodes"]]
    moved = {names[c["target"]["node"]] for c in document["animations"][0]["channels"]}
    assert "crash_1" in moved
    assert "ride" not in moved  # it is never struck here


def test_a_disk_that_refuses_leaves_nothing(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for write, ending in ((write_npz, "npz"), (write_bvh, "bvh"), (write_glb, "glb")):
        with pytest.raises(DeviceError):
            write(DRUMMER, tmp_path / "file" / f"x.{ending}", TIMES[:3])


def test_a_toss_takes_the_stick_out_of_the_hand_in_every_format() -> None:
    notes = [Note(0, Piece.SNARE, limb=Limb.RIGHT_HAND), Note(24 * PPQ, Piece.SNARE, limb=Limb.RIGHT_HAND)]
    score = Score.from_notes(notes, TempoMap.constant(120))
    for seed in range(12):
        drummer = Drummer(score, style=Style(flourish=100, seed=seed))
        at = np.arange(0.0, 4.0, 1 / 60)
        rows = motion_arrays(drummer, at)
        gap = np.linalg.norm(rows["butt_m"][:, 0] - rows["points_m"][:, Joint.RIGHT_HAND], axis=1)
        if gap.max() > 0.4:
            break
    else:
        pytest.fail("no seed of twelve tosses a stick")
    found = Bvh(bvh_text(drummer, at))
    row = int(gap.argmax())
    assert found.positions(row)["right_stick"][0] == pytest.approx(TURN @ rows["butt_m"][row, 0], abs=2e-3)
    assert re.search("JOINT right_stick", bvh_text(drummer, at))


def test_rim_and_edge_are_struck_by_the_shaft() -> None:
    notes = [
        Note(0, Piece.RIDE, Zone.BELL, 90, limb=Limb.RIGHT_HAND),
        Note(2 * PPQ, Piece.CRASH_1, Zone.EDGE, 120, limb=Limb.LEFT_HAND),
        Note(4 * PPQ, Piece.SNARE, Zone.RIM, 90, Articulation.CROSS_STICK, limb=Limb.LEFT_HAND),
    ]
    arrays = motion_arrays(Drummer(Score.from_notes(notes, TempoMap.constant(100))), TIMES)
    away = arrays["strike_tip_m"] - arrays["strike_centre_m"]
    assert np.abs((away * arrays["strike_normal"]).sum(1)).max() < 1e-4

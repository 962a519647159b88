from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.render.figure.body import build_body
from station.render.geometry.light import Light
from station.render.gpu import scene_cache as module
from station.render.gpu.scene_cache import Arrays, cached, cached_body, cached_kit, cached_light, cached_wall
from station.render.kit.instrument_meshes import Detail
from station.render.kit.kit_rig import floor_discs, kit_mesh, rig_of
from station.render.kit.room import floor_light, wall_picture

COARSE = Detail(8, hardware=False)
MADE = {"a": np.arange(1000.0), "b": np.array([[1, 2], [3, 4]], np.uint8)}


def make() -> Arrays:
    return MADE


def refuse() -> Arrays:
    raise AssertionError("made anew")


def assert_same(one: Arrays, other: Arrays) -> None:
    assert set(one) == set(other)
    for name, array in one.items():
        assert array.dtype == other[name].dtype
        assert np.array_equal(array, other[name])


def only_file(folder: Path) -> Path:
    (file,) = folder.iterdir()
    return file


def test_what_was_made_once_is_read_from_disk(tmp_path: Path) -> None:
    assert cached("solid", (1, "b"), make, tmp_path) is MADE
    assert_same(cached("solid", (1, "b"), refuse, tmp_path), MADE)


def test_another_wish_is_another_file(tmp_path: Path) -> None:
    kit = load_kit()
    wishes = [(kit, COARSE), (kit.mirrored, COARSE), (replace(kit, seat_m=(0.0, 0.0, 0.51)), COARSE), (kit, None)]
    for wanted in wishes:
        cached("solid", wanted, make, tmp_path)
    assert len(list(tmp_path.iterdir())) == len(wishes)


def test_an_object_that_says_only_where_it_lies_is_refused(tmp_path: Path) -> None:
    with pytest.raises(AssertionError, match="address"):
        cached("solid", object(), make, tmp_path)


@pytest.mark.parametrize("damage", ["cut", "flipped", "empty", "foreign"])
def test_a_damaged_file_is_made_anew(tmp_path: Path, damage: str) -> None:
    cached("solid", 1, make, tmp_path)
    file = only_file(tmp_path)
    whole = file.read_bytes()
    data = bytearray(whole)
    if damage == "cut":
        del data[len(data) // 2 :]
    elif damage == "flipped":
        data[len(data) // 3] ^= 0x40
    else:
        data = bytearray() if damage == "empty" else bytearray(b"PK\x03\x04 something else")
    file.write_bytes(data)
    assert_same(cached("solid", 1, make, tmp_path), MADE)
    assert file.read_bytes() == whole


def test_damage_where_no_part_has_a_checksum_is_found_too(tmp_path: Path) -> None:
    """A zip's table of contents stands at its end: methods, flags, names and sizes."""
    cached("solid", 1, make, tmp_path)
    file = only_file(tmp_path)
    whole = file.read_bytes()
    for from_end in range(1, 200, 7):
        data = bytearray(whole)
        data[-from_end] ^= 0x41
        file.write_bytes(data)
        assert_same(cached("solid", 1, make, tmp_path), MADE)
        assert file.read_bytes() == whole


def test_a_folder_that_cannot_be_written_costs_time_alone(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")
    assert_same(cached("solid", 1, make, tmp_path / "file" / "folder"), MADE)


def test_only_the_latest_files_are_kept(tmp_path: Path) -> None:
    (tmp_path / "else.txt").write_bytes(b"not ours")
    for wanted in range(module.CACHED_FILES + 3):
        cached("solid", wanted, make, tmp_path)
    assert len(list(tmp_path.glob("*.scene"))) == module.CACHED_FILES
    assert (tmp_path / "else.txt").exists()


def test_kits_bodies_and_pictures_come_back_as_they_were_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "cache_folder", lambda _: tmp_path)
    kit, figure, light = load_kit(), figure_of(), Light()
    rig, skin = rig_of(kit, kit_mesh(kit, COARSE)), build_body(figure, 4.0)
    falls, wall = floor_light(floor_discs(kit), light), wall_picture()
    for _ in range(2):  # made, and read
        again, body = cached_kit(kit, COARSE), cached_body(figure, 4.0)
        for one, other in ((rig.mesh, again.mesh), (skin, body)):
            for field in fields(one):
                assert np.array_equal(getattr(one, field.name), getattr(other, field.name)), field.name
        assert (again.faces_of, again.still_faces, again.sticks) == (rig.faces_of, rig.still_faces, rig.sticks)
        assert np.array_equal(cached_light(floor_discs(kit), light), falls)
        assert np.array_equal(cached_wall(), wall)
    assert len(list(tmp_path.iterdir())) == 4

from pathlib import Path

import numpy as np
import pytest

from station.sound.drum_kit import DrumKit
from station.sound.samples.load_kit import load_kit
from station.sound.synth import synth_cache, synth_kits
from station.sound.synth.synth_cache import cached_kit, is_made

RATE_HZ = 44_100
MODEL = "electronic"  # the smallest


def files(folder: Path) -> list[Path]:
    return sorted(folder.iterdir())


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, DrumKit]:
    folder = tmp_path_factory.mktemp("kits")
    return folder, cached_kit(MODEL, RATE_HZ, folder)


def copy_of(made: tuple[Path, DrumKit], folder: Path) -> Path:
    (source,) = files(made[0])
    target = folder / source.name
    target.write_bytes(source.read_bytes())
    return target


def assert_same(one: DrumKit, other: DrumKit) -> None:
    assert (one.name, one.rate_hz, set(one.sounds)) == (other.name, other.rate_hz, set(other.sounds))
    for name, sound in one.sounds.items():
        for mine, its in zip(sound.layers, other.sounds[name].layers, strict=True):
            assert mine.to_velocity == its.to_velocity
            assert all(np.array_equal(a, b) for a, b in zip(mine.takes, its.takes, strict=True))


def no_making(*_: object) -> DrumKit:
    raise AssertionError("the kit is made again")


def test_a_kit_from_disk_is_the_kit_that_was_made(
    made: tuple[Path, DrumKit], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    copy_of(made, tmp_path)
    monkeypatch.setattr(synth_kits.synth_kit, "__wrapped__", no_making)
    assert_same(cached_kit(MODEL, RATE_HZ, tmp_path), made[1])


@pytest.mark.parametrize("damage", ["cut", "flipped", "empty", "foreign"])
def test_a_damaged_file_is_made_anew(made: tuple[Path, DrumKit], tmp_path: Path, damage: str) -> None:
    path = copy_of(made, tmp_path)
    data = bytearray(path.read_bytes())
    if damage == "cut":
        del data[len(data) // 2 :]
    elif damage == "flipped":
        data[len(data) // 2] ^= 0x40
    else:
        data = bytearray() if damage == "empty" else bytearray(b"PK\x03\x04 something else")
    path.write_bytes(data)
    assert_same(cached_kit(MODEL, RATE_HZ, tmp_path), made[1])
    assert path.stat().st_size == files(made[0])[0].stat().st_size


def test_a_kit_from_disk_is_mapped_and_not_copied(made: tuple[Path, DrumKit], tmp_path: Path) -> None:
    """So a spare engine with the same kit costs no memory; and nobody can write into what others play."""
    copy_of(made, tmp_path)
    takes = [take for sound in cached_kit(MODEL, RATE_HZ, tmp_path).sounds.values() for take in sound.layers[0].takes]
    assert not any(take.flags.owndata or take.flags.writeable for take in takes)
    assert all(type(take) is np.ndarray for take in takes), "a memmap's own class costs microseconds a block"


def test_a_folder_that_cannot_be_written_costs_time_alone(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")
    assert cached_kit(MODEL, RATE_HZ, tmp_path / "file" / "folder").name == MODEL


def test_only_the_latest_files_are_kept(
    made: tuple[Path, DrumKit], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for index in range(6):
        (tmp_path / f"old-{index}.kit").write_bytes(b"old")
    (tmp_path / "else.txt").write_bytes(b"not ours")
    monkeypatch.setattr(synth_kits.synth_kit, "__wrapped__", lambda *_: made[1])
    cached_kit(MODEL, RATE_HZ, tmp_path)
    kept = [path.name for path in files(tmp_path)]
    assert len(kept) == synth_cache.CACHED_FILES + 1
    assert "else.txt" in kept
    assert any(name.startswith(MODEL) for name in kept)


def test_another_rate_or_recipe_is_another_file(tmp_path: Path, made: tuple[Path, DrumKit]) -> None:
    (name,) = (path.name for path in files(made[0]))
    assert f"{MODEL}-{RATE_HZ}-" in name
    assert synth_cache._digest("acoustic") != synth_cache._digest(MODEL)


def test_synthesised_kits_are_loaded_by_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(synth_cache, "cache_folder", lambda _: tmp_path)
    assert load_kit(MODEL, RATE_HZ).name == MODEL
    assert len(files(tmp_path)) == 1


def test_whether_a_kit_was_made_is_known_before_it_is_asked_for(made: tuple[Path, DrumKit], tmp_path: Path) -> None:
    assert is_made(MODEL, RATE_HZ, made[0])
    assert not is_made(MODEL, RATE_HZ, tmp_path)
    assert not is_made(MODEL, 96_000, made[0])

"""The rows of a folder of lessons, and the file that keeps them."""

import os
from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.drills import lesson_row
from station.drills.lesson import Lesson
from station.drills.lesson_row import rows_below
from station.drills.reading.lesson_file import read_lesson
from station.drills.writing.authoring import NEW_LESSON
from station.scoring.matching.hit_windows import Level


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(lesson_row, "cache_folder", lambda kind: tmp_path / "cache" / kind)
    return tmp_path / "cache" / "lessons"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "top" / "grooves").mkdir(parents=True)
    for name in ("a", "b"):
        (tmp_path / "top" / "grooves" / f"{name}.toml").write_text(NEW_LESSON)
    return tmp_path / "top"


def titles(folder: Path) -> list[str]:
    files = {path: path.parent.name for path in sorted(folder.rglob("*.toml"))}
    return [f"{row.folder}/{row.name}: {row.title}" for row in rows_below(folder, files)]


def test_a_row_says_what_the_lesson_says(cache: Path, folder: Path) -> None:
    """As `NEW_LESSON` has it: two bars of 4/4 at 80, 8 passes, beginners at first."""
    row = rows_below(folder, {folder / "grooves" / "a.toml": "grooves"})[0]
    assert (row.name, row.title, row.level, row.folder) == ("a", "My groove", 1, "grooves")
    assert (row.tempo_bpm, row.beats_a_minute, row.meter, row.bars, row.loop_bars, row.passes) == (
        80,
        80,
        "4/4",
        2,
        2,
        8,
    )
    assert (row.tags, row.about) == (("rock", "groove"), "What to listen for, in a sentence or two.")
    assert (row.suggested, row.strictest) == (Level.BEGINNER, Level.STUDIO)


def test_what_has_not_changed_is_not_read_again(cache: Path, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    said = titles(folder)
    read: list[Path] = []

    def counted(path: Path) -> Lesson:
        read.append(path)
        return read_lesson(path)

    monkeypatch.setattr(lesson_row, "read_lesson", counted)
    assert titles(folder) == said == ["grooves/a: My groove", "grooves/b: My groove"]
    assert read == []
    changed = folder / "grooves" / "b.toml"
    changed.write_text(NEW_LESSON.replace("My groove", "Her groove"))
    assert titles(folder) == ["grooves/a: My groove", "grooves/b: Her groove"]
    assert read == [changed]


def test_a_change_of_the_same_length_is_seen(cache: Path, folder: Path) -> None:
    titles(folder)
    changed = folder / "grooves" / "a.toml"
    changed.write_text(NEW_LESSON.replace("My groove", "Om groove"))
    os.utime(changed, ns=(1, 1))
    assert titles(folder)[0] == "grooves/a: Om groove"


def test_lessons_come_and_go(cache: Path, folder: Path) -> None:
    titles(folder)
    (folder / "grooves" / "b.toml").rename(folder / "grooves" / "c.toml")
    assert titles(folder) == ["grooves/a: My groove", "grooves/c: My groove"]


@pytest.mark.parametrize(
    "damage", [b"", b"[]", b'{"grooves/a.toml": 3}', b"\xff", b'{"grooves/a.toml": {"stamp": [1]}}']
)
def test_a_damaged_file_is_made_anew(cache: Path, folder: Path, damage: bytes) -> None:
    said = titles(folder)
    (kept,) = cache.glob("*.json")
    whole = kept.read_bytes()
    kept.write_bytes(damage)
    assert titles(folder) == said
    assert kept.read_bytes() == whole


def test_without_a_place_for_the_file_all_is_read(cache: Path, folder: Path) -> None:
    cache.parent.mkdir(exist_ok=True)
    cache.write_text("a file where a folder should be")
    assert len(titles(folder)) == 2


def test_a_lesson_with_a_fault_is_named(cache: Path, folder: Path) -> None:
    (folder / "grooves" / "b.toml").write_text("title = 3")
    with pytest.raises(BadInput, match=r"b\.toml"):
        titles(folder)

"""Finding lessons by name or path, and the list of them."""

import shutil
from pathlib import Path

import pytest

import station
from station.core.errors import BadInput
from station.drills.library import FIRST_LESSON, find_lesson, lesson_names, lesson_rows, lessons_dir, read_lesson


def test_names_are_unique_and_sorted() -> None:
    files = [path for path in lessons_dir().rglob("*.toml") if path.parent.name != "courses"]
    assert lesson_names() == sorted(f.stem for f in files)
    assert len(set(lesson_names())) == len(files)


def test_the_first_lesson_ships() -> None:
    assert find_lesson(FIRST_LESSON).level == 1


def test_by_path(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    shutil.copy(lessons_dir() / "grooves" / "rock-1.toml", path)
    assert find_lesson(str(path)).name == "mine"
    other = tmp_path / "mine.txt"
    path.rename(other)
    assert find_lesson(str(other)).name == "mine"


def test_a_name_goes_before_a_file_of_the_working_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rock-1").write_text("no lesson")
    assert find_lesson("rock-1").title.startswith("Rock 1")


@pytest.mark.parametrize(
    ("word", "words"),
    [
        ("rok-1", "no such lesson; the nearest are rock-1"),
        ("Rock 1", "rock-1"),
        ("paradidle", "single-paradiddle|paradiddle"),
        ("bossa", "bossa-1"),
        ("zzzzzz", "`station lesson list` shows all"),
        ("", "no such lesson"),
        ("none.toml", "none.toml: no such file"),
        ("rock-1.mid", "rock-1.mid: no such file"),
        ("grooves/rock-1", "grooves/rock-1: no such file"),
        ("a\x00b", "no such lesson"),
    ],
)
def test_an_unknown_name_names_the_nearest(word: str, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        find_lesson(word)


def test_the_list_has_kinds_levels_and_facts() -> None:
    rows = {row.name: row for row in lesson_rows()}
    assert set(rows) == set(lesson_names())
    jazz = rows["jazz-waltz-1"]
    assert (jazz.folder, jazz.level, jazz.beats_a_minute, jazz.meter, jazz.bars) == ("grooves", 3, 120, "3/4", 4)
    assert rows["double-paradiddle"].beats_a_minute == 60  # dotted quarters
    kinds = [row.folder for row in lesson_rows()]
    drills = ["rudiments", "rolls", "orchestrated", "hands", "independence", "polyrhythms", "reading", "trading"]
    assert kinds == sorted(kinds, key=["grooves", "fills", *drills].index)


def test_in_a_wheel_the_lessons_lie_inside_the_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "site-packages" / "station"
    package.mkdir(parents=True)
    monkeypatch.setattr(station, "__file__", str(package / "__init__.py"))
    lessons_dir.cache_clear()
    try:
        assert lessons_dir() == package / "shipped" / "lessons"
        (tmp_path / "site-packages" / "pyproject.toml").touch()
        lessons_dir.cache_clear()
        assert lessons_dir() == tmp_path / "site-packages" / "lessons"
    finally:
        lessons_dir.cache_clear()


def test_a_shipped_lesson_reads_by_its_own_path() -> None:
    assert read_lesson(lessons_dir() / "fills" / "stops-1.toml").name == "stops-1"

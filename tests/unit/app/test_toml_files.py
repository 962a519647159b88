"""Files of every kind: which one each is, and that all of them are read alike, whatever is wrong with them."""

import os
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from station.app.toml_files import KINDS, check_files, kind_of
from station.cli.command_line import main
from station.core.errors import BadInput
from station.core.toml.toml_source import MAX_FILE_BYTES, read_source, text_source
from station.drills.library import lessons_dir
from station.drills.writing.authoring import NEW_LESSON
from tests.toml_kinds import GOOD, Good, read_as


def put(folder: Path, kind: str, text: str | bytes) -> Path:
    """A file of that kind, named as such files are."""
    path = folder / {"course": "c.course.toml", "settings": "settings.toml"}.get(kind, "mine.toml")
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_there_is_an_example_of_every_kind() -> None:
    assert set(GOOD) == {kind.name for kind in KINDS}


@pytest.mark.parametrize("kind", GOOD)
def test_a_file_tells_its_kind(kind: str, tmp_path: Path) -> None:
    path = put(tmp_path, kind, GOOD[kind].text)
    assert kind_of(path, read_source(path)).name == kind
    assert check_files([str(path)]) == ([], 1)
    read_as(kind, path)


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("settings.toml", "settings"),
        ("calibration.toml", "calibration"),
        ("styles/latest.toml", "style"),
        ("kits/TD-17.toml", "device kit"),
        ("x.toml", "lesson"),
    ],
)
def test_where_no_key_tells_the_name_does(name: str, kind: str) -> None:
    assert kind_of(Path("home", name), text_source("", name)).name == kind


WHAT = r"line \d+, column \d+: "

BAD: dict[str, tuple[Callable[[Good], str | bytes], str]] = {
    "a wrong type": (lambda good: good.with_number('"x"'), r"expected a (whole )?number from .*, found \"x\""),
    "a truth": (lambda good: good.with_number("true"), r"expected a (whole )?number from .*, found true"),
    "out of range": (lambda good: good.with_number("-123456"), r"expected a (whole )?number from .*, found -123456"),
    "not a number": (lambda good: good.with_number("nan"), r"expected a (whole )?number from .*, found nan"),
    "infinite": (lambda good: good.with_number("inf"), r"expected a (whole )?number from .*, found inf"),
    "200 digits": (lambda good: good.with_number("9" * 200), r"expected a (whole )?number from .*, found 9{20}…9{20}"),
    "5,000 digits": (lambda good: good.with_number("9" * 5000), "a number of 5000 digits"),
    "a table for a number": (
        lambda good: good.with_number("{ a = 1 }"),
        r"expected a (whole )?number .*, found a table",
    ),
    "a list for a number": (lambda good: good.with_number("[1]"), r"expected a (whole )?number .*, found a list"),
    "an unknown key": (
        lambda good: f"colour = 1\n{good.text}",
        r"no such [\w ]+: colour; (did you mean|the nearest are|there are) ",
    ),
    "a duplicate key": (
        lambda good: good.text.replace(good.line, f"{good.line}\n{good.line}"),
        "this key was given before",
    ),
    "no value": (lambda good: good.with_number(""), "expected a value"),
    "not closed": (lambda good: good.with_number('"x'), "a text in quotes is not closed"),
    "not UTF-8": (lambda good: f"{good.text}\n# ".encode() + b"\xff", "not UTF-8 text"),
    "nested too deeply": (lambda good: good.with_number("[" * 5000), "nested too deeply"),
    "a key of many parts": (lambda good: f"{'a.' * 20_000}a = 1\n{good.text}", "a key of more than 100 parts"),
}


@pytest.mark.parametrize("what", BAD)
@pytest.mark.parametrize("kind", GOOD)
def test_whatever_is_wrong_is_told_alike_for_every_kind(kind: str, what: str, tmp_path: Path) -> None:
    """By `check`, and in one line by whoever reads the file."""
    spoil, words = BAD[what]
    path = put(tmp_path, kind, spoil(GOOD[kind]))
    found, _ = check_files([str(path)])
    assert re.search(f"^{re.escape(str(path))}: {WHAT}.*(?:{words})", str(found[0]))
    assert len(str(found[0])) < 400
    with pytest.raises(BadInput) as raised:
        read_as(kind, path)
    more = len(found) - 1
    assert str(raised.value) == str(found[0]) + (
        f" (and {more} more: `station lesson check {path}` lists them)" if more else ""
    )


@pytest.mark.parametrize("kind", [kind for kind in GOOD if GOOD[kind].needs])
def test_a_missing_key_is_told(kind: str, tmp_path: Path) -> None:
    key = GOOD[kind].needs
    path = put(tmp_path, kind, "\n".join(line for line in GOOD[kind].text.splitlines() if not line.startswith(key)))
    assert any(re.search(f"{WHAT}.*{key} is missing", str(fault)) for fault in check_files([str(path)])[0])


def fifo(path: Path) -> Path:
    os.mkfifo(path)
    return path


def loop(path: Path) -> Path:
    path.symlink_to(path)
    return path


def endless(path: Path) -> Path:
    path.symlink_to("/dev/zero")
    return path


def folder(path: Path) -> Path:
    path.mkdir()
    return path


def large(path: Path) -> Path:
    path.write_bytes(b"#" * (MAX_FILE_BYTES + 1))
    return path


NO_FILES: dict[str, tuple[Callable[[Path], Path], str]] = {
    "a pipe": (fifo, "cannot be read: not a regular file"),
    "an endless device": (endless, "cannot be read: not a regular file"),
    "a link to itself": (loop, "cannot be read: Too many levels of symbolic links"),
    "a folder": (folder, "cannot be read: Is a directory"),
    "too large": (large, "longer than 1000000 bytes"),
}


@pytest.mark.skipif(os.name != "posix", reason="such files are POSIX's")
@pytest.mark.parametrize("what", NO_FILES)
@pytest.mark.parametrize("kind", GOOD)
def test_what_is_no_file_to_read_is_told_alike(kind: str, what: str, tmp_path: Path) -> None:
    make, words = NO_FILES[what]
    path = make(tmp_path / "odd.toml")
    with pytest.raises(BadInput) as raised:
        read_as(kind, path)
    assert str(raised.value) == f"{path}: {words}"
    if not path.is_dir():
        assert [str(fault) for fault in check_files([str(path)])[0]] == [str(raised.value)]


def test_check_lists_what_a_command_tells_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = put(tmp_path, "settings", 'kti = 1\nrate_hz = "fast"\n')
    assert main(["lesson", "check", str(path)]) == 2
    out, err = capsys.readouterr()
    assert out.splitlines() == [
        f"{path}: line 1, column 1: no such setting: kti; did you mean kit?",
        f'{path}: line 2, column 11: rate_hz: expected a whole number from 8000 to 384000, found "fast"',
    ]
    assert err == "1 file: 2 faults\n"


# --- lessons and courses ----------------------------------------------------------------------------------------------


def test_all_that_ships_is_sound() -> None:
    faults, count = check_files([str(lessons_dir()), "station/motion/data"])
    assert faults == []
    assert count >= 24


def test_every_fault_of_every_file(tmp_path: Path) -> None:
    good, bad, broken = tmp_path / "good.toml", tmp_path / "bad.toml", tmp_path / "broken.toml"
    good.write_text(NEW_LESSON)
    bad.write_text('title = "T"\nlevel = 9\n[grid]\nsnare = "oq"\n')
    broken.write_bytes(b"title = 'T'\n\xff")
    faults, count = check_files([str(tmp_path), str(tmp_path / "none.toml")])
    assert count == 4
    assert [str(f).removeprefix(str(tmp_path) + "/").split(": ")[:2] for f in faults] == [
        ["bad.toml", "line 2, column 9"],
        ["bad.toml", "line 4, column 11"],
        ["broken.toml", "line 2, column 1"],
        ["none.toml", "no such file"],
    ]


def test_a_folder_without_files(tmp_path: Path) -> None:
    faults, count = check_files([str(tmp_path)])
    assert count == 0
    assert "no lesson in this folder" in faults[0].text


COURSE = 'title = "T"\n{}lessons = ["rock-1"]\n'


def test_courses_that_come_before_are_looked_for_beside_the_file_and_among_those_that_ship(tmp_path: Path) -> None:
    for name, before in (("one", "first-beats"), ("two", "one"), ("three", "tow"), ("four", "first-baets")):
        line = f'prerequisites = ["{before}"]\n'
        (tmp_path / f"{name}.course.toml").write_text(COURSE.format(line))
    faults, count = check_files([str(tmp_path)])
    assert count == 4
    assert [(Path(one.source).name, one.line, one.column) for one in faults] == [
        ("four.course.toml", 2, 18),
        ("three.course.toml", 2, 18),
    ]
    assert faults[0].text == "prerequisites: no such course: first-baets; did you mean first-beats?"
    assert faults[1].text == "prerequisites: no such course: tow; did you mean two?"


def test_courses_in_a_circle_are_told_once(tmp_path: Path) -> None:
    for name, before in (("a", "b"), ("b", "a")):
        (tmp_path / f"{name}.course.toml").write_text(COURSE.format(f'prerequisites = ["{before}"]\n'))
    ((fault,), _) = check_files([str(tmp_path)])
    assert str(fault) == f"{tmp_path / 'a.course.toml'}: line 2, column 18: prerequisites: a circle: a needs b needs a"

"""Files of our own that something else stands in the place of: a pipe, a folder, gigabytes, nesting without end."""

import os
from collections.abc import Callable
from datetime import date
from pathlib import Path

import pytest

from station.core.errors import BadInput, DeviceError
from station.drills.exam.exam_piece import Unseen
from station.practice.book.book_day import BookFolder
from station.practice.book.practised import practised_on
from station.practice.exam.exam_record import was_seen
from station.practice.history.kept_json import kept_document, recalled
from station.practice.history.session_files import DOCUMENT_NAME
from station.practice.own_data.catching_up import catch_up
from station.practice.records.assigned_lessons import all_taken
from station.practice.records.memory import remembered
from tests.fakes.known_students import one_student

DAY = date(2026, 11, 23)


def _huge(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(1 << 36)


def _text(text: str) -> Callable[[Path], object]:
    return lambda path: path.write_text(text, encoding="utf-8")


HOSTILE: dict[str, Callable[[Path], object]] = {
    "pipe": os.mkfifo if hasattr(os, "mkfifo") else Path.mkdir,
    "folder": Path.mkdir,
    "huge": _huge,
    "nested": _text("[" * 100_000),
    "digits": _text('{"schema": ' + "9" * 5000 + "}"),
    "list": _text("[]"),
    "empty": _text(""),
    "link to itself": lambda path: path.symlink_to(path),
}


@pytest.fixture(params=HOSTILE)
def made(request: pytest.FixtureRequest) -> Callable[[Path], object]:
    def make(path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        HOSTILE[request.param](path)

    return make


def _object(document: object, source: str) -> dict[str, object]:
    if not isinstance(document, dict):
        raise BadInput(source, "", "is no table")
    return document


def test_what_cannot_be_read_is_set_aside_in_a_line(made: Callable[[Path], object], tmp_path: Path) -> None:
    path = tmp_path / "kept.json"
    made(path)
    try:
        kept, fault = recalled(path, _object, "it begins anew")
    except DeviceError as refused:  # a link that leads nowhere cannot be told from a disk that fails
        kept, fault = None, str(refused)
    assert kept is None
    assert fault is not None
    assert "\n" not in fault


def test_nothing_of_a_student_hangs_on_what_lies_in_its_place(made: Callable[[Path], object], tmp_path: Path) -> None:
    student = tmp_path / "Kim"
    made(student / "2026-11-23T10-00-00_a" / "exam.json")
    made(student / "2026-11-23T10-00-00_a" / DOCUMENT_NAME)
    made(student / "mastery" / "a.json")
    made(student / "assignments" / "a" / "taken.json")
    kim = one_student(tmp_path, "Kim")
    catch_up(kim.settings, list[str]().append)
    assert not was_seen(kim, Unseen(1, 1))
    assert practised_on(kim, [DAY]) == []
    assert remembered(kim) == []
    assert all_taken(tmp_path, "Kim") == {}


def test_a_day_of_the_book_that_is_a_pipe_begins_anew(tmp_path: Path) -> None:
    folder = BookFolder.of(tmp_path, "Kim")
    folder.path.mkdir(parents=True)
    HOSTILE["pipe"](folder.path / f"{DAY}.json")
    day, fault = folder.recall(DAY)
    assert day.items == ()
    assert fault is not None
    folder.keep(day)
    assert folder.recall(DAY) == (day, None)


def test_a_file_that_is_no_text_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.json").write_bytes(b"\xff\xfe{}")
    with pytest.raises(BadInput, match="is no JSON document"):
        kept_document(tmp_path / "x.json")

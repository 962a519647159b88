"""What a session's folder holds comes into the history, once, and damage in it harms nothing else."""

import csv
import hashlib
import json
import shutil
from collections.abc import Iterator
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import Any

import pytest

from station.core.errors import BadInput
from station.core.settings import Settings
from station.drills.library import find_lesson
from station.practice.headless.virtual_session import practise_virtually
from station.practice.history.session_files import student_folder
from station.practice.history.session_intake import everything_in, take_in
from station.practice.history.student_history import StudentHistory
from station.practice.records.report.session_report import practice_document
from station.practice.records.save_session import SessionFolder
from station.practice.session.plan import PlanOptions, plan_practice
from station.simulation.student_spec import parse_spec
from station.store.database import Database
from station.store.database_url import sqlite_url
from station.store.history import History
from station.store.rows import Part, SessionKind, SessionState

NAME = "2026-03-01T18-30-05_rock-1"
BEGAN = datetime(2026, 3, 1, 18, 30, 5)


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a session of two passes."""
    folder = tmp_path_factory.mktemp("played") / NAME
    folder.mkdir()
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(loops=2))
    virtual = practise_virtually(plan, parse_spec("seed=4,miss_pct=5,extra_pct=4"), folder / "session.capture")
    document = practice_document(virtual.result, replace(Settings(), student="Ann"))
    SessionFolder(folder, StudentHistory.of(Settings()), is_new=False).write(virtual.result, document)
    return folder


@pytest.fixture
def history(tmp_path: Path) -> Iterator[History]:
    """A history in which nothing is kept."""
    made = History(Database(sqlite_url(tmp_path / "history.sqlite3")))
    yield made
    made.database.close()


@pytest.fixture
def folder(played: Path, tmp_path: Path) -> Path:
    """A copy of that folder, among Ann's sessions."""
    return shutil.copytree(played, student_folder(tmp_path / "sessions", "Ann") / NAME)


def test_a_session_is_kept_with_all_that_its_folder_holds(folder: Path, history: History) -> None:
    number = take_in(history, "Ann", folder)
    report: dict[str, Any] = json.loads((folder / "report.json").read_text())
    [row] = history.sessions("Ann")
    assert (row.id, row.name, row.started, row.folder) == (number, NAME, BEGAN, str(folder))
    assert (row.lesson, row.title, row.complete) == ("rock-1", report["session"]["title"], True)
    assert (row.score, row.level, row.played_s) == (report["score"], report["level"], report["session"]["played_s"])
    asked = report["session"]
    assert [row.first_bar, row.last_bar] == asked["bars"]
    assert (row.click, row.gap) == (asked["click"], asked["gap"])
    assert (row.input_latency_ms, row.output_latency_ms) == (asked["input_latency_ms"], asked["output_latency_ms"])
    assert row.top_beats_a_minute == asked["beats_a_minute"]
    assert (row.notes, row.right, row.strokes) == (
        report["counts"]["notes"],
        report["right"],
        report["timing"]["strokes"],
    )
    assert (row.mean_ms, row.sd_ms) == (
        report["timing"]["mean_signed_asynchrony_ms"],
        report["timing"]["sd_asynchrony_ms"],
    )
    capture = (folder / "session.capture").read_bytes()
    assert row.capture_sha256 == hashlib.sha256(capture).hexdigest()
    assert history.capture(row.capture_sha256) == capture
    assert history.document(row.id, "report.json") == (folder / "report.json").read_bytes()
    figures = {(one.part, one.name): one for one in history.session_figures(row.id)}
    snare = report["per_piece"]["snare"]
    assert figures[Part.PIECE, "snare"].misses == snare["misses"]
    assert figures[Part.PIECE, "snare"].sd_ms == snare["timing"]["sd_asynchrony_ms"]
    assert {name for part, name in figures if part is Part.LIMB} == set(report["per_limb"])
    lines = list(csv.DictReader((folder / "pairs.csv").read_text().splitlines()))
    judged = history.judgements(row.id)
    assert [one.label for one in judged] == [line["label"] for line in lines]
    assert [str(one.hit_piece or "") for one in judged] == [line["hit_piece"] for line in lines]
    assert [one.beat for one in judged] == [float(line["beat"]) for line in lines]
    assert [one.hit_time_s for one in judged] == [
        float(line["hit_time_s"] or "nan") if line["hit_time_s"] else None for line in lines
    ]


def test_twice_is_once_and_a_report_that_is_written_anew_takes_its_place(folder: Path, history: History) -> None:
    first = take_in(history, "Ann", folder)
    report = json.loads((folder / "report.json").read_text())
    (folder / "report.json").write_text(json.dumps(report | {"score": 12.5}))
    assert take_in(history, "Ann", folder) == first
    assert [row.score for row in history.sessions("Ann")] == [12.5]


def test_a_folder_that_the_user_named_is_known_again(played: Path, tmp_path: Path, history: History) -> None:
    folder = shutil.copytree(played, tmp_path / "out")
    first = take_in(history, "Ann", folder)
    assert take_in(history, "Ann", folder) == first
    [row] = history.sessions("Ann")
    assert row.folder == str(folder)
    assert "_out-" in row.name


HOSTILE: list[tuple[list[str], object, str, object]] = [
    (["score"], float("nan"), "score", None),
    (["score"], 10**400, "score", None),
    (["right"], 2**40, "right", 0),
    (["counts"], [], "notes", 0),
    (["timing", "sd_asynchrony_ms"], "wide", "sd_ms", None),
    (["session", "title"], "a\0b\ud800c\x1b[2J", "title", "a b c [2J"),
    (["session", "device"], {"x": 1}, "device", ""),
    (["level"], "studio" * 10, "level", "studiostudiostudiost"),
]


@pytest.mark.parametrize(("place", "value", "field", "kept"), HOSTILE)
def test_what_no_report_of_ours_says_is_no_data(
    place: list[str], value: object, field: str, kept: object, folder: Path, history: History
) -> None:
    report = table = json.loads((folder / "report.json").read_text())
    for key in place[:-1]:
        table = table[key]
    table[place[-1]] = value
    (folder / "report.json").write_text(json.dumps(report))
    take_in(history, "Ann", folder)
    [row] = history.sessions("Ann")
    assert getattr(row, field) == kept
    assert history.judgements(row.id)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[]",
        "7",
        '{"session": {"lesson": "a", "played_s": 1e99}}',
        '{"session": {}}',
        '{"session": 1}',
        "[" * 100_000,
    ],
)
def test_a_report_that_cannot_be_read_is_named_and_its_session_left_out(
    text: str, folder: Path, history: History
) -> None:
    (folder / "report.json").write_text(text)
    with pytest.raises(BadInput, match=r"report\.json"):
        take_in(history, "Ann", folder)
    assert history.sessions("Ann") == []


@pytest.mark.parametrize("line", ["match,x", "match,0,nan,38,0,0.1,38,1,1,1,snare,head,normal,90,", "\0", '"'])
def test_a_damaged_table_is_left_out_and_the_rest_kept(line: str, folder: Path, history: History) -> None:
    with (folder / "pairs.csv").open("a") as table:
        table.write(f"{line}\n")
    take_in(history, "Ann", folder)
    [row] = history.sessions("Ann")
    assert row.score is not None
    assert history.judgements(row.id) == []


def test_what_is_missing_is_missing(folder: Path, history: History) -> None:
    (folder / "session.capture").unlink()
    (folder / "pairs.csv").unlink()
    (folder / "pairs.csv").mkdir()
    take_in(history, "Ann", folder)
    [row] = history.sessions("Ann")
    assert row.capture_sha256 is None
    assert history.document_names(row.id) == ["report.json"]


def test_an_exam_and_what_it_came_to(folder: Path, history: History) -> None:
    exam = {"schema": "drum-station/exam/1", "lesson": "rock-1", "marks": {"total": 87.19, "band": "distinction"}}
    (folder / "exam.json").write_text(json.dumps(exam))
    take_in(history, "Ann", folder)
    [row] = history.sessions("Ann")
    assert row.exam == "distinction, 87.1 of 100"
    (folder / "report.json").unlink()
    other = folder.rename(folder.with_name("2026-03-02T10-00-00_rock-1"))
    take_in(history, "Ann", other)
    [looked] = history.sessions("Ann", state=SessionState.BEGUN)
    assert (looked.name, looked.lesson) == (other.name, "rock-1")
    assert len(history.documents("Ann", "exam.json")) == 2


def test_a_take_and_a_battle(tmp_path: Path, history: History) -> None:
    sessions = tmp_path / "sessions"
    take = student_folder(sessions, "Ann") / "2026-03-01T10-00-00_just-play"
    take.mkdir(parents=True)
    (take / "take.json").write_text('{"length_s": 42.5, "tempo_bpm": 90, "click": false}')
    battle = student_folder(sessions, "Ann") / "2026-03-01T11-00-00_battle-steady"
    battle.mkdir()
    turn = {"side": 1, "starts_s": 12.0, "bars": 2, "marks": {"notes": 8, "right": 6}}
    document = {
        "rules": {"tempo_bpm": 120.0, "meter": [3, 4], "level": "beginner"},
        "complete": True,
        "scores": [
            {"side": 0, "name": "Steady", "drummer": True, "device": None},
            {"side": 1, "name": "Ann", "drummer": False, "device": "TD-17"},
        ],
        "rounds": [{"turns": [{"side": 0, "starts_s": 0.0, "bars": 2, "marks": None}, turn]}],
    }
    (battle / "battle.json").write_text(json.dumps(document))
    (battle / "battle.capture").write_bytes(b"as it was played")
    assert everything_in(history, sessions, "Ann").sessions == 2
    just, fight = history.sessions("Ann")
    assert (just.kind, just.title, just.played_s, just.beats_a_minute) == (SessionKind.TAKE, "Just play", 42.5, None)
    assert (fight.kind, fight.title, fight.device) == (SessionKind.BATTLE, "Battle with Steady", "TD-17")
    assert (fight.notes, fight.right, fight.beats_a_minute) == (8, 6, 120.0)
    assert fight.played_s == 15.0  # two bars of three quarters at 120 after the twelfth second
    assert fight.capture_sha256 == hashlib.sha256(b"as it was played").hexdigest()


def test_all_that_is_new_is_taken_in_and_nothing_twice(played: Path, tmp_path: Path, history: History) -> None:
    sessions = tmp_path / "sessions"
    ours = student_folder(sessions, "Ann")
    for day in (3, 1, 2):
        shutil.copytree(played, ours / f"2026-03-0{day}T18-30-05_rock-1")
    (ours / "2026-03-02T18-30-05_rock-1" / "report.json").write_text("{")
    cut_off = ours / "2026-03-04T18-30-05_rock-1"
    cut_off.mkdir()
    (cut_off / "session.capture").write_bytes(b"some")
    for other in ("mastery", "book", "2026-03-05T18-30-05_empty", "holiday pictures"):
        (ours / other).mkdir()
    shutil.copytree(played, student_folder(sessions, "Ben") / NAME)
    told: list[tuple[int, int]] = []
    found = everything_in(history, sessions, "Ann", lambda done, of: told.append((done, of)))
    assert [row.name[:10] for row in history.sessions("Ann")] == ["2026-03-01", "2026-03-03"]
    assert [row.name for row in history.sessions("Ann", state=SessionState.BEGUN)] == [cut_off.name]
    assert found.sessions == 3
    assert [fault for fault in found.faults if "2026-03-02" in fault] == list(found.faults) != []
    assert told[:2] == [(0, 5), (1, 5)]
    assert history.sessions("Ben") == []
    assert everything_in(history, sessions, "Ann").sessions == 0
    shutil.copy(played / "report.json", cut_off)
    assert everything_in(history, sessions, "Ann").sessions == 1
    assert history.sessions("Ann", state=SessionState.BEGUN) == []
    assert len(history.sessions("Ann")) == 3


def test_nobody_has_a_folder(tmp_path: Path, history: History) -> None:
    assert everything_in(history, tmp_path / "none", "Ann").sessions == 0
    assert take_in(history, "Ann", tmp_path) is None

"""`station history list` and `show`, and the session that a word means."""

import json
import shutil
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path

import pytest

from station.cli.command_line import main
from station.core.errors import BadInput, DeviceError
from station.core.settings import data_folder, load_settings
from station.practice.history.session_choice import choose_session, history_for
from station.practice.history.session_files import student_folder
from station.store.history import History
from station.store.rows import SessionKind
from tests.fakes.kept_sessions import kept, on_the_disk, users_history

HOSTILE = ("../../etc", "<script>alert(1)</script>", "=cmd()", "x" * 200, "\u202eevil\u202c שלום", "🥁 Zoë", "\x1b[2J")


@pytest.fixture(autouse=True)
def _own_history(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))


@pytest.fixture
def numbers() -> Iterator[list[int]]:
    """Ann's sessions of two days, and one of Ben's; their numbers."""
    history = users_history()
    rows = [
        kept("Ann", datetime(2026, 11, 23, 18, 30), played_s=90.0),
        kept("Ann", datetime(2026, 11, 24, 17, 0), "swing-1", played_s=200.0, complete=False, score=None),
        kept("Ann", datetime(2026, 11, 24, 18, 0), "", kind=SessionKind.TAKE, title="", beats_a_minute=None),
        kept("Ben", datetime(2026, 11, 24, 18, 0)),
    ]
    yield [history.keep(each) for each in rows]
    history.database.close()


def listed(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, object]:
    assert main(["history", *words, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert isinstance(document, dict)
    return document


def test_the_list_has_a_row_a_session_and_what_they_come_to(
    numbers: list[int], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["history", "--student", "Ann"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].split() == f"{numbers[0]} 2026-11-23 18:30 1.5 80 82 15 ms rock-1: Title of rock-1".split()
    assert lines[2].endswith("swing-1: Title of swing-1 (stopped early)")
    assert lines[3].endswith("just played")
    assert lines[4] == "3 sessions on 2 days, 6 minutes"  # 90 + 200 + 90 seconds


def test_days_and_lessons_narrow_it(numbers: list[int], capsys: pytest.CaptureFixture[str]) -> None:
    of_the_24th = listed(capsys, "list", "--student", "Ann", "--since", "2026-11-24", "--until", "2026-11-24")
    assert [each["number"] for each in of_the_24th["sessions"]] == numbers[1:3]  # type: ignore[attr-defined]
    assert of_the_24th["totals"] == {"sessions": 2, "days": 1, "played_s": 290.0}
    swung = listed(capsys, "--student", "Ann", "--lesson", "swing-1")["sessions"]
    assert swung == [
        {
            "number": numbers[1],
            "student": "Ann",
            "name": "2026-11-24T17-00-00_swing-1",
            "started": "2026-11-24T17:00:00",
            "folder": kept("Ann", datetime(2026, 11, 24, 17, 0), "swing-1").row.folder,
            "kind": "lesson",
            "state": "kept",
            "lesson": "swing-1",
            "title": "Title of swing-1",
            "device": "TD-17",
            "played_s": 200.0,
            "complete": False,
            "score": None,
            "level": "beginner",
            "beats_a_minute": 80.0,
            "notes": 2,
            "right": 1,
            "strokes": 1,
            "mean_ms": -2.5,
            "sd_ms": 15.25,
            "exam": "",
            "capture_sha256": users_history().session(numbers[1]).capture_sha256,  # type: ignore[union-attr]
            "first_bar": None,
            "last_bar": None,
            "click": None,
            "gap": None,
            "input_latency_ms": None,
            "output_latency_ms": None,
            "top_beats_a_minute": None,
        }
    ]
    assert main(["history", "--student", "Ann", "--lesson", "waltz"]) == 0
    assert capsys.readouterr().err == "nothing of Ann is kept of waltz\n"
    assert main(["history", "--since", "2026-11-25", "--until", "2026-11-24"]) == 2
    assert main(["history", "--since", "yesterday"]) == 2


@pytest.mark.parametrize("name", HOSTILE)
def test_no_name_reaches_the_terminal_as_a_command(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    number = users_history().keep(kept(name, datetime(2026, 11, 24, 18, 0), title=name, device=name))
    for words in (["list", "--student", name], ["show", str(number)]):
        assert main(["history", *words]) == 0
        assert all(line.isprintable() for line in capsys.readouterr().out.splitlines())


def test_a_folder_that_nobody_has_taken_in_is_listed(capsys: pytest.CaptureFixture[str]) -> None:
    folder = student_folder(load_settings().sessions_dir, "Ann")
    for name, document in (("2026-11-20T10-00-00_just-play", '{"length_s": 60}'), ("2026-11-21T10-00-00_broken", "{")):
        (folder / name).mkdir(parents=True)
        (folder / name / "take.json").write_text(document)
    assert main(["history", "--student", "Ann"]) == 0
    said = capsys.readouterr()
    assert said.out.splitlines()[-1] == "1 session on 1 day, 1 minute"
    assert "is no report of ours" in said.err


def test_a_session_is_shown_with_its_files_or_without_them(
    numbers: list[int], capsys: pytest.CaptureFixture[str]
) -> None:
    session = kept("Ann", datetime(2026, 11, 23, 18, 30))
    folder = on_the_disk(session, {"report.txt": b"Good."})
    assert main(["history", "show", str(numbers[0])]) == 0
    shown = capsys.readouterr().out
    for words in ("1.5 minutes at 80 bpm", "1 of 2 right", "8 of 10 hit", "1 match, 1 miss", str(folder), "report.txt"):
        assert words in shown
    shutil.rmtree(folder)
    assert main(["history", "show", "--student", "Ann", "2026-11-23"]) == 0
    assert f"{folder} is gone; report and replay come from the capture in the history" in capsys.readouterr().out
    assert main(["history", "show", "--json", str(numbers[0])]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["session"]["number"] == numbers[0]
    assert document["figures"][0]["mean_ms"] == -3.5
    assert (document["judgements"], document["files"]) == ({"match": 1, "miss": 1}, [])


def test_a_word_means_a_session(numbers: list[int], tmp_path: Path) -> None:
    history = users_history()
    first = kept("Ann", datetime(2026, 11, 23, 18, 30))
    folder = on_the_disk(first)
    capture = folder / "session.capture"
    for word in (str(numbers[0]), "2026-11-23", str(folder), str(capture)):
        chosen = choose_session(history, "Ann", word)
        assert chosen.row is not None
        assert (chosen.row.id, chosen.capture) == (numbers[0], capture)
        assert chosen.capture_data(history) == first.capture
    last = choose_session(history, "Ann", "last")
    assert last.row is not None
    assert (last.row.id, last.folder, last.capture) == (numbers[2], None, None)
    third = kept("Ann", datetime(2026, 11, 24, 18, 0), "")
    assert last.capture_data(history) == third.capture
    copied = shutil.copytree(folder, tmp_path / "copied")
    unknown = choose_session(history, "Ann", str(copied))
    assert (unknown.row, unknown.folder, unknown.capture) == (None, copied, copied / "session.capture")


@pytest.mark.parametrize(
    ("word", "fault"),
    [
        ("999", "there is no session of that number"),
        pytest.param("9" * 5000, "no such file", id="long"),
        ("2026-11-24", "2 sessions are of that day"),
        ("2026-11-22", "nothing of Ann is kept of that day"),
        ("9999-12-31", "nothing of Ann is kept of that day"),
        ("2026-13-01", "no such file"),
        (".", "no session is in this folder"),
        ("nothing", "no such file"),
    ],
)
def test_what_means_none_is_told_in_a_line(
    numbers: list[int], word: str, fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(BadInput, match=fault):
        choose_session(users_history(), "Ann", word)
    with pytest.raises(BadInput, match="nothing of Zoë is kept"):
        choose_session(users_history(), "Zoë", "last")


def test_a_folder_says_itself_what_it_is_where_the_history_is_away(tmp_path: Path) -> None:
    session = kept("Ann", datetime(2026, 11, 23, 18, 30))
    folder = on_the_disk(session)

    def away() -> History:
        raise DeviceError("the server is away")

    for word in (str(folder), str(folder / "session.capture")):
        history = history_for(word, away)
        chosen = choose_session(history, "Ann", word)
        assert (history, chosen.row, chosen.capture_data(None)) == (None, None, session.capture)
    for word in ("1", "last", "2026-11-23"):
        with pytest.raises(DeviceError, match="the server is away"):
            history_for(word, away)


def test_what_is_kept_nowhere_cannot_be_read(tmp_path: Path) -> None:
    history = users_history()
    session = kept("Ann", datetime(2026, 11, 23, 18, 30))
    number = history.keep(type(session)(session.row))
    with pytest.raises(BadInput, match="neither in a folder nor in the history"):
        choose_session(history, "Ann", str(number)).capture_data(history)
    assert load_settings().student == "student"


def test_a_history_that_was_emptied_says_what_is_lost(capsys: pytest.CaptureFixture[str]) -> None:
    folder = student_folder(load_settings().sessions_dir, "Ann") / "2026-11-20T10-00-00_just-play"
    folder.mkdir(parents=True)
    (folder / "take.json").write_text('{"length_s": 60}')
    path = data_folder() / "history.sqlite3"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch()
    assert main(["history", "--student", "Ann"]) == 0
    assert "was empty: sessions come from their folders again, mastery and levels begin anew" in capsys.readouterr().err


def test_a_damaged_old_file_is_told_by_the_list(capsys: pytest.CaptureFixture[str]) -> None:
    old = student_folder(load_settings().sessions_dir, "Ann") / "mastery"
    old.mkdir(parents=True)
    (old / "rock-1_1-2.json").write_text("{")
    for count in (1, 0):
        assert main(["history", "--student", "Ann"]) == 0
        assert capsys.readouterr().err.count("mastery begins anew") == count


def test_many_sessions_at_once_are_announced(capsys: pytest.CaptureFixture[str]) -> None:
    folder = student_folder(load_settings().sessions_dir, "Ann")
    for minute in range(100):
        (folder / f"2026-11-20T10-{minute // 60:02}-{minute % 60:02}_just-play").mkdir(parents=True)
        (folder / f"2026-11-20T10-{minute // 60:02}-{minute % 60:02}_just-play" / "take.json").write_text("{")
    assert main(["history", "--student", "Ann"]) == 0
    assert "taking 100 sessions into the history…" in capsys.readouterr().err


def test_a_year_has_four_digits(capsys: pytest.CaptureFixture[str]) -> None:
    users_history().keep(kept("Ann", datetime(1, 1, 1, 18, 0)))
    assert main(["history", "--student", "Ann"]) == 0
    assert "  0001-01-01 18:00  " in capsys.readouterr().out

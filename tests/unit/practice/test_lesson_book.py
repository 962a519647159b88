"""The lesson book: today's plan is kept, ticked off by what was played, survives hostile files, and reads as words."""

import json
from dataclasses import replace
from datetime import date, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest

from station.cli.command_line import main
from station.core.errors import BadInput, DeviceError
from station.core.settings import Settings
from station.drills.daily.daily_items import DailyItem, ItemKind
from station.practice.book.book_day import BookDay, BookFolder, one_line
from station.practice.book.book_words import book_text, how_words, session_words, today_text
from station.practice.book.day_progress import BlockState, day_progress
from station.practice.book.lesson_book import LessonBook
from station.practice.book.practised import PractisedSession, practised_on
from station.practice.book.teachers_words import TeacherNote
from tests.fakes.known_students import one_student, take_all_in

DAY = date(2026, 11, 23)
MORNING = datetime(2026, 11, 23, 9)


def item(lesson: str, minutes: int = 4, kind: ItemKind = ItemKind.GO_ON, gap: str = "", rise: str = "") -> DailyItem:
    return DailyItem(kind, lesson, lesson.title(), (0, 1), 70.0, 84.0, "A start.", minutes, 6, "On.", gap, rise)


def session(lesson: str, played_s: float, complete: bool = True, minute: int = 0) -> PractisedSession:
    return PractisedSession(MORNING + timedelta(minutes=minute), lesson, lesson.title(), played_s, complete, 88.0, 84.0)


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return replace(Settings(), sessions=str(tmp_path), student="Ann")


def book(settings: Settings) -> tuple[LessonBook, list[str]]:
    said: list[str] = []
    return LessonBook(settings, said.append), said


# --- how far a day is


def test_a_session_ticks_off_the_first_open_block_of_its_lesson() -> None:
    day = BookDay(DAY, 20, (item("a"), item("b"), item("a")))
    progress = day_progress(day, [session("a", 200), session("x", 60)])
    assert [block.state for block in progress.blocks] == [BlockState.DONE, BlockState.OPEN, BlockState.OPEN]
    assert progress.next is not None
    assert progress.next.place == 1
    assert [one.lesson for one in progress.beside] == ["x"]
    assert progress.minutes == pytest.approx(260 / 60)


def test_a_block_that_was_stopped_is_done_with_half_of_its_minutes() -> None:
    """Four minutes: 119 seconds are not enough, one more is, in one session or in two."""
    day = BookDay(DAY, 20, (item("a"),))
    assert day_progress(day, [session("a", 119, complete=False)]).done == 0
    assert day_progress(day, [session("a", 119, complete=False), session("a", 1, complete=False)]).done == 1


def test_what_was_left_out_is_not_next_and_the_day_is_over() -> None:
    day = BookDay(DAY, 20, (item("a"), item("b")), left_out=(0,))
    progress = day_progress(day, [session("b", 10)])
    assert [block.state for block in progress.blocks] == [BlockState.LEFT_OUT, BlockState.DONE]
    assert progress.is_over
    assert not day_progress(BookDay(DAY), []).is_over


# --- what is kept


def test_the_plan_of_a_day_stays_until_other_minutes_are_asked_for(settings: Settings) -> None:
    mine, said = book(settings)
    first = mine.today(DAY)
    assert first.kept.minutes == 20
    assert sum(one.minutes for one in first.kept.items) == 20
    assert mine.today(DAY).kept == first.kept
    assert mine.today(DAY, minutes=20).kept == first.kept
    other = mine.today(DAY, minutes=35)
    assert sum(one.minutes for one in other.kept.items) == 35
    assert said == []


def test_a_line_is_one_line(settings: Settings) -> None:
    mine, _ = book(settings)
    mine.today(DAY)
    page = mine.reflect(DAY, "  the left hand\nis\x1b[31m late \t today " + "x" * 1000)
    assert page.kept.line.startswith("the left hand is [31m late today xxx")
    assert len(page.kept.line) == 280
    assert page.kept.items == mine.today(DAY).kept.items
    assert one_line("\u202e") == ""


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "{}",
        '{"schema": "drum-station/book-day/1"}',
        '{"schema": "drum-station/book-day/1", "day": {"day": 5}}',
        "[" * 100_000,
        "\x00\xff",
        '{"schema": "drum-station/book-day/1", "day": {"day": "2026-11-23", "left_out": [7]}}',
        json.dumps({"schema": "drum-station/book-day/1", "day": {"day": "2026-11-23", "line": "x" * 999}}),
    ],
)
def test_a_day_that_cannot_be_read_is_set_aside_and_told_in_one_line(settings: Settings, text: str) -> None:
    folder = BookFolder.of(settings.sessions_dir, "Ann")
    folder.path.mkdir(parents=True)
    (folder.path / "2026-11-23.json").write_text(text, encoding="utf-8", errors="surrogateescape")
    mine, said = book(settings)
    assert mine.today(DAY).kept.items
    assert len(said) == 1
    assert "it is kept as 2026-11-23.json.unread-1" in said[0]
    assert (folder.path / "2026-11-23.json.unread-1").exists()


def test_a_file_of_another_day_counts_for_the_day_in_its_name(settings: Settings) -> None:
    folder = BookFolder.of(settings.sessions_dir, "Ann")
    folder.keep(BookDay(DAY, 4, (item("rock-1"),), line="Easy."))
    (folder.path / "2026-11-23.json").rename(folder.path / "2026-11-20.json")
    kept, fault = folder.recall(DAY - timedelta(days=3))
    assert (kept.day, fault) == (DAY - timedelta(days=3), None)
    assert kept.line == "Easy."
    assert folder.days() == [DAY - timedelta(days=3)]


def test_a_book_that_cannot_be_written_says_so(settings: Settings) -> None:
    folder = BookFolder.of(settings.sessions_dir, "Ann")
    folder.path.parent.mkdir(parents=True)
    folder.path.write_text("a file where the folder should be")
    with pytest.raises(DeviceError):
        book(settings)[0].today(DAY)


def test_minutes_that_no_day_has_change_nothing(settings: Settings) -> None:
    mine, _ = book(settings)
    before = mine.today(DAY).kept
    with pytest.raises(BadInput):
        mine.today(DAY, minutes=1000)
    assert mine.today(DAY).kept == before


# --- what was practised


def test_reports_and_takes_of_a_day_are_found_and_other_folders_left_alone(tmp_path: Path) -> None:
    report = {
        "score": 90.5,
        "session": {"lesson": "rock-1", "title": "Rock", "complete": True, "beats_a_minute": 80, "played_s": 48.0},
    }
    for name, file, document in [
        ("2026-11-23T10-00-00_rock-1", "report.json", json.dumps(report)),
        ("2026-11-23T09-00-00_free", "take.json", '{"length_s": 61.5}'),
        ("2026-11-23T11-00-00_cut-off", "session.capture", ""),
        ("2026-11-23T12-00-00_bad", "report.json", "[1, 2"),
        ("2026-11-23T13-00-00_worse", "report.json", '{"score": 1, "session": {"lesson": "x", "played_s": 1e99}}'),
        ("2026-11-23Tnow", "report.json", json.dumps(report)),
        ("2026-11-22T10-00-00_rock-1", "report.json", json.dumps(report)),
    ]:
        (tmp_path / "Ann" / name).mkdir(parents=True)
        (tmp_path / "Ann" / name / file).write_text(document, encoding="utf-8")
    whose = one_student(tmp_path, "Ann")
    take_all_in(whose)
    found = practised_on(whose, [DAY])
    assert [(one.lesson, one.played_s, one.score) for one in found] == [("", 61.5, None), ("rock-1", 48.0, 90.5)]


EXAM = {"schema": "drum-station/exam/1", "marks": {"total": 82.47, "band": "merit"}}


@pytest.mark.parametrize(
    ("document", "words"),
    [
        (EXAM, "Rock at 80 bpm, exam: merit, 82.4 of 100"),
        ({**EXAM, "marks": None}, "Rock at 80 bpm, 90 of 100"),  # it was only looked at
        ({**EXAM, "marks": {"total": 1e300, "band": "merit"}}, "Rock at 80 bpm, 90 of 100"),
        ({**EXAM, "marks": {"total": 82.47, "band": "\x1b[31m"}}, "Rock at 80 bpm, 90 of 100"),
        ([], "Rock at 80 bpm, 90 of 100"),
    ],
)
def test_an_exam_stands_in_the_book_with_its_band(tmp_path: Path, document: object, words: str) -> None:
    report = {"lesson": "rock-1", "title": "Rock", "complete": True, "beats_a_minute": 80, "played_s": 48.0}
    folder = tmp_path / "Ann" / "2026-11-23T10-00-00_rock-1"
    folder.mkdir(parents=True)
    (folder / "report.json").write_text(json.dumps({"score": 90.0, "session": report}), encoding="utf-8")
    (folder / "exam.json").write_text(json.dumps(document), encoding="utf-8")
    whose = one_student(tmp_path, "Ann")
    take_all_in(whose)
    (one,) = practised_on(whose, [DAY])
    assert session_words(one) == f"10:00   0.8 min  {words}"


# --- in words


def test_how_a_block_is_played() -> None:
    assert how_words(item("a", gap="4/1")) == (
        "Bars 1–2 at 84 bpm, 70 % of the target, then it follows you; 4 bars of click, 1 without, in turn"
    )
    warm = item("a", kind=ItemKind.WARM_UP, rise="4/4:96")
    assert how_words(warm) == "Bars 1–2 at 84 bpm, 70 % of the target, +4 bpm every 4 bars up to 96"


def test_the_day_and_the_book_as_text(settings: Settings) -> None:
    mine, _ = book(settings)
    BookFolder.of(settings.sessions_dir, "Ann").keep(BookDay(DAY, 8, (item("rock-1"), item("rock-2")), line="Easy."))
    page = replace(mine.page(DAY), notes=(TeacherNote(DAY, "Mr Roy", ("Relax.", "Next: rock-2")),))
    assert today_text(page).startswith("Monday, 23 November: 8 minutes\n\n   1   4 min  Go on      Rock-1\n")
    text = book_text([page], [], DAY)
    assert "planned    8 minutes, 2 blocks; 0 played" in text
    assert "you        Easy." in text
    assert "Mr Roy     Relax.\n  Mr Roy     Next: rock-2" in text
    assert "Nothing in the book yet" in book_text([], [], DAY)


# --- the commands, end to end


def test_a_day_from_the_plan_to_the_book(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("XDG_DOCUMENTS_DIR", str(tmp_path))

    def said(*words: str) -> dict[str, Any]:
        assert main(list(words)) == 0
        document: dict[str, Any] = json.loads(capsys.readouterr().out)
        return document

    plan = said("today", "--minutes", "8", "--student", "Ann", "--json")
    assert sum(one["minutes"] for one in plan["items"]) == 8
    assert plan["items"][0]["kind"] == "warm-up"
    assert plan["next"] == 0
    ann = ("--student", "Ann")
    play = ("--virtual-student", "pro,seed=1", "--no-pictures", "--no-demonstration", "--json", *ann)
    report = said("practice", "--today", *play)
    assert report["session"]["lesson"] == plan["items"][0]["lesson"]
    assert report["session"]["tempi"][0]["beats_a_minute"] == plan["items"][0]["beats_a_minute"]
    assert [one["beats_a_minute"] for one in report["session"]["tempi"]][-1] <= float(
        plan["items"][0]["rise"].split(":")[1]
    )
    after = said("today", "--json", *ann)
    assert (after["items"][0]["state"], after["next"]) == ("done", 1)
    skipped = said("today", "--leave-out", "--line", "Good.", "--json", *ann)
    assert (skipped["items"][1]["state"], skipped["next"], skipped["line"]) == ("left out", 2, "Good.")
    (day,) = said("book", "--json", *ann)["days"]
    assert [one["lesson"] for one in day["practised"]] == [plan["items"][0]["lesson"]]
    assert day["line"] == "Good."


def test_what_the_plan_says_cannot_be_said_besides(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["practice", "--today", "--tempo", "90", "--headless", "--virtual-student", "pro"]) == 2
    assert "--today: tempo: the plan says so already" in capsys.readouterr().err


@pytest.mark.parametrize("days", ["0", "-3"])
def test_no_days_are_refused(days: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["book", "--days", days]) == 2
    assert f"--days: {days}: expected 1 or more" in capsys.readouterr().err

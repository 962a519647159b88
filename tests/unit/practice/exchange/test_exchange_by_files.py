"""An assignment goes to a student and their return comes back, by files alone; each side has a home of its own."""

import json
from collections.abc import Callable
from dataclasses import replace
from datetime import date, datetime
from pathlib import Path

import pytest

from station.app.teacher_desk.judge_worker import Heard
from station.cli.command_line import main
from station.core.errors import BadInput
from station.core.settings import Settings
from station.devices.capture.capture import CaptureRecord, parse_capture
from station.practice.exchange.assignment_file import assignment_bytes
from station.practice.exchange.note_file import read_note
from station.practice.exchange.return_file import parse_return, read_return, return_bytes
from station.practice.exchange.return_judging import checked_capture, judge_returned
from station.practice.exchange.student_store import take, taken_assignments
from tests.fakes.captures import capture_bytes
from tests.fakes.kept_sessions import users_history
from tests.parcels_made import ASSIGNMENT, TEXT, a_return

NOW = datetime(2026, 11, 23, 18, 0, 0)
Run = Callable[..., str]


@pytest.fixture
def at_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs a command as `who`, whose settings and sessions are their own; gives what it printed."""

    def run(who: str, *words: str | Path, status: int = 0) -> str:
        config = tmp_path / who / "config"
        (config / "drum-station").mkdir(parents=True, exist_ok=True)
        settings = f"student = {json.dumps(who)}\nsessions = {json.dumps(str(tmp_path / who / 'sessions'))}\n"
        (config / "drum-station" / "settings.toml").write_text(settings)
        monkeypatch.setenv("XDG_CONFIG_HOME", str(config))
        assert main([*map(str, words)]) == status
        printed = capsys.readouterr()
        return printed.out + printed.err

    return run


def test_an_assignment_is_given_practised_returned_judged_and_answered(at_home: Run, tmp_path: Path) -> None:
    """The figures of the student's report are those that the teacher's station finds in the capture."""
    given, sent, note = (tmp_path / f"x.drum-{kind}" for kind in ("assignment", "return", "note"))
    goal = "rock-1:tempo=80,passes=1,minutes=0.1,words=hands low"
    asked = ("--goal", goal, "--due", "2026-12-01", "--title", "Week 3", "--teacher", "Mo")
    (tmp_path / "three.toml").write_text(TEXT)
    lessons = ("--lesson", "rock-1", "--lesson", tmp_path / "three.toml")
    told = at_home("Ms Okafor", "assignment", "new", *lessons, *asked, "--out", given)
    assert "2 lessons, version 1" in told

    told = at_home("Zoë", "assignment", "take", given)
    assert "Week 3: taken" in told
    assert "due Tuesday, 1 December" in told
    assert "[ ] clean at 80 bpm" in told
    assert "three" in at_home("Zoë", "lesson", "list")
    at_home("Zoë", "assignment", "return", "week", "--out", sent, status=2)
    play = ("--headless", "--virtual-student", "pro,seed=1", "--student", "Zoë", "--no-pictures", "--json")
    printed = at_home("Zoë", "practice", "rock-1", "--loops", "2", "--no-demonstration", *play)
    report, _ = json.JSONDecoder().raw_decode(printed)
    told = at_home("Zoë", "assignment", "list")
    assert "[x] clean at 80 bpm" in told
    assert "[x] 0.2 of 0.1 minutes" in told  # two passes of two bars of 4/4 at 80 are 12 s
    assert "1 session" in at_home("Zoë", "assignment", "return", "week", "--words", "Two days.", "--out", sent)

    told = at_home("Ms Okafor", "assignment", "receive", sent)
    assert "received: Zoë, Week 3, 1 session" in told
    assert "came before" in at_home("Ms Okafor", "assignment", "receive", sent)
    returned = read_return(sent)
    assert report["session"]["assignments"] == [returned.assignment.id]
    judged = judge_returned(returned, 1, "x", Settings())
    assert judged.figures.score == report["score"]
    assert judged.figures.right == report["right"]
    assert judged.differences == ()
    told = at_home("Ms Okafor", "assignment", "review")
    assert f"score {report['score']:.0f}, {report['right']} of {report['counts']['notes']} right" in told
    assert "rock-1: clean at 80 bpm: reached" in told

    verdict = ("--verdict", "1:score=91,reached=no,counts=note3,refused=hit4,words=softer, please")
    at_home("Ms Okafor", "assignment", "answer", told.split()[3], "--next", "at 90", *verdict, "--out", note)
    assert [(one.counts, one.note, one.hit) for one in read_note(note).sessions[0].strokes] == [
        (True, 3, None),
        (False, None, 4),
    ]
    both = f"score 91 (the report says {report['score']:.0f}), strokes: 1 accepted and 1 not accepted"
    said = f"rock-1, session 1: goals not yet reached, {both}; softer, please"
    told = at_home("Ms Okafor", "assignment", "review")
    assert said in told
    assert "rock-1: clean at 80 bpm: not yet" in told
    told = at_home("Zoë", "assignment", "note", note)
    assert said in told
    assert "a note from Mo" in told  # who gave it, where nobody else says that they answer
    assert [kept.body for kept in users_history().notes("Zoë")] == [note.read_bytes()]
    told = at_home("Zoë", "assignment", "list")
    assert said in told
    assert [words in told for words in ("[ ] clean at 80 bpm", "best score 91")] == [True, True]
    again = at_home("Zoë", "practice", "rock-1", "--loops", "1", "--no-demonstration", *play[:-1])
    assert "From your teacher\n* softer, please. Next: at 90" in again


def test_a_verdict_that_cannot_be_is_told_by_the_option_that_says_it(at_home: Run, tmp_path: Path) -> None:
    out = tmp_path / "x.drum-assignment"
    given = ("assignment", "new", "--lesson", "rock-1", "--out", out, "--goal")
    told = at_home("Ms Okafor", *given, "rock-1:tempo=5000", status=2)
    assert told == "station: --goal: tempo: expected a number from 10 to 1000, found 5000.0\n"
    told = at_home("Ms Okafor", *given, "rock-1:passes=0", status=2)
    assert told.startswith("station: --goal: passes: expected a whole number from 1 to ")


def test_a_later_version_is_the_same_teachers(at_home: Run, tmp_path: Path) -> None:
    first, second = tmp_path / "1.drum-assignment", tmp_path / "2.drum-assignment"
    at_home("me", "assignment", "new", "--lesson", "rock-1", "--teacher", "Mo", "--out", first)
    at_home("me", "assignment", "new", "--replaces", first, "--words", "Slower.", "--out", second)
    assert "from Mo;" in at_home("Zoë", "assignment", "take", second)


# --- a report that is not so ------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def practised(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a session of a virtual student who misses a tenth of the notes."""
    folder = tmp_path_factory.mktemp("practised") / "x"
    student = "intermediate,seed=2,miss_pct=10"
    words = ("practice", "rock-1", "--loops", "2", "--no-demonstration", "--headless", "--no-pictures")
    assert main([*words, "--virtual-student", student, "--report", str(folder)]) == 0
    return folder


@pytest.fixture(scope="module")
def sent(practised: Path) -> bytes:
    return return_bytes(a_return(practised))


def test_a_return_comes_back_as_it_was(sent: bytes, practised: Path) -> None:
    returned = parse_return(sent, "x")
    (session,) = returned.sessions
    assert session.capture == (practised / "session.capture").read_bytes()
    assert session.report == (practised / "report.json").read_bytes()
    assert (session.lesson, session.seconds, returned.student) == ("rock-1", 10.0, "Zoë")


def test_a_report_that_was_made_better_is_told(sent: bytes, practised: Path) -> None:
    report = json.loads((practised / "report.json").read_text())
    better = {**report, "score": 99.0, "right": report["counts"]["notes"]}
    returned = parse_return(sent, "x")
    figures = replace(returned.sessions[0].figures, score=99.0, right=better["right"])
    forged = replace(returned, sessions=(replace(returned.sessions[0], figures=figures),))
    told = judge_returned(forged, 1, "x", Settings()).differences
    assert told[0] == f"the report says 99, the capture gives {report['score']:.0f}"
    assert told[1] == f"right: the report says {better['right']}, the capture gives {report['right']}"


def test_the_capture_of_another_lesson_is_told(sent: bytes) -> None:
    returned = parse_return(sent, "x")
    other = replace(returned.sessions[0], lesson_text=TEXT)
    with pytest.raises(BadInput, match="its capture holds no session of rock-1 as it was sent"):
        judge_returned(replace(returned, sessions=(other,)), 1, "x", Settings())


def _captured(sent: bytes, spoilt: Callable[[list[CaptureRecord], int], list[CaptureRecord]]) -> bytes:
    """The session's capture, spoilt: `spoilt` gets the records, and which of them begins the pass."""
    records = list(parse_capture(parse_return(sent, "x").sessions[0].capture).records)
    begun = next(i for i, one in enumerate(records) if b'"said":"pass"' in one.payload)
    return capture_bytes(spoilt(records, begun))


def _saying(record: CaptureRecord, **keys: object) -> CaptureRecord:
    return replace(record, payload=json.dumps({**json.loads(record.payload), **keys}).encode())


SPOILT: dict[str, Callable[[list[CaptureRecord], int], list[CaptureRecord]]] = {
    "a capture of more than 200 sessions": lambda all_, at: [*all_[: at + 1], *[all_[at]] * 200, *all_[at + 1 :]],
    "passes with more than 200000 notes": lambda all_, at: [_saying(all_[at], passes=1000, notes=[0] * 201)],
    "a tempo beyond 5 to 1600": lambda all_, at: [_saying(all_[at], tempos=[[0, 1]])],
    "a capture of 10001 records in 0 s": lambda all_, _: [all_[0]] * 10_001,
}


@pytest.mark.parametrize("told", SPOILT)
def test_a_capture_that_nobody_plays_is_refused_before_it_is_judged(told: str, sent: bytes) -> None:
    with pytest.raises(BadInput, match=told):
        checked_capture(_captured(sent, SPOILT[told]), "x", "session 1")


@pytest.mark.parametrize("passes", ["8", None, [1], 1.5])
def test_passes_that_are_no_number_are_the_readers_affair(passes: object, sent: bytes) -> None:
    capture = _captured(sent, lambda all_, at: [*all_[:at], _saying(all_[at], passes=passes), *all_[at + 1 :]])
    assert checked_capture(capture, "x", "session 1").records


def test_what_is_heard_crosses_from_one_process_to_another(sent: bytes) -> None:
    import pickle

    judged = judge_returned(parse_return(sent, "x"), 1, "x", Settings())
    assert pickle.loads(pickle.dumps(Heard(judged.figures, judged.differences))).figures == judged.figures


# --- what a student keeps ---------------------------------------------------------------------------------------------


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(student="Zoë", sessions=str(tmp_path / "sessions"))


def test_taking_twice_is_once(settings: Settings, tmp_path: Path) -> None:
    path = tmp_path / "a.drum-assignment"
    path.write_bytes(assignment_bytes(ASSIGNMENT))
    assert take(path, settings, NOW)[1] == "taken"
    assert take(path, settings, NOW)[1] == "was taken before: nothing changed"
    (one,) = taken_assignments(settings)[0]
    assert one.assignment == ASSIGNMENT
    assert one.days_left(date(2026, 11, 29)) == 2
    folder = settings.own_lessons_dir / one.folder.name
    assert sorted(lesson.name for lesson in folder.iterdir()) == ["four.toml", "three.toml"]


def test_a_later_version_takes_the_place(settings: Settings, tmp_path: Path) -> None:
    path = tmp_path / "a.drum-assignment"
    path.write_bytes(assignment_bytes(ASSIGNMENT))
    take(path, settings, NOW)
    slower = replace(ASSIGNMENT.lessons[0], text=TEXT.replace("\n\n", "\ntempo_bpm = 50\n\n"))
    path.write_bytes(assignment_bytes(replace(ASSIGNMENT, revision=2, lessons=(slower,))))
    assert take(path, settings, NOW)[1] == "version 2 takes the place of the one before"
    (one,) = taken_assignments(settings)[0]
    assert one.assignment.revision == 2
    assert "tempo_bpm = 50" in (settings.own_lessons_dir / one.folder.name / "three.toml").read_text()
    path.write_bytes(assignment_bytes(ASSIGNMENT))
    assert take(path, settings, NOW)[1].startswith("version 2 was taken before, which is later")
    path.write_bytes(assignment_bytes(replace(ASSIGNMENT, revision=2, words="another")))
    with pytest.raises(BadInput, match="another file of the same assignment and version"):
        take(path, settings, NOW)


def test_a_lesson_of_a_name_that_is_there_gets_a_number(settings: Settings, tmp_path: Path) -> None:
    """A shipped lesson in other words, and one of the student's own."""
    settings.own_lessons_dir.mkdir(parents=True)
    (settings.own_lessons_dir / "three.toml").write_text("# my own\n")
    path = tmp_path / "a.drum-assignment"
    lessons = (replace(ASSIGNMENT.lessons[0], name="rock-1"), ASSIGNMENT.lessons[0])
    path.write_bytes(assignment_bytes(replace(ASSIGNMENT, lessons=lessons)))
    one, _ = take(path, settings, NOW)
    assert one.taken.lessons == (("rock-1", "rock-1-2"), ("three", "three-2"))
    assert (settings.own_lessons_dir / "three.toml").read_text() == "# my own\n"


def test_nothing_is_kept_of_what_is_refused(settings: Settings, tmp_path: Path) -> None:
    path = tmp_path / "a.drum-assignment"
    path.write_bytes(assignment_bytes(ASSIGNMENT)[:-1])
    with pytest.raises(BadInput):
        take(path, settings, NOW)
    assert not Path(settings.sessions).exists()

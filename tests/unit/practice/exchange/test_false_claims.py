"""Files that are well made and say what is not so: it is told of a return, and refused of a note or an assignment."""

import json
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import pytest

from station.cli.command_line import main
from station.core.errors import BadInput
from station.core.settings import Settings
from station.drills.library import lesson_path
from station.practice.exchange.assignment_file import AssignedLesson, Assignment, assignment_bytes
from station.practice.exchange.note_file import SessionVerdict, note_bytes
from station.practice.exchange.return_file import AssignmentWord, Return, ReturnedSession, parse_return, return_bytes
from station.practice.exchange.return_judging import judge_returned
from station.practice.exchange.student_store import TakenAssignment, keep_note, remember_return, take
from tests.parcels_made import ASSIGNMENT, MADE, NOTE, TEXT, a_return

NOW = datetime(2026, 11, 23, 18, 0, 0)


# --- returns ----------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def returned(tmp_path_factory: pytest.TempPathFactory) -> Return:
    """One pass of rock-1."""
    folder = tmp_path_factory.mktemp("practised") / "x"
    words = ("practice", "rock-1", "--loops", "1", "--no-demonstration", "--headless", "--no-pictures")
    assert main([*words, "--virtual-student", "pro,seed=1", "--report", str(folder)]) == 0
    return a_return(folder)


def told(sent: Return, number: int = 1, asked: Assignment | None = None) -> tuple[str, ...]:
    """What a teacher is told of a session, after the return went as a file."""
    return judge_returned(parse_return(return_bytes(sent), "x"), number, "x", Settings(), asked).differences


def claiming(sent: Return, seconds: float | None = None, **keys: object) -> Return:
    """The return whose first report says otherwise."""
    (one,) = sent.sessions
    report = json.loads(one.report)
    report["session"] |= keys
    figures = one.figures if seconds is None else replace(one.figures, seconds=seconds)
    session = replace(one, report=json.dumps(report).encode(), figures=figures)
    return replace(sent, sessions=(session,))


def test_more_passes_than_were_played_are_told(returned: Return) -> None:
    assert told(claiming(returned, passes=50)) == ("passes: the report says 50, the capture gives 1",)


def test_more_minutes_than_the_capture_lasts_are_told(returned: Return) -> None:
    """Two bars of 4/4 at 80 bpm are six seconds, and so much of a minute before and after them."""
    (line,) = told(claiming(returned, seconds=3600.0))
    assert line.startswith("seconds: the return says 3600, the capture lasts ")
    assert 5 <= float(line.rsplit(" ", 1)[1]) <= 30


def test_a_session_that_was_cut_off_is_told(returned: Return) -> None:
    """The report says that it was played to its end; the end of its capture is missing."""
    (one,) = returned.sessions
    cut = replace(one, capture=one.capture[: len(one.capture) * 9 // 10])
    assert any("played to its end" in line for line in told(replace(returned, sessions=(cut,))))


def test_one_capture_sent_as_two_sessions_is_told(returned: Return) -> None:
    (one,) = returned.sessions
    twice = replace(returned, sessions=(one, replace(one, played=datetime(2026, 11, 24, 18, 0, 0))))
    assert told(twice, 1) == ()
    assert told(twice, 2) == ("its capture is that of session 1 again",)


def test_an_easier_lesson_under_the_name_of_the_one_that_was_given_is_told(returned: Return) -> None:
    text = lesson_path("rock-1").read_text(encoding="utf-8")
    asked = replace(ASSIGNMENT, lessons=(AssignedLesson("rock-1", "Rock", text),))
    assert told(returned, 1, asked) == ()
    harder = replace(asked, lessons=(AssignedLesson("rock-1", "Rock", text + "# harder\n"),))
    assert told(returned, 1, harder) == ("the lesson is not as version 1 of the assignment gives it",)
    assert told(returned, 1, ASSIGNMENT) == ("the assignment has no lesson rock-1",)


def test_reports_have_a_sum(returned: Return) -> None:
    """Three of 700 kB, each of which alone may be so long."""
    (one,) = returned.sessions
    long = replace(one, report=one.report.rstrip()[:-1] + b', "more": "' + b"x" * 700_000 + b'"}')
    with pytest.raises(BadInput, match="reports of more than 2 MiB together"):
        return_bytes(replace(returned, sessions=(long,) * 3))
    assert len(parse_return(return_bytes(replace(returned, sessions=(long,) * 2)), "x").sessions) == 2


# --- notes and assignments --------------------------------------------------------------------------------------------


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(student="Zoë", sessions=str(tmp_path / "sessions"))


@pytest.fixture
def taken(settings: Settings, tmp_path: Path) -> TakenAssignment:
    """The assignment was taken, and a return of one session of its lesson three was made."""
    one, _ = take(written(tmp_path, assignment_bytes(ASSIGNMENT)), settings, NOW)
    session = ReturnedSession("three", NOW, None, "", b"", b"", b"")  # type: ignore[arg-type] # its figures play no part
    remember_return(one, Return(NOTE.return_id, AssignmentWord.of(ASSIGNMENT), "Zoë", MADE, (session,)))
    return one


def written(folder: Path, data: bytes) -> Path:
    path = folder / "came"
    path.write_bytes(data)
    return path


def refused(folder: Path, data: bytes, settings: Settings) -> str:
    with pytest.raises(BadInput) as fault:
        keep_note(written(folder, data), settings)
    return fault.value.fault


def test_a_note_for_another_student_is_refused(taken: TakenAssignment, settings: Settings, tmp_path: Path) -> None:
    data = note_bytes(replace(NOTE, student="Max"))
    assert refused(tmp_path, data, settings) == "it is a note for Max, not for Zoë"
    assert not (taken.folder / "notes").exists()
    assert keep_note(written(tmp_path, note_bytes(NOTE)), settings)[2]


@pytest.mark.parametrize("verdict", [SessionVerdict(1, "four"), SessionVerdict(2, "three")])
def test_a_note_on_a_session_that_was_not_sent_is_refused(
    verdict: SessionVerdict, taken: TakenAssignment, settings: Settings, tmp_path: Path
) -> None:
    said = refused(tmp_path, note_bytes(replace(NOTE, sessions=(verdict,))), settings)
    assert said == f"it speaks of session {verdict.number}, {verdict.lesson}, which the return has not"


@pytest.mark.usefixtures("taken")
def test_another_note_of_the_same_id_is_refused(settings: Settings, tmp_path: Path) -> None:
    assert keep_note(written(tmp_path, note_bytes(NOTE)), settings)[2]
    assert not keep_note(written(tmp_path, note_bytes(NOTE)), settings)[2]
    said = refused(tmp_path, note_bytes(replace(NOTE, words="Badly done.")), settings)
    assert said == "another note of the same id came before"


def test_a_lesson_that_the_student_changed_outlives_a_later_version(
    taken: TakenAssignment, settings: Settings, tmp_path: Path
) -> None:
    own = settings.own_lessons_dir / taken.folder.name / "three.toml"
    own.write_text("# mine\n" + TEXT)
    slower = replace(ASSIGNMENT.lessons[0], text="# slower\n" + TEXT)
    later = replace(ASSIGNMENT, revision=2, lessons=(slower, *ASSIGNMENT.lessons[1:]))
    one, _ = take(written(tmp_path, assignment_bytes(later)), settings, NOW)
    assert own.read_text() == "# mine\n" + TEXT
    assert one.taken.lessons == (("three", "three-2"), ("four", "four"))
    assert own.with_name("three-2.toml").read_text() == slower.text


@pytest.mark.usefixtures("taken")
def test_a_later_version_of_another_teacher_is_told(settings: Settings, tmp_path: Path) -> None:
    other = replace(ASSIGNMENT, revision=2, teacher="Somebody")
    _, done = take(written(tmp_path, assignment_bytes(other)), settings, NOW)
    assert done == "version 2 takes the place of the one before; it is from Somebody, that was from Ms Okafor"


def test_lessons_have_a_sum() -> None:
    """Nine of 60 kB, each of which alone may be so long."""
    long = TEXT + "#" * 60_000 + "\n"
    lessons = tuple(AssignedLesson(f"x{number}", "x", long) for number in range(9))
    with pytest.raises(BadInput, match="x8: more than 524288 bytes up to here in the lessons of one file"):
        assignment_bytes(replace(ASSIGNMENT, lessons=lessons))

"""What is remembered between sessions: read back as it was, taken over from files, set aside if it cannot be read."""

import json
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import pytest

from station.core.settings import Settings
from station.drills.course import Course, CoursePart
from station.drills.daily.day_plan import daily_plan
from station.drills.library import find_lesson
from station.drills.mastery.mastery_json import SCHEMA, document_of, state_from
from station.drills.mastery.next_pass import new_item
from station.drills.mastery.practice_steps import item_of
from station.drills.mastery.reviews import Review
from station.practice.book.lesson_book import day_facts
from station.practice.headless.virtual_session import practise_adaptively
from station.practice.history.session_files import write_document
from station.practice.history.student_history import StudentHistory
from station.practice.records.assigned_lessons import Taken, assignments_folder, write_taken
from station.practice.records.memory import LevelMemory, Memory, Remembered
from station.practice.records.teachers_wishes import wishes_of
from station.practice.session.plan import PlanOptions
from station.scoring.matching.hit_windows import Level
from station.simulation.student_spec import parse_spec
from station.store.rows import MasteryRow
from tests.fakes.known_students import know, one_student, remember

TODAY = date(2026, 3, 1)
LESSON = find_lesson("rock-1")
STATE = new_item(item_of(LESSON), TODAY)


def memory(sessions: Path, lesson: str = "rock-1", bars: tuple[int, int] = (0, 1), name: str = "Anna B.") -> Memory:
    return Memory(one_student(sessions, name), lesson, bars)


def old_file(sessions: Path) -> Path:
    """Where the same was kept before there was a history."""
    folder = one_student(sessions, "Anna B.").folder / "mastery"
    folder.mkdir(parents=True, exist_ok=True)
    return folder / "rock-1_1-2.json"


def test_what_was_kept_is_recalled(tmp_path: Path) -> None:
    know(one_student(tmp_path, "Anna B."), STATE)
    assert memory(tmp_path).recall() == (STATE, None)
    assert memory(tmp_path, name="anna-b.").recall() == (STATE, None)
    assert memory(tmp_path, name="anna b").recall() == (None, None), "somebody else, whose name has no dot"


def test_every_student_lesson_and_loop_is_remembered_apart(tmp_path: Path) -> None:
    bar = replace(STATE, item=replace(STATE.item, bar_notes=(8,), bar_s=(2.0,)))
    know(one_student(tmp_path, "Anna B."), STATE, bar)
    assert memory(tmp_path).recall() == (STATE, None)
    assert memory(tmp_path, bars=bar.item.bars).recall() == (bar, None)
    assert memory(tmp_path, bars=(0, 3)).recall() == (None, None)
    assert memory(tmp_path, "rock-2").recall() == (None, None)
    assert memory(tmp_path, name="ben").recall() == (None, None)


def test_nothing_is_known_of_a_new_student(tmp_path: Path) -> None:
    assert memory(tmp_path).recall() == (None, None)


def test_what_lay_in_a_file_is_remembered_and_the_file_set_aside(tmp_path: Path) -> None:
    file = old_file(tmp_path)
    write_document(file, document_of(STATE))
    write_document(file.with_name("levels.json"), {"schema": "drum-station/levels/1", "levels": {"rock-1": "studio"}})
    assert memory(tmp_path).recall() == (STATE, None)
    assert LevelMemory(one_student(tmp_path, "Anna B.")).recall() == ({"rock-1": Level.STUDIO}, None)
    assert not file.exists()
    aside = file.parent.with_name("mastery-before-history")
    assert state_from(json.loads((aside / file.name).read_text()), "") == STATE


def test_what_the_history_knows_is_not_taken_back_by_a_file(tmp_path: Path) -> None:
    later = replace(STATE, today=TODAY + timedelta(days=1))
    know(one_student(tmp_path / "elsewhere", "Anna B."), later)
    write_document(old_file(tmp_path), document_of(STATE))
    assert memory(tmp_path).recall() == (later, None)


@pytest.mark.parametrize(
    "text", ["", "{", "[]", '{"schema": "drum-station/mastery/99"}', f'{{"schema": "{SCHEMA}", "item": {{}}}}', "\xff"]
)
def test_a_file_that_cannot_be_read_is_named_once_and_set_aside_whole(text: str, tmp_path: Path) -> None:
    file = old_file(tmp_path)
    file.write_bytes(text.encode("latin-1"))
    write_document(file.with_name("rock-2_1-2.json"), document_of(new_item(item_of(find_lesson("rock-2")), TODAY)))
    followed = Remembered.of(LESSON, PlanOptions(), TODAY, memory(tmp_path))
    assert followed.fault is not None
    assert str(file) in followed.fault
    assert "mastery-before-history" in followed.fault
    assert "\n" not in followed.fault
    remember(followed)
    assert (file.parent.with_name("mastery-before-history") / file.name).read_bytes() == text.encode("latin-1")
    assert memory(tmp_path).recall()[1] is None
    assert memory(tmp_path, "rock-2").recall()[0] is not None


def test_a_folder_that_cannot_be_renamed_costs_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = old_file(tmp_path)
    write_document(file, document_of(STATE))

    def refused(_self: Path, _target: Path) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "rename", refused)
    known, fault = memory(tmp_path).recall()
    assert known == STATE
    assert "Permission denied" in str(fault)
    assert file.exists()


def test_a_document_of_a_newer_station_is_set_aside_before_mastery_begins_anew(tmp_path: Path) -> None:
    whose = one_student(tmp_path, "Anna B.")
    whose.open().remember(whose.student, [MasteryRow("rock-1", 0, 1, '{"schema": "drum-station/mastery/99"}')])
    known, fault = memory(tmp_path).recall()
    assert known is None
    [kept] = (whose.folder / "mastery-unread").iterdir()
    assert str(kept) in str(fault)
    assert json.loads(kept.read_text()) == {"schema": "drum-station/mastery/99"}


def test_where_the_history_is_away_practice_begins_anew_and_says_so(tmp_path: Path) -> None:
    away = replace(Settings(), sessions=str(tmp_path), history=f"sqlite:///{tmp_path}/plain-file/history")
    (tmp_path / "plain-file").touch()
    followed = Remembered.of(LESSON, PlanOptions(), TODAY, Memory(StudentHistory.of(away), "rock-1", (0, 1)))
    assert followed.fault is not None
    assert not followed.learnt().on_top


def test_what_comes_next_is_chosen_among_all_that_is_remembered(tmp_path: Path) -> None:
    """Rock 1 is new and gone on with; rock 2, mastered and due, comes before it; a damaged row is no reason to fall."""
    followed = Remembered.of(LESSON, PlanOptions(), TODAY, memory(tmp_path))
    assert Remembered.of(LESSON, PlanOptions(), TODAY, None).next_turn() is None
    remember(followed)
    turn = followed.next_turn()
    assert turn is not None
    assert (turn.item.name, turn.why) == ("rock-1", "it is not stable yet, so stay with it")
    other = new_item(item_of(find_lesson("rock-2")), TODAY)
    whose = one_student(tmp_path, "Anna B.")
    know(whose, replace(other, review=Review(TODAY, 0, TODAY)))
    whose.open().remember(whose.student, [MasteryRow("rock-3", 0, 1, "{")])
    turn = followed.next_turn()
    assert turn is not None
    assert (turn.item.name, turn.why) == ("rock-2", "it is due for review")


def test_who_struggles_is_sent_to_what_comes_before(tmp_path: Path) -> None:
    """Every other stroke is missing, pass after pass; once rock 1 is mastered it is no reason any more."""
    lesson = replace(find_lesson("rock-3"), prerequisites=("rock-1",))
    followed = Remembered.of(lesson, PlanOptions(loops=2), TODAY, memory(tmp_path, "rock-3", lesson.loop, "Ben"))
    practise_adaptively(followed.adaptation, parse_spec("miss_pct=50,seed=1"))
    assert followed.adaptation.struggles
    turn = followed.next_turn()
    assert turn is not None
    assert turn.item.name == "rock-1"
    known = replace(STATE, review=Review(TODAY, 0, TODAY + timedelta(days=2)))
    know(one_student(tmp_path, "Ben"), known)
    turn = followed.next_turn()
    assert turn is not None
    assert turn.item.name == "rock-3"


def test_a_course_that_is_followed_goes_on_after_what_is_mastered(tmp_path: Path) -> None:
    """Ten passes at the pinned target, two of them blind: mastery (as in the levels' tests)."""
    course = Course("c", "Beats", "", "", 1, (CoursePart("", ("rock-1", "rock-4", "rock-2")),))
    options = PlanOptions(tempo_bpm=LESSON.target_tempo_bpm, loops=10, demonstrations=0)
    followed = Remembered.of(LESSON, options, TODAY, memory(tmp_path, name="Ada", bars=LESSON.loop), course)
    practise_adaptively(followed.adaptation, parse_spec("sd_ms=5,seed=1"))
    turn = followed.next_turn()
    assert turn is not None
    assert (turn.item.name, turn.why) == ("rock-4", "it comes next in Beats")


def test_what_a_teacher_wants_comes_next_until_it_is_stable_or_forgotten(tmp_path: Path) -> None:
    """Rock 5 is wanted in two days, rock 4 whenever; the report names rock 5, as the plan of the day does."""
    settings = replace(Settings(), sessions=str(tmp_path), student="Ann")
    wanted = ("rock-5", TODAY + timedelta(days=2)), ("rock-4", None), ("no-such", TODAY)
    for number, (name, due) in enumerate(wanted):
        taken = Taken(str(number), 1, "2026-11-01T12:00:00", ((name, name),), due=due)
        write_taken(assignments_folder(settings.sessions_dir, "Ann") / str(number), taken)

    def turn(day: date) -> tuple[str, str]:
        kept = Memory(StudentHistory.of(settings), "rock-1", LESSON.loop)
        followed = Remembered.of(LESSON, PlanOptions(), day, kept, None, wishes_of(settings, day))
        found = followed.next_turn()
        assert found is not None
        facts = day_facts(settings, day, assigned=wishes_of(settings, day).assigned)
        remember(followed)
        assert found.item.name == daily_plan(facts).items[1].lesson
        return found.item.name, found.why

    due = TODAY + timedelta(days=2)
    assert turn(TODAY) == ("rock-5", f"your teacher wants it by {due.day} {due:%B}")
    assert turn(due + timedelta(days=15)) == ("rock-4", "your teacher asked for it")

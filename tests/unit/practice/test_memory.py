"""What is remembered between sessions: read back as it was, set aside where it cannot be read, refused by the disk."""

import json
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import pytest

from station.core.errors import DeviceError
from station.core.settings import Settings
from station.drills.course import Course, CoursePart
from station.drills.daily.day_plan import daily_plan
from station.drills.library import find_lesson
from station.drills.mastery.mastery_json import SCHEMA
from station.drills.mastery.next_pass import new_item
from station.drills.mastery.practice_steps import item_of
from station.drills.mastery.reviews import Review
from station.practice.book.lesson_book import day_facts
from station.practice.headless.virtual_session import practise_adaptively
from station.practice.records.assigned_lessons import Taken, assignments_folder, write_taken
from station.practice.records.memory import Memory, Remembered
from station.practice.records.teachers_wishes import wishes_of
from station.practice.session.plan import PlanOptions
from station.simulation.student_spec import parse_spec

TODAY = date(2026, 3, 1)
LESSON = find_lesson("rock-1")
STATE = new_item(item_of(LESSON), TODAY)


def memory(sessions: Path) -> Memory:
    return Memory.of(sessions, "Anna B.", "rock-1", (0, 1))


def test_what_was_kept_is_recalled(tmp_path: Path) -> None:
    memory(tmp_path).keep(STATE)
    assert memory(tmp_path).recall() == (STATE, None)
    assert json.loads(memory(tmp_path).path.read_text())["schema"] == SCHEMA


def test_every_student_lesson_and_loop_has_a_file_of_its_own(tmp_path: Path) -> None:
    paths = {
        Memory.of(tmp_path, student, lesson, bars).path
        for student in ("anna", "ben")
        for lesson in ("rock-1", "rock-2")
        for bars in ((0, 1), (0, 3))
    }
    assert len(paths) == 8


def test_nothing_is_known_of_a_new_student(tmp_path: Path) -> None:
    assert memory(tmp_path).recall() == (None, None)


@pytest.mark.parametrize(
    "text", ["", "{", "[]", '{"schema": "drum-station/mastery/99"}', f'{{"schema": "{SCHEMA}", "item": {{}}}}', "\xff"]
)
def test_a_file_that_cannot_be_read_is_set_aside_whole(text: str, tmp_path: Path) -> None:
    file = memory(tmp_path).path
    file.parent.mkdir(parents=True)
    file.write_bytes(text.encode("latin-1"))
    remembered = Remembered.of(LESSON, PlanOptions(), TODAY, memory(tmp_path))
    assert remembered.fault is not None
    assert str(file) in remembered.fault
    assert "\n" not in remembered.fault
    remembered.keep()
    spare = file.with_name(f"{file.name}.unread-1")
    assert spare.read_bytes() == text.encode("latin-1")
    assert memory(tmp_path).recall()[1] is None


def test_a_second_bad_file_does_not_push_out_the_first(tmp_path: Path) -> None:
    for text in ("one", "two"):
        memory(tmp_path).path.parent.mkdir(parents=True, exist_ok=True)
        memory(tmp_path).path.write_text(text)
        memory(tmp_path).recall()
    kept = sorted(memory(tmp_path).path.parent.iterdir())
    assert [file.read_text() for file in kept] == ["one", "two"]


def test_a_folder_in_the_file_s_place_is_the_disk_s_fault(tmp_path: Path) -> None:
    memory(tmp_path).path.mkdir(parents=True)
    with pytest.raises(DeviceError, match=r"rock-1_1-2\.json"):
        memory(tmp_path).recall()


def test_what_comes_next_is_chosen_among_all_that_is_remembered(tmp_path: Path) -> None:
    """Rock 1 is new and gone on with; rock 2, mastered and due, comes before it; a broken file is no reason to fall."""
    remembered = Remembered.of(LESSON, PlanOptions(), TODAY, memory(tmp_path))
    assert Remembered.of(LESSON, PlanOptions(), TODAY, None).next_turn() is None
    remembered.keep()
    turn = remembered.next_turn()
    assert turn is not None
    assert (turn.item.name, turn.why) == ("rock-1", "it is not stable yet, so stay with it")
    other = new_item(item_of(find_lesson("rock-2")), TODAY)
    Memory.of(tmp_path, "Anna B.", "rock-2", (0, 1)).keep(replace(other, review=Review(TODAY, 0, TODAY)))
    Memory.of(tmp_path, "Anna B.", "rock-3", (0, 1)).path.write_text("{")
    turn = remembered.next_turn()
    assert turn is not None
    assert (turn.item.name, turn.why) == ("rock-2", "it is due for review")


def test_who_struggles_is_sent_to_what_comes_before(tmp_path: Path) -> None:
    """Every other stroke is missing, pass after pass; once rock 1 is mastered it is no reason any more."""
    lesson = replace(find_lesson("rock-3"), prerequisites=("rock-1",))
    followed = Remembered.of(lesson, PlanOptions(loops=2), TODAY, Memory.of(tmp_path, "Ben", "rock-3", lesson.loop))
    practise_adaptively(followed.adaptation, parse_spec("miss_pct=50,seed=1"))
    assert followed.adaptation.struggles
    turn = followed.next_turn()
    assert turn is not None
    assert turn.item.name == "rock-1"
    known = replace(STATE, review=Review(TODAY, 0, TODAY + timedelta(days=2)))
    Memory.of(tmp_path, "Ben", "rock-1", LESSON.loop).keep(known)
    turn = followed.next_turn()
    assert turn is not None
    assert turn.item.name == "rock-3"


def test_a_course_that_is_followed_goes_on_after_what_is_mastered(tmp_path: Path) -> None:
    """Ten passes at the pinned target, two of them blind: mastery (as in the levels' tests)."""
    course = Course("c", "Beats", "", "", 1, (CoursePart("", ("rock-1", "rock-4", "rock-2")),))
    options = PlanOptions(tempo_bpm=LESSON.target_tempo_bpm, loops=10, demonstrations=0)
    followed = Remembered.of(LESSON, options, TODAY, Memory.of(tmp_path, "Ada", "rock-1", LESSON.loop), course)
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
        kept = Memory.of(settings.sessions_dir, "Ann", "rock-1", LESSON.loop)
        followed = Remembered.of(LESSON, PlanOptions(), day, kept, None, wishes_of(settings, day))
        found = followed.next_turn()
        assert found is not None
        facts = day_facts(settings, day, assigned=wishes_of(settings, day).assigned)
        followed.keep()
        assert found.item.name == daily_plan(facts).items[1].lesson
        return found.item.name, found.why

    due = TODAY + timedelta(days=2)
    assert turn(TODAY) == ("rock-5", f"your teacher wants it by {due.day} {due:%B}")
    assert turn(due + timedelta(days=15)) == ("rock-4", "your teacher asked for it")

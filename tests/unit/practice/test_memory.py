"""What is remembered between sessions: read back as it was, set aside where it cannot be read, refused by the disk."""

import json
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest

from station.core.errors import DeviceError
from station.drills.library import find_lesson
from station.drills.mastery.mastery_json import SCHEMA
from station.drills.mastery.next_pass import new_item
from station.drills.mastery.practice_steps import item_of
from station.drills.mastery.reviews import Review
from station.practice.records.memory import Memory, Remembered
from station.practice.session.plan import PlanOptions

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

"""Each fault planted in a rich lesson is refused once, at its place, with what to do about it."""

import pytest

from station.drills.reading.lesson_file import parse_lesson
from tests.unit.drills.lesson_faults import FAULTS, GOOD, Planted


def planted(fault: Planted) -> tuple[str, int, int]:
    """The text with the fault in it, and the line and column of its mark."""
    assert GOOD.count(fault.old) == 1, "the place of the fault is sure"
    marked = GOOD.replace(fault.old, fault.new)
    before = marked[: marked.index("▶")]
    return marked.replace("▶", ""), before.count("\n") + 1, len(before) - before.rfind("\n")


def test_the_lesson_itself_has_no_fault() -> None:
    assert parse_lesson(GOOD, "rich.toml", "rich").faults == []


def test_there_are_as_many_as_promised() -> None:
    assert len(FAULTS) >= 60
    assert len({fault.new for fault in FAULTS}) == len(FAULTS)


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.new.splitlines()[-1])
def test_a_planted_fault_is_refused_once_at_its_place_with_the_remedy(fault: Planted) -> None:
    text, line, column = planted(fault)
    found = parse_lesson(text, "rich.toml", "rich").faults
    assert [(f.line, f.column) for f in found] == [(line, column)], [str(f) for f in found]
    assert fault.words in found[0].text

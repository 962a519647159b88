"""Human takes made lessons: every one of them is a lesson without fault that keeps what was played."""

from pathlib import Path

import pytest

from station.drills.reading.lesson_file import parse_lesson
from station.drills.transcription.transcribe import transcribe
from station.music.formats.format_table import read_part
from tests.real_data import real_files


@pytest.mark.parametrize("path", real_files("gmd/*/eval_session/*.mid"))
def test_what_people_played_becomes_a_lesson(path: Path) -> None:
    part = read_part(path)
    found = transcribe(part, "x", str(path)).lesson
    assert parse_lesson(found.text, "x", "x").faults == []
    assert found.score.bar_count in (part.score.bar_count, part.score.bar_count + 1)
    # Pressed ghost strokes bounce: several hits of a hand share a cell (up to 43 of 403 in these takes).
    assert int((~found.score.is_grace).sum()) + len(found.beyond) >= 0.88 * len(part.score)
    assert len(found.beyond) <= 0.1 * len(part.score)

"""Every shipped lesson comes back from what it is exported to as the table of the format promises."""

import pytest

from station.core.errors import BadInput
from station.drills.library import lessons_dir
from station.drills.reading.lesson_file import read_lesson
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart
from station.music.formats.groovescribe.groove_formats import GROOVESCRIBE
from station.music.formats.hydrogen.hydrogen_formats import HYDROGEN_PATTERN, HYDROGEN_SONG
from station.music.formats.music_format import MusicFormat
from tests.parts_alike import kept_differences


def lesson_parts() -> dict[str, DrumPart]:
    paths = [path for path in sorted(lessons_dir().rglob("*.toml")) if path.parent.name != "courses"]
    return {path.stem: part_of(read_lesson(path)) for path in paths}


@pytest.fixture(scope="module")
def parts() -> dict[str, DrumPart]:
    return lesson_parts()


@pytest.mark.parametrize(
    ("form", "most_refused"),
    [(GROOVESCRIBE, 6), (HYDROGEN_SONG, 0), (HYDROGEN_PATTERN, 0)],
    ids=lambda value: getattr(value, "name", ""),
)
def test_what_a_table_promises_is_kept_of_every_lesson(
    parts: dict[str, DrumPart], form: MusicFormat, most_refused: int
) -> None:
    """`most_refused`: lessons whose meter changes or whose fives and sevens have no place, counted by hand."""
    faults, refused = {}, 0
    for name, part in parts.items():
        try:
            if found := kept_differences(form, part):
                faults[name] = found
        except BadInput:
            refused += 1
    assert faults == {}
    assert refused <= most_refused

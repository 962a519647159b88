"""Every shipped lesson comes back from MIDI and from DTX as their tables promise."""

import pytest

from station.drills.writing.lesson_part import part_of
from station.music.formats.dtx.dtx_writer import DTX
from station.music.formats.music_format import MusicFormat
from station.music.formats.smf.midi_part import MIDI
from tests.parts_alike import kept_differences
from tests.shipped_lesson import shipped_lessons


@pytest.mark.parametrize("form", [MIDI, DTX], ids=lambda form: form.name)
def test_what_the_table_promises_is_kept_of_every_lesson(form: MusicFormat) -> None:
    parts = {lesson.name: part_of(lesson) for lesson in shipped_lessons()}
    assert {name: found for name, part in parts.items() if (found := kept_differences(form, part))} == {}

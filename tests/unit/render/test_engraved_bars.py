"""The engraved bars of a page: every note has its head, and the play line passes it when it sounds."""

from itertools import pairwise

import numpy as np
import pytest

from station.core.units import PPQ
from station.drills.library import find_lesson
from station.practice.session.plan import PlanOptions, plan_practice
from station.render.notation.staff import height, step_of
from station.render.report.page.engraved_bars import _SIGNS, BarsSetter, EngravedLine
from station.render.report.page.session_page import JudgedBars, NotePasses, NoteState
from station.render.text.draw_list import ShapeKind
from station.render.text.paper import OutlineAtlas

LESSONS = (
    "rock-1", "six-eight-fill-1", "shuffle-1", "hip-hop-1", "flam-fill-1", "train-2", "second-line-fill-1", "trap-1",
    "funk-1", "rock-song-1", "jazz-comping-1", "double-kick-triplets-1", "five-four-1",
)  # fmt: skip
"""Grooves, fills, swing of both kinds, flams, drags, press rolls, ghosts, triplets, and an odd meter."""

_WORDS_FROM = -6.0
"""Higher up the sign of a swing is made of heads too."""
_ASIDE = 1.75
"""A head may stand a head and a half beside its time, on the far side of a stem."""


def judged(name: str) -> JudgedBars:
    lesson = find_lesson(name)
    section = plan_practice(lesson, PlanOptions(loops=1, demonstrations=0)).section
    notes = tuple(NotePasses("snare", NoteState.MATCH, 1, 1) for _ in range(len(section)))
    return JudgedBars(section, notes, 1, (), lesson.beats_a_minute, lesson.beat_ticks, 25.0, 1)


def engraved(name: str, width: float = 46.0) -> tuple[JudgedBars, list[EngravedLine], OutlineAtlas]:
    bars, atlas = judged(name), OutlineAtlas()
    return bars, BarsSetter(bars, atlas).lines(width), atlas


@pytest.mark.parametrize("name", LESSONS)
def test_every_note_has_one_head_of_its_piece(name: str) -> None:
    bars, lines, atlas = engraved(name)
    notes = [note for line in lines for note in line.notes]
    assert sorted(note.index for note in notes) == [*range(len(bars.section))]
    for note in notes:
        assert note.y == pytest.approx(height(step_of(bars.section[note.index].piece)), abs=0.01)
    numbers = [int(atlas.sign(sign).uv[0]) for sign in _SIGNS]
    for line in lines:
        glyphs = line.ground[line.ground["kind"] == ShapeKind.GLYPH]
        on_staff = glyphs[glyphs["centre"][:, 1] > _WORDS_FROM]
        assert not np.isin(np.rint(on_staff["uv"][:, 0]), numbers).any(), "a head that belongs to nobody"


@pytest.mark.parametrize("name", LESSONS)
def test_the_play_line_passes_a_head_when_it_sounds(name: str) -> None:
    bars, lines, _ = engraved(name)
    for line in lines:
        ticks, xs = np.array(line.places).T
        assert (np.diff(ticks) > 0).all()
        assert (np.diff(xs) > 0).all()
        assert xs[-1] <= line.width + 1e-6
        for note in line.notes:
            written = bars.section[note.index]
            if not written.lead_ms and len(note.head):
                assert float(np.interp(written.tick, ticks, xs)) == pytest.approx(note.x, abs=_ASIDE)


def test_lines_follow_each_other_without_a_hole() -> None:
    bars, lines, _ = engraved("rock-song-1")
    assert len(lines) > 1
    assert lines[0].places[0][0] == 0
    assert lines[-1].places[-1][0] == bars.section.end_tick
    for before, after in pairwise(lines):
        assert before.places[-1][0] == after.places[0][0]


def test_a_wider_page_has_fewer_lines() -> None:
    narrow, wide = (engraved("rock-song-1", width)[1] for width in (46.0, 100.0))
    assert len(wide) < len(narrow)
    assert {note.index for line in wide for note in line.notes} == {n.index for line in narrow for n in line.notes}


def test_a_swung_eighth_sounds_after_the_middle_of_its_beat() -> None:
    """In a shuffle the second eighth stands halfway and sounds at two thirds."""
    _, (line, *_), _ = engraved("shuffle-1")
    assert [tick for tick, _ in line.places[:3]] == [0, PPQ * 2 // 3, PPQ]

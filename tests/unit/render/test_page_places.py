"""A page of notation that can be pointed at: what is drawn has a place, and the place says what is drawn there."""

from itertools import pairwise

import numpy as np
import pytest

from station.core.pieces import Limb, Piece, word
from station.core.units import PPQ
from station.drills.editing.lesson_edits import LineAt
from station.drills.editing.written_music import WrittenMusic, written_music
from station.drills.library import lesson_names
from station.render.notation.page.editable_page import EditablePage
from station.render.notation.page.page_places import pieces_on
from station.render.notation.staff import PLACES, step_of
from station.render.text.paper import OutlineAtlas
from station.scenes.draft_notation import page_setter
from tests.shipped_lesson import shipped_lesson

ATLAS = OutlineAtlas()
ROCK = """
title = "Rock"
tempo_bpm = 90

[grid]
hihat = "| x-x-x-x- x-x-x-x- |"
snare = "| ----o--- ----o--- |"
kick  = "| o------- o-o----- |"
"""
PARTS = 5


def page_of(text: str, width: float = 60.0) -> tuple[WrittenMusic, EditablePage]:
    music = written_music(text)
    assert music is not None
    return music, page_setter(music, ATLAS).page(width)


@pytest.mark.parametrize("part", range(PARTS))
def test_every_head_of_the_shipped_lessons_says_its_tick_its_piece_and_its_line(part: int) -> None:
    for name in lesson_names()[part::PARTS]:
        music, page = page_of(shipped_lesson(name).text)
        starts = [music.score.tempo_map.bar_start(bar) for bar in range(music.score.bar_count)]
        for line in page.places.lines:
            bars = {place.bar: place for place in line.bars}
            for head in line.heads:
                found = line.head_at(head.x, head.y)
                assert found is not None, name
                assert (found.tick, found.piece) == (head.tick, head.piece), name
                assert line.step_at(head.y) == step_of(head.piece), name
                assert page.places.line_at(head.y) is line, name
                at = head.tick - starts[head.bar]
                assert bars[head.bar].tick_at(bars[head.bar].x_at(at)) == pytest.approx(at, abs=0.5), name
                assert (head.tick, head.piece) in music.lines, name


@pytest.mark.parametrize("part", range(PARTS))
def test_no_stroke_of_the_shipped_lessons_is_without_a_head(part: int) -> None:
    for name in lesson_names()[part::PARTS]:
        music, page = page_of(shipped_lesson(name).text)
        heads = {(head.tick, head.piece) for line in page.places.lines for head in line.heads}
        assert heads == set(music.lines), name


@pytest.mark.parametrize("piece", PLACES)
def test_each_piece_is_written_where_it_stands(piece: Piece) -> None:
    letter = "o" if piece in {Piece.KICK, Piece.SNARE} or "tom" in word(piece) else "x"
    _, page = page_of(f'title = "One"\n[grid]\n{word(piece)} = "{letter}---"\n')
    (line,) = page.places.lines
    (head,) = line.heads
    assert (head.tick, head.piece) == (0, piece)
    assert pieces_on(line.step_at(head.y), [piece])[0] is piece


def test_an_empty_place_says_the_nearest_moment_and_the_line_of_the_staff() -> None:
    _, page = page_of(ROCK)
    (line,) = page.places.lines
    (bar,) = line.bars
    offbeat = bar.x_at(1.5 * PPQ)
    assert line.head_at(offbeat, line.y_of(step_of(Piece.SNARE))) is None
    assert bar.tick_at(offbeat + 0.2) == pytest.approx(1.5 * PPQ, abs=PPQ / 8)
    assert pieces_on(line.step_at(line.y_of(5) + 0.2)) == (Piece.SNARE, Piece.CLAP)


def test_what_a_click_on_a_head_means_is_the_line_that_wrote_it() -> None:
    music, _ = page_of(
        'title = "Hands"\n[[grid]]\nname = "A"\nright_hand.hihat = "xxxx"\nsnare = "-o-o"\n'
        '[[grid]]\nlike = "A"\nsnare = "oooo"\n'
    )
    assert music.lines[(0, Piece.HIHAT)] == LineAt(0, Piece.HIHAT, Limb.RIGHT_HAND)
    assert music.lines[(PPQ, Piece.SNARE)] == LineAt(0, Piece.SNARE)
    assert music.lines[(4 * PPQ, Piece.SNARE)] == LineAt(1, Piece.SNARE)
    assert music.lines[(4 * PPQ, Piece.HIHAT)] == LineAt(1, Piece.HIHAT, Limb.RIGHT_HAND)


def test_ticks_are_those_that_the_text_has_under_a_swing_too() -> None:
    music, page = page_of('title = "S"\nswing_ratio = 2\n[grid]\nride = "xxxxxxxx"\n')
    heads = [head.tick for line in page.places.lines for head in line.heads]
    assert heads == [k * PPQ // 2 for k in range(8)]
    assert music.score.notes["tick"][1] == round(PPQ * 2 / 3)


def test_a_repeated_grid_stands_once_and_says_how_often() -> None:
    grids = '[[grid]]\nname = "A"\ntimes = 3\nsnare = "oooo"\n[[grid]]\nname = "B"\nsnare = "o---"\n'
    text = f'title = "R"\nform = "A, B, A"\n{grids}'
    music, page = page_of(text)
    assert [place.bar for line in page.places.lines for place in line.bars] == [0, 1]
    assert [(place.grid, place.bar) for place in music.bars] == [(0, 0), (1, 0)]
    assert (music.grids[0].times, music.grids[0].name) == (3, "A")


def test_an_empty_bar_has_a_place_for_each_half_beat() -> None:
    _, page = page_of('title = "E"\n[grid]\nsnare = "| o--- | ---- |"\n')
    bar = page.places.lines[0].bars[1]
    xs = [bar.x_at(k * PPQ / 2) for k in range(8)]
    assert min(np.diff(xs)) > 1.5


def test_lines_are_no_wider_than_asked_and_lie_below_each_other() -> None:
    _, page = page_of(shipped_lesson("bembe-fill-1").text, 40.0)
    lines = page.places.lines
    assert len(lines) > 1
    assert all(line.bars[-1].right <= 40.0 + 1e-6 for line in lines)
    assert all(a.bottom <= b.top for a, b in pairwise(lines))
    assert lines[-1].bottom <= page.height


def test_a_text_at_fault_shows_what_of_it_can_be_read() -> None:
    music, page = page_of('title = "F"\n[grid]\nsnare = "| o-o- | o-o | oooo |"\nkick = "| o--- | o--- | o--- |"\n')
    struck = [(head.bar, head.piece) for line in page.places.lines for head in line.heads]
    assert struck.count((1, Piece.SNARE)) == 0
    assert struck.count((1, Piece.KICK)) == 1
    assert struck.count((2, Piece.SNARE)) == 4
    assert music.score.bar_count == 3


def test_no_music_where_there_is_none() -> None:
    assert written_music("this is no lesson") is None
    assert written_music('title = "nothing"') is None


def test_a_page_is_drawn_where_it_is_pointed_at() -> None:
    """The drawn head's middle, in the shapes that the screen gets, is the place of that head."""
    _, page = page_of(ROCK)
    kick = next(h for h in page.places.lines[0].heads if h.piece is Piece.KICK and h.tick == 0)
    centres = page.shapes["centre"]
    assert np.hypot(centres[:, 0] - kick.x, centres[:, 1] - kick.y).min() < 0.02

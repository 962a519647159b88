"""Laws of editing: what is set stands there, nothing else changes, comments stay, and a sound text stays sound."""

import re
import tomllib
from contextlib import suppress
from functools import cache
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.toml.toml_write import toml_value
from station.core.units import PPQ
from station.drills.editing.edit_lesson import edited
from station.drills.editing.grid_page import GridPage
from station.drills.editing.lesson_edits import (
    REST,
    AddBars,
    AddGrid,
    AddLine,
    CopyBars,
    CutBeat,
    LessonEdit,
    LineAt,
    RemoveBars,
    RemoveGrid,
    SetKey,
    SetSign,
    SetStroke,
    TextLine,
)
from station.drills.editing.page_reader import page_of
from station.drills.reading.lesson_file import parse_lesson
from tests.property.test_grids import grids, keys, values
from tests.property.test_lesson_text import text_of
from tests.unit.drills.editing.random_edits import random_edit, random_stroke

PLAYABILITY = re.compile(
    "hands? needed|needs one hand|too fast|people need|places|plays nothing|nothing to play|feet needed|while the foot"
)
"""Words of faults that an edit may bring: what people cannot play, and that nothing is left to play."""
COUNT = re.compile(r"#[ ]{2,}1[\d&.·a-z ]*")
LESSONS = sorted(path for path in Path("lessons").glob("*/*.toml") if path.parent.name != "courses")

ODD = """\
title = "Odd" # one
meter = ["4/4", "4/4", "3+2+2/8"] # two
loop = [2, 3]
form = "A, (B, A) x2"
# three
[goals]
min_accuracy = 0.9
[[goals.bars]] # four
bars = [3, 4]
min_accuracy = 0.95

[[grid]] # five
name = "A"
at = [{bar = 1, say = "one"}, {bar = 2, say = "two"}] # six
hihat = "xxxx (xxx) xx | % | (xxx)xx-x"
snare = \"\"\"
| --o- | (-)-(z~)b |
| ~~-o--- |
\"\"\" # seven
left_hand.tom_1 = "-|-----o--|-------"
sticking = "R-------|R------L|-------"
loudness = "p<<<<<<<|<<<<<<<f|-------"
# eight
[[grid.cycle]]
meter = "3/8" # nine
hihat_pedal = "x-x"
[[grid]]
name = "B"
like = "A"
kick = "o---|o-oo|o------" # ten
[[grid]]
ending = 2
crash = "X-#-"
[grid.right_hand]
tom_2 = "--o-" # eleven
"""
WORDS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven")


@cache
def texts() -> tuple[str, ...]:
    """Every fifth shipped lesson, and one with all that the format has odd ways for."""
    return (ODD, *(path.read_text("utf-8") for path in LESSONS[::5]))


any_text = st.deferred(lambda: st.sampled_from(texts())) | grids().map(text_of)
seeds = st.integers(0, 2**32)


def faults(text: str) -> list[str]:
    """What is wrong in a text but for what nobody can play."""
    return [fault.text for fault in parse_lesson(text, "x", "x").faults if not PLAYABILITY.search(fault.text)]


def comments(text: str) -> list[str]:
    """The comments of a text that are no counts."""
    found = re.findall(r"#[^\n\"]*$", text, re.MULTILINE)
    return [comment for comment in found if not COUNT.fullmatch(comment.rstrip())]


class Place(NamedTuple):
    """Where a stroke stands."""

    grid: int
    line: LineAt
    bar: int
    tick: int


def strokes(page: GridPage) -> dict[Place, str]:
    """Every letter that strikes, by its place."""
    return {
        Place(number, line.at, bar, cell.tick): cell.letter
        for number, grid in enumerate(page.grids)
        for line in grid.lines
        if isinstance(line.at, LineAt)
        for bar, each in enumerate(line.bars)
        for cell in each.cells
        if cell.letter not in "-~#"
    }


def test_the_texts_are_sound() -> None:
    assert [faults(text) for text in texts() if faults(text)] == []
    assert comments(ODD) == [f"# {word}" for word in WORDS]


@given(any_text, seeds)
@settings(deadline=None, max_examples=50)
def test_what_is_set_stands_there_and_nothing_else_changes(text: str, seed: int) -> None:
    page = page_of(text)
    grid = Random(seed).randrange(len(page.grids))
    assume(page.grids[grid].swing_ratio == 1)  # a swung stroke beside a new (…) stands where it is heard
    edit = random_stroke(Random(seed), page, grid)
    with suppress(BadInput):
        now = page_of(edited(text, edit))
        before, after = strokes(page), strokes(now)
        line = next((each for each in now.grids[grid].lines if each.at == edit.line), None)
        found = [cell.letter for cell in line.bars[edit.bar].cells if cell.tick == edit.tick] if line else []
        assert found in ([edit.letter], [] if edit.letter == REST else [edit.letter])
        changed = {key for key in before | after if before.get(key) != after.get(key)}
        assert {(place.line.piece, place.tick) for place in changed} <= {(edit.line.piece, edit.tick)}
        assert edited(edited(text, edit), edit) == edited(text, edit)


@given(any_text, seeds)
@settings(deadline=None, max_examples=30)
def test_setting_and_erasing_is_the_same_music(text: str, seed: int) -> None:
    page = page_of(text)
    grid = Random(seed).randrange(len(page.grids))
    edit = random_stroke(Random(seed), page, grid)
    assume(edit.letter not in "-~#" and page.grids[grid].swing_ratio == 1)
    before = strokes(page)
    assume(all((place.line.piece, place.tick) != (edit.line.piece, edit.tick) for place in before))
    with suppress(BadInput):
        there = edited(text, edit)
        again = edited(there, SetStroke(edit.line, edit.bar, edit.tick, REST))
        assert strokes(page_of(again)) == before
        assert comments(again) == comments(text)


@pytest.mark.parametrize("seed", range(6))
def test_a_sound_text_stays_sound_and_keeps_its_comments(seed: int) -> None:
    random = Random(seed)
    text = ODD if seed % 3 == 0 else random.choice(texts())
    for _ in range(40):
        page = page_of(text)
        edit = random_edit(random, page)
        with suppress(BadInput):
            new = edited(text, edit)
            assert faults(new) == [], (edit, text)
            assert page_of(new).grids
            if isinstance(edit, SetStroke | AddBars):
                assert comments(new) == comments(text)
            text = new


@given(any_text, seeds)
@settings(deadline=None, max_examples=25)
def test_new_bars_taken_away_again_leave_the_music_and_its_numbers(text: str, seed: int) -> None:
    random = Random(seed)
    page = page_of(text)
    grid = random.randrange(len(page.grids))
    at = random.randint(0, page.grids[grid].bar_count)
    with suppress(BadInput):
        longer = edited(text, AddBars(grid, at, 2))
        again = edited(longer, RemoveBars(grid, at, at + 1))
        assert page_of(longer).grids[grid].bar_count == page.grids[grid].bar_count + 2
        assert strokes(page_of(again)) == strokes(page)
        one, other = (parse_lesson(each, "x", "x").lesson for each in (text, again))
        if one and other:
            assert (one.loop, one.goals.bars, one.cues) == (other.loop, other.goals.bars, other.cues)


@given(any_text, st.sampled_from(["title", "about", "author"]), st.text(min_size=1))
@settings(deadline=None, max_examples=25)
def test_a_key_says_what_was_set_and_is_gone_again(text: str, key: str, value: str) -> None:
    there = edited(text, SetKey((key,), value))
    assert tomllib.loads(there)[key] == value
    assert comments(there) == comments(text)
    assert strokes(page_of(there)) == strokes(page_of(text))
    assert edited(there, SetKey((key,), None)).count("\n") <= there.count("\n")


@given(st.dictionaries(keys, values, max_size=6) | values, seeds)
@settings(deadline=None, max_examples=150)
def test_no_text_is_too_strange_for_a_page_or_an_edit(table: object, seed: int) -> None:
    """Every text is shown, and every edit of it is made, or refused in a sentence; what comes out is TOML."""
    random = Random(seed)
    text = text_with(table)
    for _ in range(4):
        page = page_of(text)
        with suppress(BadInput):
            text = edited(text, strange_edit(random, page))
            tomllib.loads(text)


def text_with(table: object) -> str:
    """A text whose grid is the value, if TOML can say it."""
    with suppress(TypeError, ValueError):
        text = f'title = "T"\ngrid = {toml_value(table)}\n'
        tomllib.loads(text)
        return text
    return 'title = "T"\n'


def strange_edit(random: Random, page: GridPage) -> LessonEdit:
    """An edit of what the page shows, or of what is not there."""
    grid = random.randrange(3)
    line = LineAt(grid, random.choice((Piece.SNARE, Piece.KICK)), cycle=random.choice((None, None, 0, 1)))
    usual = [random_edit(random, page)] if page.grids and all(each.frames and each.lines for each in page.grids) else []
    return random.choice(
        [
            *usual,
            SetStroke(line, random.randrange(3), random.randrange(5) * PPQ, "o"),
            SetSign(grid, random.choice(list(TextLine)), 0, 0, "R"),
            CutBeat(grid, 0, 0, 3),
            AddLine(line),
            AddBars(grid, random.randrange(3)),
            RemoveBars(grid, 0, 0),
            CopyBars(grid, 0, 0, random.randrange(2), 0, random.random() < 0.5),
            AddGrid("New", grid, random.choice((None, 0))),
            RemoveGrid(grid),
            SetKey(("grid", grid, random.choice(("snare", "at", "times"))), random.choice((None, 3, "o---"))),
            SetKey(("goals", "bars", random.randrange(2), "bars"), [1, 2]),
        ]
    )

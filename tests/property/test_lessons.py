"""Lessons: any grid survives being written and read, any text is read without a traceback."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from random import Random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.core.pieces import Piece, word
from station.core.toml.toml_places import Places
from station.core.units import PPQ
from station.drills.grid.grid import GridFrame, parse_line
from station.drills.grid.tab_symbols import LINE_PIECES, SYMBOLS, family_of
from station.drills.lesson import Lesson
from station.drills.reading.lesson_fields import FIELDS
from station.drills.reading.lesson_file import parse_lesson
from station.drills.transcription.transcribe import transcribe
from station.drills.writing.lesson_text import show
from station.drills.writing.lesson_writer import write_lesson
from station.drills.writing.score_difference import score_difference
from station.music.drum_part import DrumPart
from station.music.score import Note, Score
from station.music.swing import MAX_RATIO, Swing
from station.music.tempo import MeterChange, TempoMap
from tests.same_lesson import first_difference

COMMON = MeterChange(0, 4, 4)
METERS = ("4/4", "3/4", "2/4", "5/4", "6/8", "12/8", "7/8", "2/2", "3+2+2/8", "2+3/4")
PIECES = (Piece.SNARE, Piece.HIHAT, Piece.RIDE, Piece.CRASH_1, Piece.TOM_1, Piece.KICK, Piece.HIHAT_PEDAL)


@st.composite
def bars(draw: st.DrawFn, piece: Piece, groups: list[int]) -> str:
    """One bar of a line: plain cells, some beats or groups in parentheses."""
    letters = "--" + "".join(SYMBOLS[family_of(piece)]) + ("#" if piece is Piece.CRASH_1 else "")
    letters += "~" if piece is Piece.SNARE else ""
    cells = draw(st.sampled_from((1, 2, 3, 4)))
    out = ""
    for beats in groups:
        tuplet = draw(st.integers(0, 5)) == 0
        count = draw(st.sampled_from((3, 5, 6, 9, 14))) if tuplet else cells * beats
        beat = draw(st.text(letters, min_size=count, max_size=count))
        out += f"({beat})" if tuplet else f"{beat} "
    return out


@st.composite
def lessons(draw: st.DrawFn) -> Lesson:
    """Any lesson that the grid can say and that two hands and two feet can play."""
    meter = draw(st.sampled_from(METERS))
    top, unit = meter.split("/")
    groups = [int(group) for group in top.split("+")] if "+" in top else [1] * int(top)
    head = [
        'title = "T"',
        f"tempo_bpm = {draw(st.sampled_from((40, 61.5, 90)))}",
        f'meter = "{meter}"',
        f'beat = "1/{unit}"',
        f"swing_ratio = {draw(st.sampled_from((1.0, 1.5, 2.0, 3.0)))}",
        f'swing_unit = "1/{16 if unit == "8" else draw(st.sampled_from((8, 16)))}"',
    ]
    grids = []
    for _ in range(draw(st.integers(1, 2))):
        chosen = draw(st.sets(st.sampled_from(PIECES), min_size=1, max_size=4))
        count = draw(st.integers(1, 3))
        lines = [f'{word(p)} = "{"|".join(draw(bars(p, groups)) for _ in range(count))}"' for p in sorted(chosen)]
        grids.append("\n".join(["[[grid]]", *lines]))
    reading = parse_lesson("\n".join([*head, *grids]), "t", "t")
    assume(reading.lesson is not None)
    assert reading.lesson
    return reading.lesson


@given(lessons())
@settings(deadline=None, max_examples=60)
def test_written_and_read_again_a_lesson_is_the_same(lesson: Lesson) -> None:
    again = parse_lesson(write_lesson(lesson), "t", "t").lesson
    assert again
    assert score_difference(lesson.score, again.score) == ""
    assert again.sections == lesson.sections
    assert again.beats_a_minute == lesson.beats_a_minute


def _messy(row: str, random: Random) -> str:
    """A row of a text with blanks among the cells of a line, and perhaps a comment below it."""
    key, is_pair, value = row.partition(" = ")
    if "|" in value:
        value = "".join(f"{char}{' ' * random.choice((0, 0, 0, 3)) if char in 'oxg-|' else ''}" for char in value)
    return key + is_pair + value + random.choice(("", "", "# why\n"))


@given(lessons(), st.randoms(use_true_random=False))
@settings(deadline=None, max_examples=60)
def test_shown_a_lesson_is_the_same_and_shown_again_nothing_changes(lesson: Lesson, random: Random) -> None:
    """However its blanks lie, and with comments between its lines."""
    messy = "".join(_messy(row, random) for row in lesson.text.splitlines(keepends=True))
    read = parse_lesson(messy, "t", "t").lesson
    assert read
    text = show(messy)
    again = parse_lesson(text, "t", "t").lesson
    assert again
    assert first_difference(read, again) == ""
    assert show(text) == text
    assert text.count("# why") == messy.count("# why")


words = st.text(max_size=40).filter(str.isprintable)


@given(words)
@settings(deadline=None)
def test_a_title_survives(title: str) -> None:
    base = parse_lesson('title = "T"\n[grid]\nsnare = "o"', "t", "t").lesson
    assert base
    lesson = replace(base, title=" ".join(title.split()).strip() or "T")
    again = parse_lesson(write_lesson(lesson), "t", "t").lesson
    assert again
    assert again.title == lesson.title


hand_notes = st.builds(
    Note,
    tick=st.integers(0, 8 * PPQ - 1),
    piece=st.sampled_from((Piece.SNARE, Piece.HIHAT, Piece.RIDE, Piece.KICK, Piece.PERCUSSION)),
    velocity=st.integers(1, 127),
)


@given(st.lists(hand_notes, min_size=1, max_size=25))
@settings(deadline=None, max_examples=10)
def test_whatever_is_played_slowly_fits_the_grid(played: list[Note]) -> None:
    score = Score.from_notes(played, TempoMap.constant(20))
    found = transcribe(DrumPart(score), "x")
    again = parse_lesson(found.lesson.text, "x", "x").lesson
    assert again
    assert score_difference(again.score, found.lesson.score) == ""
    assert 1 <= len(again.score) + len(again.beyond) <= 3 * len(score)  # a drag has two grace strokes


@given(st.integers(1, 40), st.sampled_from((2, 3, 4, 5, 6, 7, 12)), st.sampled_from((4, 8)))
def test_cells_share_the_bar_equally(count: int, beats: int, unit: int) -> None:
    """Against exact fractions: a bar that is accepted is covered by equal cells without a gap, to the nearest tick."""
    told: list[str] = []
    frame = GridFrame(MeterChange(0, beats, unit), PPQ)
    (bar,) = parse_line("o" * count, [frame], lambda _, text: told.append(text))
    assert bool(bar.cells) is (count % beats == 0 or beats % count == 0)
    assert bool(told) is not bool(bar.cells)
    edges = [round(Fraction(i * beats * 4 * PPQ, unit * count)) for i in range(count + 1)]
    assert [(c.tick, c.tick + c.length_ticks) for c in bar.cells] in ([], list(pairwise(edges)))


@given(st.floats(1, MAX_RATIO), st.lists(st.integers(0, 4 * PPQ), min_size=2, max_size=20), st.sampled_from((2, 4, 8)))
def test_swing_keeps_order_and_the_beats(ratio: float, ticks: list[int], cut: int) -> None:
    swing = Swing(ratio, PPQ // cut)
    ordered = sorted(ticks)
    played = [swing.swung(t, COMMON) for t in ordered]
    assert played == sorted(played)
    assert all(swing.swung(b * PPQ, COMMON) == b * PPQ for b in range(5))
    assert all(p >= t for p, t in zip(played, ordered, strict=True))


pieces_of_files = st.sampled_from(
    [
        *('"', "'", '"""', "[", "]", "[[grid]]", "[grid]", "=", "\n", "\n", "#", "{", "}", ",", "\\", " ", "é", "\x00"),
        *("loudness", "bars", "[[grid.cycle]]", "[landing]", "[graces]", '"3+2/8"', "mf-<-f", "[[grid]]\nlike = "),
        *("snare", "sticking", "right_hand.", "o-o-", "(", ")", "|", "%", "%3", "~", "RLB", "1.5", "-7", "true", "1/4"),
        *FIELDS,
        *list(LINE_PIECES)[:6],
    ]
)


@given(st.lists(pieces_of_files, max_size=40))
@settings(deadline=None, max_examples=300)
def test_no_text_is_too_strange(parts: list[str]) -> None:
    text = "".join(parts)
    reading = parse_lesson(text, "t", "t")
    assert (reading.lesson is None) is bool(reading.faults)
    lines = text.replace("\r\n", "\n").split("\n")
    for fault in reading.faults:
        assert 1 <= fault.line <= len(lines)
        assert 1 <= fault.column <= len(lines[fault.line - 1]) + 1


LESSON = """title = "T"
tempo_bpm = 60
loop = [1, 2]
[dynamics]
ghost = 30
[[grid]]
hihat    = "| xxxx (-xx) xxxx ---- | % |"
snare    = "| ---- f---  ---- b~~~ | - |"
sticking = "| R--- L--- R--- L--- | - |"
loudness = "| p--- <--- ---- ---f | - |"
[[grid]]
meter = ["3+2+2/8", "4/4"]
tempo_to_bpm = 50
left_hand.tom_1 = "oov ww (ooooooooo) | oo"
[[grid.cycle]]
meter = "5/8"
kick = "o--o-"
[grid.graces]
flam_ms = 20
[landing]
crash = "X"
"""


def test_the_lesson_is_sound() -> None:
    assert parse_lesson(LESSON, "t", "t").faults == []


@given(st.integers(0, len(LESSON) - 1), pieces_of_files | st.just(""))
@settings(deadline=None, max_examples=200)
def test_a_slip_of_the_finger_is_a_fault_with_a_place_or_harmless(at: int, slip: str) -> None:
    reading = parse_lesson(LESSON[:at] + slip + LESSON[at + 1 :], "t", "t")
    for fault in reading.faults:
        assert fault.line >= 1
        assert fault.column >= 1
        assert fault.text


@given(st.lists(st.tuples(st.sampled_from(("a", "b-c", '"d e"', "'f'")), words), max_size=5, unique_by=lambda p: p[0]))
def test_places_point_at_the_values(pairs: list[tuple[str, str]]) -> None:
    lines = [f"{key} = {_literal(value)} # note" for key, value in pairs]
    places = Places.of("\n".join(lines))
    for number, (key, _) in enumerate(pairs, 1):
        line, column = places.find((key.strip("'\""),))
        assert line == number
        assert column == len(key) + 4


def _literal(text: str) -> str:
    return '"' + "".join(c if c.isalnum() and ord(c) > 31 else f"\\U{ord(c):08X}" for c in text if not _lone(c)) + '"'


def _lone(char: str) -> bool:
    return 0xD800 <= ord(char) <= 0xDFFF


def test_bad_input_is_what_writers_raise() -> None:
    lesson = parse_lesson('title = "T"\n[grid]\nsnare = "o"', "t", "t").lesson
    assert lesson
    rows = lesson.score.notes.copy()
    rows["velocity"] = 3
    with pytest.raises(BadInput, match="velocity 3 became 80"):
        write_lesson(replace(lesson, score=Score.from_array(rows, lesson.score.tempo_map)))

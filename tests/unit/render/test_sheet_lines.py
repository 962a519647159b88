"""A sheet's bars and lines: room measured by hand, lines justified, folds as a copyist marks them."""

from itertools import pairwise

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.music.repeats import Passage, folded
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoMap
from station.render.notation.bar_lines import BarLine, Volta
from station.render.notation.engraving import Engraver
from station.render.notation.page.bar_columns import BarColumns, bar_columns, force_to
from station.render.notation.page.line_breaks import SetBar, lines
from station.render.notation.page.sheet_bars import number_words, sheet_bars
from station.render.notation.sheet_words import LineWord, draw_words
from station.render.notation.skyline import Skyline
from station.render.palette import INK
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, ShapeKind
from tests.unit.render.scores import BAR, rock, score_of

ATLAS = Atlas()


# --- columns ----------------------------------------------------------------------------------------------------------


def columns_of(*times_s: float, half: float = 0.5, length_s: float = 4.0, y: float = 0.0) -> BarColumns:
    """Discs at times of a bar at a quarter a second."""
    draw_list = DrawList(ATLAS)
    for time_s in times_s:
        draw_list.time_s = time_s
        draw_list.ellipse((0.0, 0.0), (0.5, 0.5), INK)
        draw_list.ellipse((0.0, y), (half, 0.5), INK)
    return bar_columns(draw_list.shapes(), length_s, lambda t: np.rint(t * PPQ).astype(np.int64))


def test_a_value_twice_as_long_takes_as_much_more_each_time() -> None:
    columns = columns_of(0.0, 0.5, 1.5, 3.5, length_s=4.0)
    eighth, quarter, half, last = columns.ease.tolist()
    assert quarter / eighth == pytest.approx(half / quarter)
    assert last == pytest.approx(eighth)
    assert 1.4 < quarter / eighth < 1.6, "more room for more time, yet not as much more"


def test_neighbours_keep_their_distance_where_they_are_level_and_only_there() -> None:
    """Discs a space wide are a space and a quarter apart; wider ones below keep twice their half width."""
    assert columns_of(0.0, 1.0).least[0] == pytest.approx(1.25)
    assert columns_of(0.0, 1.0, half=2.0, y=7.0).least[0] == pytest.approx(4.25)
    draw_list = DrawList(ATLAS)
    for time_s, y in ((0.0, 7.0), (1.0, -4.0)):
        draw_list.time_s = time_s
        draw_list.ellipse((0.0, 0.0), (0.5, 0.5), INK)
        draw_list.ellipse((0.0, y), (2.0, 0.5), INK)
    apart = bar_columns(draw_list.shapes(), 4.0, lambda t: np.rint(t * PPQ).astype(np.int64))
    assert apart.least[0] == pytest.approx(1.25), "one is below, the other above"


def test_grace_strokes_on_a_bar_s_first_beat_keep_off_the_bar_line() -> None:
    flams = find_lesson("flam").score
    plain = rock()
    inset = [
        bar_columns(Engraver(s, ATLAS).bar(0, with_line=False), 3.0, s.tempo_map.ticks_at).inset for s in (plain, flams)
    ]
    assert inset[1] > inset[0] + 1.0


def test_voices_and_letters_share_their_columns() -> None:
    score = rock()
    columns = bar_columns(Engraver(score, ATLAS).bar(0, with_line=False), 2.0, score.tempo_map.ticks_at)
    assert columns.times_s.tolist() == [k / 4 for k in range(8)], "a column for each eighth, kicks and snares on them"


def test_a_whole_rest_stands_in_the_middle_of_its_bar() -> None:
    score = score_of(Note(BAR, Piece.SNARE))
    columns = bar_columns(Engraver(score, ATLAS).bar(0, with_line=False), 2.0, score.tempo_map.ticks_at)
    places = columns.places(1.3)
    assert places[1] == pytest.approx(places[2] / 2)


def test_springs_give_way_only_where_they_may() -> None:
    bars = [columns_of(0.0, 0.25, 0.5, 2.0), columns_of(0.0, 2.0)]
    for width in (18.0, 25.0, 60.0):
        force = force_to(bars, width)
        assert sum(bar.places(force)[-1] for bar in bars) == pytest.approx(width)
        for bar in bars:
            assert (np.diff(bar.places(force)) >= bar.least - 1e-9).all()


# --- lines ------------------------------------------------------------------------------------------------------------


def bars_of(count: int, ease: float = 20.0, least: float = 12.0, phrase: int = 8) -> list[SetBar]:
    """Bars of one note that are `ease` wide at ease."""
    columns = BarColumns(np.zeros(1), np.array([least - 2.0]), np.array([ease - 2.0]), 2.0)
    return [SetBar(columns, lead=3.0, in_phrase=k % phrase) for k in range(count)]


def test_lines_are_full_and_hold_phrases() -> None:
    found = lines(bars_of(8), 85.0)
    assert [len(line) for line in found] == [4, 4]
    for line in found[:-1]:
        assert line[-1].right == pytest.approx(85.0 - 3.0), "to the right edge, behind the clef"
    assert [len(line) for line in lines(bars_of(8, phrase=2), 70.0)] == [4, 4]
    assert [len(line) for line in lines(bars_of(9, phrase=3), 67.0)] == [3, 3, 3]


def test_bars_follow_each_other_in_order() -> None:
    boxes = [box for line in lines(bars_of(11), 60.0) for box in line]
    assert [box.index for box in boxes] == list(range(11))
    for line in lines(bars_of(11), 60.0):
        for before, after in pairwise(line):
            assert before.right == after.left < after.places[0] < after.right


def test_a_short_last_line_is_not_spread() -> None:
    *_, last = lines(bars_of(6), 85.0)
    assert len(last) == 2
    assert last[-1].right < 60.0


def test_no_bar_stands_alone_in_the_last_line() -> None:
    assert len(lines(bars_of(5), 85.0)[-1]) > 1
    assert [len(line) for line in lines(bars_of(1), 85.0)] == [1]


def test_a_bar_too_wide_for_paper_is_squeezed_onto_it() -> None:
    (line,) = lines(bars_of(1, 200.0, 150.0), 85.0)
    assert line[-1].right == pytest.approx(82.0)


# --- folds ------------------------------------------------------------------------------------------------------------


def song(bars: str) -> Score:
    """A bar of a stroke for each letter, on another beat for another letter."""
    strokes = [Note(k * BAR + "ABCD".index(name) * PPQ, Piece.SNARE) for k, name in enumerate(bars)]
    return Score.from_notes(strokes, TempoMap.constant(100), len(bars) * BAR)


def test_bars_that_come_again_stand_once_with_all_their_numbers() -> None:
    bars = sheet_bars(song("AAAABCDC"), {4: "fill"})
    assert [bar.number for bar in bars] == ["1–4", "5", "6", "7", "8"]
    assert (bars[0].opens_repeat, bars[0].line, bars[0].times) == (True, BarLine.REPEAT_END, 4)
    assert [bar.line for bar in bars[1:]] == [BarLine.PLAIN] * 3 + [BarLine.FINAL]


def test_endings_have_brackets_and_numbers() -> None:
    bars = sheet_bars(song("ABCDABCDABCDABCC"), {})
    assert [bar.number for bar in bars] == ["1, 5 … 13", "2, 6 … 14", "3, 7 … 15", "4, 8, 12", "16"]
    assert [bar.volta for bar in bars] == [None] * 3 + [Volta("1–3.", True, True), Volta("4.", True, False)]
    assert [bar.line for bar in bars] == [*[BarLine.PLAIN] * 3, BarLine.REPEAT_END, BarLine.FINAL]


def test_the_loop_has_repeat_signs_and_what_it_lands_on_stands_after_them() -> None:
    bars = sheet_bars(song("ABCDA"), {}, loop=(0, 3))
    assert (bars[0].opens_repeat, bars[3].line, bars[4].line) == (True, BarLine.REPEAT_END, BarLine.FINAL)
    folded_inside = sheet_bars(song("AAAABCDC"), {}, loop=(0, 7))
    assert sum(bar.opens_repeat for bar in folded_inside) == 1, "no signs within signs"


def test_a_section_begins_after_a_double_line() -> None:
    bars = sheet_bars(song("ABCD"), {0: "verse", 2: "chorus"})
    assert [bar.line for bar in bars] == [BarLine.PLAIN, BarLine.DOUBLE, BarLine.PLAIN, BarLine.FINAL]
    assert [bar.in_phrase for bar in bars] == [0, 1, 0, 1]


def test_a_repeat_back_to_another_meter_tells_it_again() -> None:
    """4/4 4/4 | 3/4 twice over: the first bar of each pass says 4/4, though one stands before it on paper."""
    meters = [MeterChange(0, 4, 4)]
    start, notes = 4 * PPQ, [Note(0, Piece.SNARE)]
    for _ in range(2):
        for beats in (4, 4, 4, 3):
            meters.append(MeterChange(start, beats, 4))
            notes.append(Note(start, Piece.KICK))
            start += beats * PPQ
    score = Score.from_notes(notes, TempoMap.build([], meters), start)
    assert folded(score) == [Passage(0, 0), Passage(1, 4, 2)]
    assert [str(bar.meter) if bar.meter else "" for bar in sheet_bars(score, {})] == ["4/4", "4/4", "", "", "3/4"]


@pytest.mark.parametrize(
    ("numbers", "words"),
    [
        ([7], "7"),
        ([1, 5], "1, 5"),
        ([1, 2], "1, 2"),
        ([1, 2, 3], "1–3"),
        ([2, 4, 6], "2, 4, 6"),
        ([1, 3, 5, 7], "1, 3 … 7"),
    ],
)
def test_numbers_of_a_bar(numbers: list[int], words: str) -> None:
    assert number_words(numbers) == words


# --- above the line ---------------------------------------------------------------------------------------------------


def test_words_stand_over_what_is_below_them() -> None:
    skyline = Skyline(40.0)
    assert skyline.top_over(0.0, 40.0) == -2.0, "the staff"
    skyline.add(10.0, 12.0, -5.0, 3.0)
    assert skyline.top_over(11.0, 30.0) == -5.0
    assert skyline.top_over(13.0, 30.0) == -2.0
    assert (skyline.top, skyline.bottom) == (-5.0, 3.0)


def placed_words(*words: LineWord, below: float = -2.0) -> list[tuple[float, float, float]]:
    """Left, right and lowest edge of what each word's frame is, over a line 60 wide."""
    draw_list, skyline = DrawList(ATLAS), Skyline(60.0)
    skyline.add(0.0, 60.0, below, 2.0)
    draw_words(draw_list, skyline, words)
    shapes = draw_list.shapes()
    flat = shapes[(shapes["kind"] == ShapeKind.BOX) & (np.abs(shapes["axis"][:, 0]) == 1)]
    edges = [(float(s["centre"][0] - s["half"][0]), float(s["centre"][0] + s["half"][0])) for s in flat]
    lowest = {edge: max(float(s["centre"][1]) for s, e in zip(flat, edges, strict=True) if e == edge) for edge in edges}
    return sorted((*edge, y) for edge, y in lowest.items())


def test_words_that_would_meet_stand_in_two_rows_above_all_else() -> None:
    (_, one_end, one), (two_start, _, two) = placed_words(LineWord(0.0, "verse"), LineWord(2.0, "chorus"), below=-6.0)
    assert two_start < one_end, "side by side they would meet"
    assert two < one - 1.0 < -7.0
    apart = placed_words(LineWord(0.0, "verse"), LineWord(30.0, "chorus"))
    assert apart[0][2] == apart[1][2], "else in one"


def test_no_word_leaves_its_line() -> None:
    ((left, right, _),) = placed_words(LineWord(55.0, "a name that is far too long for where it stands " * 3))
    assert right == pytest.approx(60.0, abs=0.01)
    assert right - left < 40.0

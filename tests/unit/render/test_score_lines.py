"""Lines of a page: which bars stand on each, and that the next one is seen whenever a line is played."""

from itertools import pairwise

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoMap
from station.practice.session.plan import PlanOptions, plan_practice
from station.render.notation.screen.score_lines import ScoreLine, rows_of, score_lines, shown_lines
from station.render.snapshot import BarNumbers
from station.scenes.score_words import bar_numbers
from tests.unit.render.scores import rock

PLAIN = BarNumbers()
WIDE = 125.0
"""Staff spaces beside the clef on a screen 1280 wide."""


def sixteenths(bars: int, tempo_bpm: float = 120.0) -> Score:
    notes = [Note(k * PPQ // 4, Piece.SNARE) for k in range(16 * bars)]
    return Score.from_notes(notes, TempoMap.constant(tempo_bpm))


def bars_of(score: Score, numbers: BarNumbers = PLAIN, spaces: float = WIDE) -> list[tuple[int, int]]:
    return [(line.first, line.after) for line in score_lines(score, numbers, spaces)]


@pytest.mark.parametrize(
    ("bars", "edges"),
    # sixteenths, three spaces each: two bars to a line of 125; no line of a single bar where there are more
    [
        (1, [(0, 1)]),
        (2, [(0, 2)]),
        (3, [(0, 3)]),
        (4, [(0, 2), (2, 4)]),
        (5, [(0, 2), (2, 5)]),
        (8, [(0, 2), (2, 4), (4, 6), (6, 8)]),
    ],
)
def test_dense_bars_stand_two_to_a_line(bars: int, edges: list[tuple[int, int]]) -> None:
    assert bars_of(sixteenths(bars)) == edges


def test_eighths_stand_four_to_a_line() -> None:
    assert bars_of(rock(8)) == [(0, 4), (4, 8)]
    assert bars_of(rock(6)) == [(0, 3), (3, 6)]


def test_a_pass_begins_a_line() -> None:
    assert bars_of(sixteenths(9), BarNumbers(0, 3, 3)) == [(0, 3), (3, 6), (6, 9)]


def test_a_loop_of_one_bar_comes_again_on_its_line() -> None:
    assert bars_of(sixteenths(5), BarNumbers(0, 1, 5)) == [(0, 2), (2, 4), (4, 5)]


def test_short_loops_fill_a_line_that_would_be_over_at_once() -> None:
    """At 240 a minute two bars of eighths last two seconds: four stand on the line, at 120 two."""
    fast = Score.from_notes([Note(k * PPQ // 2, Piece.HIHAT) for k in range(64)], TempoMap.constant(240))
    slow = Score.from_notes([Note(k * PPQ // 2, Piece.HIHAT) for k in range(64)], TempoMap.constant(120))
    assert bars_of(fast, BarNumbers(0, 2, 4)) == [(0, 4), (4, 8)]
    assert bars_of(slow, BarNumbers(0, 2, 4)) == [(0, 2), (2, 4), (4, 6), (6, 8)]


def test_a_section_begins_a_line_and_a_landing_has_its_own() -> None:
    assert bars_of(sixteenths(8), BarNumbers(0, 8, 1, ((0, "A"), (3, "B")))) == [(0, 3), (3, 5), (5, 8)]
    assert bars_of(sixteenths(5), BarNumbers(0, 2, 2)) == [(0, 2), (2, 4), (4, 5)]


def test_a_short_line_takes_its_share_of_the_width() -> None:
    lines = score_lines(sixteenths(5), BarNumbers(0, 2, 2), WIDE)
    assert [line.share for line in lines] == [1.0, 1.0, 0.5]
    assert [line.start_s for line in lines] == [0.0, 4.0, 8.0]


def test_a_score_without_bars_has_no_lines() -> None:
    assert score_lines(Score.from_notes([], TempoMap()), BarNumbers(), WIDE) in (
        (),
        score_lines(rock(0), BarNumbers(), WIDE),
    )
    assert shown_lines((), 0.0) == []


# --- what is seen -----------------------------------------------------------------------------------------------------

LINES = tuple(ScoreLine(2 * k, 2 * k + 2, 4.0 * k, 4.0 * k + 4.0, 1.0) for k in range(4))


def seen(position_s: float, comes_again: bool = False, before: int = 0) -> list[tuple[int, int, float, float]]:
    """First bar, row, and the part that is seen."""
    return [(s.line.first, s.row, s.left, s.right) for s in shown_lines(LINES, position_s, comes_again, before)]


def test_two_lines_take_turns() -> None:
    assert seen(-2.0) == seen(0.0) == seen(3.9) == [(0, 0, 0, 1), (2, 1, 0, 1)]
    assert seen(6.0) == [(2, 1, 0, 1), (4, 0, 0, 1)]
    assert seen(9.9) == [(4, 0, 0, 1), (6, 1, 0, 1)]


def test_the_end_of_the_line_before_stays_for_a_moment() -> None:
    """Its last strokes are judged then; where it stood the next but one begins already."""
    assert seen(4.1) == [(2, 1, 0, 1), (4, 0, 0, pytest.approx(0.72)), (0, 0, pytest.approx(0.72), 1)]
    assert seen(5.0) == [(2, 1, 0, 1), (4, 0, 0, 1)]


def test_after_the_last_line_comes_the_first_or_the_one_before_stays() -> None:
    assert seen(15.0, comes_again=True) == [(6, 1, 0, 1), (0, 0, 0, 1)]
    assert seen(15.0) == seen(99.0) == [(6, 1, 0, 1), (4, 0, 0, 1)]


def test_what_was_seen_coming_does_not_move_when_it_is_there() -> None:
    """Three lines were demonstrated: the third stood above, so that the first of the pass stands below."""
    assert seen(-1.0, before=3) == [(0, 1, 0, 1), (2, 0, 0, 1)]


def test_a_single_line_has_the_page_for_itself() -> None:
    assert rows_of(LINES[:1], False, 0) == 1
    assert rows_of(LINES[:1], True, 0) == rows_of(LINES[:1], False, 1) == rows_of(LINES, False, 0) == 2


SAMPLE = (
    "rock-2",
    "seven-against-four",
    "train-fill-1",
    "diddle-grid-sixteenths",
    "gospel-twelve-eight-1",
    "rhythm-pyramid",
)


@pytest.mark.parametrize("name", SAMPLE)
@pytest.mark.parametrize("tempo_bpm", [30.0, 300.0])
@pytest.mark.parametrize("spaces", [60.0, WIDE])
def test_two_bars_and_the_next_line_are_ahead_at_every_moment(name: str, tempo_bpm: float, spaces: float) -> None:
    lesson = find_lesson(name)
    plan = plan_practice(lesson, PlanOptions(tempo_bpm=tempo_bpm, loops=3))
    score, loop = plan.score, plan.section.bar_count
    lines = score_lines(score, bar_numbers(lesson.sections, plan.first_bar, loop, score.bar_count // loop), spaces)
    assert [line.first for line in lines] == [0, *(line.after for line in lines[:-1])], "no bar is left out"
    starts_s = score.tempo_map.seconds_at([score.tempo_map.bar_start(bar) for bar in range(score.bar_count + 1)])
    for position_s in np.arange(-1.0, float(starts_s[-1]), 0.23):
        assert_ahead(shown_bars(lines, float(position_s)), np.asarray(starts_s), max(float(position_s), 0.0))


def shown_bars(lines: tuple[ScoreLine, ...], position_s: float) -> list[tuple[float, float]]:
    """From when until when music is seen, in order, without lines of the past and what comes again after the end."""
    found = shown_lines(lines, position_s, comes_again=True)
    assert len(found) > 1, "a line is beside the one that is played"
    assert found[0].is_played
    assert {s.row for s in found} == {0, 1}
    spans = [(s.line.start_s, s.line.start_s + s.right * (s.line.end_s - s.line.start_s)) for s in found if s.left == 0]
    return [spans[0], *(span for span in spans[1:] if span[0] > spans[0][0])]


def assert_ahead(spans: list[tuple[float, float]], starts_s: np.ndarray, position_s: float) -> None:
    bar = min(int(np.searchsorted(starts_s, position_s, side="right")) - 1, len(starts_s) - 2)
    within = (position_s - starts_s[bar]) / (starts_s[bar + 1] - starts_s[bar])
    if bar + 3 >= len(starts_s):
        return  # the end, after which the first line stands
    wanted_s = starts_s[bar + 2] + within * (starts_s[bar + 3] - starts_s[bar + 2])
    coming = [span for span in spans if span[1] > position_s]
    assert coming[0][0] <= position_s + 1e-9 or position_s == 0.0
    for one, other in pairwise(coming):
        assert other[0] == pytest.approx(one[1]), "no gap"
    assert coming[-1][1] >= wanted_s - 1e-6


def test_bars_of_other_meters_share_a_line_by_their_length() -> None:
    meters = [MeterChange(0, 4, 4), MeterChange(16 * PPQ, 2, 4)]
    score = Score.from_notes([Note(k * PPQ, Piece.SNARE) for k in range(24)], TempoMap.build([], meters))
    lines = score_lines(score, BarNumbers(), WIDE)
    assert [(line.first, line.after, line.share) for line in lines] == [(0, 4, 1.0), (4, 8, 0.5)]


def test_the_line_that_comes_again_bears_no_marks_of_this_pass() -> None:
    """What was played on it was the pass that is nearly over; the next one has not begun."""
    again = {shown.line.first: shown.is_again for shown in shown_lines(LINES, 15.0, comes_again=True)}
    assert again == {6: False, 0: True}
    assert not any(shown.is_again for shown in shown_lines(LINES, 5.0, comes_again=True))

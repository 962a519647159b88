"""Leans by hand, and what they are called."""

from dataclasses import replace

import numpy as np
import pytest

from station.core.pieces import Piece
from station.music.judgement import Label
from station.render.report.report_layout import ReportPage, page_for
from station.render.report.report_picture import report_shapes, report_sheet
from station.render.report.result_facts import (
    Passages,
    PieceLean,
    ResultFacts,
    ResultWords,
    headline,
    in_words,
    leans,
    result_facts,
    ticks,
    whole_lean,
)
from station.render.text.atlas import Atlas
from station.render.text.draw_list import ShapeKind
from tests.unit.render.scores import rock

MS = 1_000_000
WHOLE = page_for((1280, 800))


def facts(advice: tuple[str, ...] = (), craft: tuple[str, ...] = ()) -> ResultFacts:
    score = rock()
    label = np.full(len(score), Label.MATCH, np.uint8)
    played = np.zeros(len(score), np.int64)
    kicks = np.flatnonzero(score.notes["piece"] == Piece.KICK)
    played[kicks] = [20 * MS, 40 * MS]
    label[0] = Label.MISS if score.notes["piece"][0] != Piece.KICK else label[0]
    hats = np.flatnonzero(score.notes["piece"] == Piece.HIHAT)
    label[hats[0]], label[hats[1]] = Label.MISS, Label.WRONG_PIECE
    right = label == Label.MATCH
    words = ResultWords("Rock", "120 bpm", 87.0, advice, craft)
    return result_facts(score, label, played, right, np.array([0.3]), words)


def test_leans_of_pieces() -> None:
    by_name = {lean.name: lean for lean in leans(facts())}
    kick = by_name["kick"]
    assert (kick.notes, kick.hits, kick.mean_ms) == (2, 2, 30.0)
    assert kick.sd_ms == pytest.approx(np.sqrt(200))  # of 20 and 40 about 30, with n − 1
    hat = by_name["hi-hat"]
    assert (hat.notes, hat.hits, hat.mean_ms) == (8, 6, 0.0)


def test_what_was_not_played_has_no_asynchrony() -> None:
    made = facts()
    assert np.isnan(made.asynchrony_ms[made.label == Label.MISS]).all()
    assert not np.isnan(made.asynchrony_ms[made.label == Label.WRONG_PIECE]).any()
    assert made.count(Label.EXTRA) == 1
    assert made.bar_s.tolist() == [0.0, 2.0]


@pytest.mark.parametrize(
    ("mean_ms", "sd_ms", "said"),
    [
        (None, None, "nothing to judge"),
        (14.0, 12.0, "steady but 14 ms late"),
        (-14.4, 12.0, "steady but 14 ms early"),
        (3.0, 20.0, "steady and on the beat"),
        (10.0, 30.0, "fairly steady, on the beat"),
        (-40.0, 36.0, "uneven, 40 ms early"),
        (12.0, None, "12 ms late"),
    ],
)
def test_words(mean_ms: float | None, sd_ms: float | None, said: str) -> None:
    assert in_words(PieceLean("snare", 10, 0 if mean_ms is None else 9, mean_ms, sd_ms)) == said


@pytest.mark.parametrize(
    ("mean_ms", "ci", "said"),
    [
        (-4.7, (-123.0, 114.0), "uneven, neither early nor late for sure"),
        (-4.7, (-9.0, -0.4), "uneven, on the beat"),
        (-9.0, (-14.0, -4.0), "uneven, 9 ms early"),
        (25.0, (-6.0, 56.0), "uneven, neither early nor late for sure"),
    ],
)
def test_on_the_beat_is_what_lies_there_with_its_interval(mean_ms: float, ci: tuple[float, float], said: str) -> None:
    assert in_words(PieceLean("all", 288, 125, mean_ms, 47.0, ci)) == said


def test_fills_that_lie_elsewhere_are_named_apart_from_the_groove() -> None:
    groove = PieceLean("groove", 96, 96, -2.0, 17.0, (-6.0, 2.0))
    made = replace(played(0), passages=Passages(groove, -44.4))
    assert headline(made) == "steady and on the beat in the groove, 44 ms early in the fills"


def test_a_share_is_never_rounded_up_to_nearly_all() -> None:
    """107 of 120 are 89.2 %, 43 of 48 are 89.6 %; 27 of 48 are 56.3 %, 31 of 48 are 64.6 %."""
    said = [
        headline(played(missed, passes)).partition(" %")[0] for missed, passes in ((13, 10), (5, 4), (21, 4), (17, 4))
    ]
    assert said == ["89", "89", "56", "65"]


def test_no_hits_at_all() -> None:
    score = rock()
    label = np.full(len(score), Label.MISS, np.uint8)
    nothing = np.zeros(len(score), np.int64)
    made = result_facts(score, label, nothing, nothing > 0, np.empty(0), ResultWords("Rock", "", None))
    assert whole_lean(made).mean_ms is None
    assert len(report_shapes(made, Atlas(), WHOLE)) > 100, "the page is drawn all the same"


WINDOWS = {
    "1280 × 720": ((947, 558), 0.9),
    "1920 × 1080": ((1420, 880), 0.9),
    "1280 × 720, with what comes next": ((946, 415), 0.9),
    "1920 × 1080, with what comes next": ((1370, 607), 1.485),
    "1280 × 720, panels twice as large": ((704, 330), 1.8),
    "1920 × 1080, panels twice as large": ((1056, 840), 1.8),
    "beside a panel": ((947, 290), 0.9),
    "tiny": ((300, 90), 0.9),
}
"""What panels leave of a window, in pixels, and how large letters should be there."""


@pytest.mark.parametrize(("size", "least"), WINDOWS.values(), ids=WINDOWS)
def test_the_page_keeps_within_its_own_bounds(size: tuple[int, int], least: float) -> None:
    page = page_for(size, least)
    sentence = "You leave out 14 % of the ghost notes, most in bars 2 and 4: play that slowly until all are there. "
    made = facts((sentence * 2,) * 3, ("Hi-hat, accents against plain strokes: +6.8 dB, written +6.5 dB",) * 20)
    shapes = report_shapes(made, Atlas(), page)
    reach = np.where(shapes["kind"] == ShapeKind.GLYPH, 0.0, shapes["half"].max(axis=1))
    round_ones = np.isin(shapes["kind"], (ShapeKind.ELLIPSE, ShapeKind.GLYPH))
    inside = (shapes["centre"] - reach[:, None])[round_ones]
    assert inside.min() > 0
    lowest = max(box.bottom for box in (page.card, page.plot, page.pieces) if box is not None)
    assert ((shapes["centre"] + reach[:, None])[round_ones] < (page.width, lowest)).all()
    sheet = report_sheet(size, page)
    assert (sheet.unit * page.width, sheet.unit * page.height) == pytest.approx(size), "all of the room is used"
    assert lowest < page.height


def parts(page: ReportPage) -> list[bool]:
    return [page.plot is not None, page.pieces is not None]


def test_a_small_window_shows_fewer_things_rather_than_smaller_letters() -> None:
    """The smallest letters of what is read are 16 units high."""
    pages = {name: page_for(*window) for name, window in WINDOWS.items()}
    assert 16 * pages["1280 × 720"].unit >= 16
    assert 16 * pages["1920 × 1080"].unit >= 24
    assert 16 * pages["1920 × 1080, panels twice as large"].unit >= 24
    assert parts(pages["1280 × 720"]) == [True, True]
    assert parts(pages["1280 × 720, with what comes next"]) == [True, True]
    assert parts(pages["1920 × 1080, with what comes next"]) == [True, True]
    assert parts(pages["1920 × 1080, panels twice as large"]) == [True, False]
    assert parts(pages["1280 × 720, panels twice as large"]) == [False, False]


def test_advice_that_has_no_room_is_left_out_as_whole_sentences() -> None:
    """On the lowest card 90 units are left for words, five lines of the smallest letters."""
    few, many = (
        len(report_shapes(facts(("Slow down.",) * count), Atlas(), page_for((704, 330), 1.8))) for count in (1, 90)
    )
    each = len("Slowdown.")
    assert many > few
    assert (many - few) % each == 0
    assert many - few < 5 * each


def played(missed: int, passes: int = 1, starts: tuple[int, ...] = (), first_bar: int = 0) -> ResultFacts:
    score = rock().repeated(passes)
    label = np.full(len(score), Label.MATCH, np.uint8)
    label[:missed] = Label.MISS
    return result_facts(
        score,
        label,
        np.zeros(len(score), np.int64),
        label == Label.MATCH,
        np.empty(0),
        ResultWords("", "", None, starts=starts, first_bar=first_bar),
    )


def test_the_headline_does_not_praise_what_was_not_played() -> None:
    assert len(rock()) == 12
    assert headline(played(1)) == "steady and on the beat"  # 11 of 12 are 92 %
    assert headline(played(6)) == "50 % right; steady and on the beat"
    assert headline(played(12)) == "nothing to judge"


def test_the_time_axis_counts_passes_or_the_lesson_s_bars() -> None:
    assert ticks(played(0, 3)) == ("bar", [(0, "1"), (1, "2"), (2, "3")])
    assert ticks(played(0, 3, starts=(0,), first_bar=4)) == ("bar", [(0, "5"), (1, "6"), (2, "7")])
    assert ticks(played(0, 4, starts=(0, 2), first_bar=4)) == ("pass", [(0, "1"), (2, "2")])
    counted, marks = ticks(played(0, 64, starts=tuple(range(0, 64, 2))))
    assert (counted, marks[:2], len(marks)) == ("pass", [(0, "1"), (4, "3")], 16)


def test_hits_outside_the_bars_stay_on_the_plot() -> None:
    early_and_late_s = np.array([-30.0, 60.0])  # the score lasts two seconds
    label = np.full(len(rock()), Label.MATCH, np.uint8)
    played_ns = np.zeros(len(label), np.int64)
    made = result_facts(rock(), label, played_ns, played_ns == 0, early_and_late_s, ResultWords("", "", None))
    shapes = report_shapes(made, Atlas(), WHOLE)
    crosses = shapes[shapes["kind"] == ShapeKind.CROSS]
    assert len(crosses) == 3  # with that of the legend
    assert crosses["centre"][:, 0].min() > 0
    assert WHOLE.plot is not None
    assert crosses["centre"][:, 0].max() < WHOLE.plot.right


def test_a_wide_spread_ends_before_the_counts_and_the_words() -> None:
    """Kicks 170 ms apart, early in the mean; names take 130 units of the card, words 206 on its right."""
    score = rock()
    label = np.full(len(score), Label.MATCH, np.uint8)
    played = np.zeros(len(score), np.int64)
    played[np.flatnonzero(score.notes["piece"] == Piece.KICK)] = [-145 * MS, 25 * MS]
    made = result_facts(score, label, played, played == 0, np.empty(0), ResultWords("", "", None))
    shapes = report_shapes(made, Atlas(), WHOLE)
    spreads = shapes[(shapes["kind"] == ShapeKind.BOX) & (shapes["half"][:, 1] == 6.0) & (shapes["style"][:, 0] == 6.0)]
    edges = spreads["centre"][:, :1] + spreads["half"][:, :1] * np.array([-1.0, 1.0])
    widest = edges[np.argmax(edges[:, 1] - edges[:, 0])]
    assert WHOLE.pieces is not None
    assert widest[0] > WHOLE.pieces.left + 20 + 130
    assert widest[1] < WHOLE.pieces.right - 206 - 10

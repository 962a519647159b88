"""The scrolling score without OpenGL: which bars are seen, and what a judgement looks like."""

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.judgement import Judgement, Label
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.render.notation import note_shapes
from station.render.notation.screen.judgement_marks import MarkScale, draw_dynamics, draw_mark, off_db, timing_colour
from station.render.notation.screen.score_place import ScorePlace
from station.render.notation.screen.score_view import lead_spaces
from station.render.notation.screen.time_span import BEHIND_SHARE, ahead_s, rolling_spaces, two_bars_s, visible_bars
from station.render.palette import EARLY, GOOD, LATE
from station.render.snapshot import MARK_DTYPE, PENDING, mark, no_marks
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, ShapeKind
from tests.unit.render.scores import rock


@pytest.mark.parametrize(
    ("first_s", "last_s", "bars"),
    # at 120 bpm a bar lasts two seconds; four bars
    [(-5.5, 3.9, [0, 1]), (2.1, 3.9, [1]), (1.9, 4.1, [0, 1, 2]), (6.5, 16.0, [3, 4]), (-9.0, -1.0, [])],
)
def test_visible_bars(first_s: float, last_s: float, bars: list[int]) -> None:
    assert list(visible_bars(rock(4), first_s, last_s)) == bars


def test_timing_colours() -> None:
    assert timing_colour(0, 25.0) == timing_colour(25, 25.0) == timing_colour(-25, 25.0) == GOOD
    assert timing_colour(-25.1, 25.0) == EARLY
    assert timing_colour(25.1, 25.0) == LATE
    assert timing_colour(27, 30.0) == GOOD, "what is on time is the level's word"
    assert timing_colour(27, 10.0) == LATE


def test_the_staff_fills_its_place() -> None:
    place = ScorePlace(0, 100, 1600, 316)
    assert place.space == pytest.approx(20.0)  # 15.8 spaces from above the bar numbers to below the sticking
    assert place.middle_line == pytest.approx(100 + 8.3 * 20)


def marked(label: Label, asynchrony_ms: float = np.nan) -> set[ShapeKind]:
    row = np.zeros(1, MARK_DTYPE)
    row["label"], row["asynchrony_ms"] = label, asynchrony_ms
    draw_list = DrawList(Atlas())
    draw_mark(draw_list, row[0], (0.0, 0.0), MarkScale(12.0, 25.0))
    return {ShapeKind(int(k)) for k in draw_list.shapes()["kind"]}


def test_each_judgement_has_a_shape_of_its_own() -> None:
    on_time, early, missed = marked(Label.MATCH, 5), marked(Label.MATCH, -40), marked(Label.MISS)
    assert ShapeKind.TRIANGLE in early
    assert ShapeKind.TRIANGLE not in on_time | missed
    assert marked(Label.WRONG_PIECE, 5) == {ShapeKind.BOX}


@pytest.mark.parametrize(("asynchrony_ms", "side"), [(-40.0, -1), (40.0, 1)])
def test_arrows_point_where_the_hit_fell(asynchrony_ms: float, side: int) -> None:
    row = np.zeros(1, MARK_DTYPE)
    row["label"], row["asynchrony_ms"] = Label.MATCH, asynchrony_ms
    draw_list = DrawList(Atlas())
    draw_mark(draw_list, row[0], (0.0, 0.0), MarkScale(12.0, 25.0))
    arrow = draw_list.shapes()[draw_list.shapes()["kind"] == ShapeKind.TRIANGLE][0]
    assert np.sign(arrow["centre"][0]) == side
    assert np.sign(arrow["axis"][0]) == side


def test_marks_take_judgements_of_notes_alone() -> None:
    marks = no_marks(rock())
    assert (marks["label"] == PENDING).all()
    mark(marks, Judgement(Label.MATCH, 2, 0, -7_500_000, -3))
    mark(marks, Judgement(Label.EXTRA, None, 5))
    mark(marks, Judgement(Label.MISS, 4, None))
    assert marks["label"].tolist() == [-1, -1, 0, -1, 1] + [-1] * 7
    assert marks["asynchrony_ms"][2] == -7.5
    assert marks["velocity_error"][2] == -3
    assert np.isnan(marks["asynchrony_ms"][4])


def test_every_piece_has_a_name_of_its_own() -> None:
    from station.core.labels import piece_name

    assert len({piece_name(piece) for piece in Piece}) == len(Piece)
    assert piece_name(Piece.HIHAT) == "hi-hat"


def test_a_right_note_whose_time_is_not_told_is_neither_early_nor_late() -> None:
    assert timing_colour(np.nan, 25.0) == GOOD
    assert marked(Label.MATCH) == {ShapeKind.ELLIPSE}


@pytest.mark.parametrize(
    ("written", "error", "expected_db"),
    [(64, 63.0, 11.9), (80, 16.0, 8.0 - 4.9), (96, -48.0, 4.9 - 16.9), (127, -15.0, -2.2)],  # HUMANS' table of levels
)
def test_how_much_louder_than_written(written: int, error: float, expected_db: float) -> None:
    assert off_db(written, error) == pytest.approx(expected_db, abs=0.1)


def test_no_strength_is_no_wedge() -> None:
    assert off_db(80, float("nan")) is None
    for nothing in (None, 3.0, -3.0):
        draw_list = DrawList(Atlas())
        draw_dynamics(draw_list, nothing, (0.0, 0.0))
        assert len(draw_list) == 0


@pytest.mark.parametrize(("louder_db", "way"), [(9.0, -1), (-9.0, 1)])
def test_the_wedge_points_up_when_too_loud_and_down_when_too_soft(louder_db: float, way: int) -> None:
    """Heights run downwards: above the head is negative."""
    draw_list = DrawList(Atlas())
    draw_dynamics(draw_list, louder_db, (0.0, 0.0))
    wedge = draw_list.shapes()[0]
    assert wedge["kind"] == ShapeKind.TRIANGLE
    assert np.sign(wedge["centre"][1]) == way
    assert np.sign(wedge["axis"][1]) == way


@pytest.mark.parametrize(("width", "height", "space"), [(1280.0, 216.0, 216 / 15.8), (300.0, 180.0, 300 / 48)])
def test_a_narrow_score_is_engraved_smaller_in_the_middle(width: float, height: float, space: float) -> None:
    place = ScorePlace(0.0, 420.0, width, height)
    assert place.space == pytest.approx(space)
    above, below = place.middle_line - 420 - 8.3 * space, 420 + height - place.middle_line - 7.5 * space
    assert above == pytest.approx(below, abs=1e-9)  # 8.3 spaces are engraved above the middle line, 7.5 below
    assert place.middle_line + place.top_y * space == pytest.approx(420.0)


def test_the_groups_of_a_meter_have_room_between_the_clef_and_the_notes() -> None:
    plain, twelve, seven, long = (
        Score.from_notes([], TempoMap.build([], [MeterChange(0, sum(groups), unit, groups if len(groups) > 1 else ())]))
        for groups, unit in (((4,), 4), ((12,), 8), ((2, 2, 3), 8), ((3,) * 10, 16))
    )
    leads = [lead_spaces(score) for score in (plain, twelve, seven, long)]
    assert leads[0] == pytest.approx(1.4 + 1.528 + 0.8 + 0.96 * 1.88 + 1.6, abs=0.01), "clef, 4 by the font's metadata"
    assert leads == sorted(leads)
    assert leads[2] > 8.5
    assert leads[3] < 14, "the smaller the more groups there are"
    letters = DrawList(Atlas())
    note_shapes.time_signature(letters, seven.tempo_map.meter_at(0), 3.55)
    shapes = letters.shapes()
    middles, halves = shapes["centre"][:, 0], shapes["half"][:, 0]
    assert (middles - halves).min() > 1.4 + 1.35, "the clef ends there"
    assert (middles + halves).max() < leads[2] - 0.8


def even(gap_ticks: int, count: int = 64) -> Score:
    return Score.from_notes([Note(k * gap_ticks, Piece.SNARE) for k in range(count)], TempoMap.constant(120))


@pytest.mark.parametrize(
    ("gap_ticks", "spaces", "shown_s"),
    [
        (PPQ, 60.0, 4.0),  # half a second apart: 1.6 spaces
        (PPQ // 4, 36.0, 4.0),  # two bars of four at 120 are four seconds, and stay
        (PPQ // 8, 60.0, 4.0),
    ],
)
def test_so_much_is_ahead_that_two_bars_are_seen(gap_ticks: int, spaces: float, shown_s: float) -> None:
    assert ahead_s(even(gap_ticks), spaces) == pytest.approx(shown_s)
    assert ahead_s(Score.from_notes([], TempoMap()), spaces) == 4.0


@pytest.mark.parametrize("tempo_bpm", [30, 84, 168, 300])
def test_two_bars_are_ahead_at_any_tempo(tempo_bpm: float) -> None:
    """Eight beats of 4/4; at 300 a minute they last 1.6 s, and there is room for more."""
    score = Score.from_notes([Note(k * PPQ // 4, Piece.SNARE) for k in range(64)], TempoMap.constant(tempo_bpm))
    assert two_bars_s(score) == pytest.approx(8 * 60 / tempo_bpm)
    for spaces in (10.0, 60.0, 200.0):
        assert ahead_s(score, spaces) >= 8 * 60 / tempo_bpm - 1e-9


def test_a_slow_bar_among_fast_ones_is_ahead_as_a_whole() -> None:
    """Bars of 2, 2, 4 and 2 seconds: two in a row last six at the most."""
    tempi = [TempoChange(0, 500_000), TempoChange(8 * PPQ, 1_000_000), TempoChange(12 * PPQ, 500_000)]
    score = Score.from_notes([Note(k * PPQ, Piece.SNARE) for k in range(16)], TempoMap.build(tempi, []))
    assert two_bars_s(score) == pytest.approx(6.0)


def test_thirty_seconds_that_roll_hardly_touch() -> None:
    """64 gaps in two bars, 1.3 spaces each, on the three quarters of the width that lie ahead."""
    assert rolling_spaces(even(PPQ // 8)) == pytest.approx(64 * 1.3 / (1 - BEHIND_SHARE))

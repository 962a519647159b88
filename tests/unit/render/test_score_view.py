"""The scrolling score without OpenGL: which bars are seen, and what a judgement looks like."""

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.music.judgement import Judgement, Label
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoMap
from station.render.notation import note_shapes
from station.render.notation.screen.highway import Highway, lanes
from station.render.notation.screen.judgement_marks import draw_dynamics, draw_mark, off_db, timing_colour
from station.render.notation.screen.score_view import ScorePlace, lead_spaces, pages, shown_s, visible_bars
from station.render.palette import EARLY, GOOD, LATE
from station.render.snapshot import MARK_DTYPE, PENDING, Snapshot, mark, no_marks
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
    assert timing_colour(0) == timing_colour(25) == timing_colour(-25) == GOOD
    assert timing_colour(-25.1) == EARLY
    assert timing_colour(25.1) == LATE


def test_the_staff_fills_its_place() -> None:
    place = ScorePlace(0, 100, 1600, 316)
    assert place.space == pytest.approx(20.0)  # 15.8 spaces from above the bar numbers to below the sticking
    assert place.middle_line == pytest.approx(100 + 8.3 * 20)


def marked(label: Label, asynchrony_ms: float = np.nan) -> set[ShapeKind]:
    row = np.zeros(1, MARK_DTYPE)
    row["label"], row["asynchrony_ms"] = label, asynchrony_ms
    draw_list = DrawList(Atlas())
    draw_mark(draw_list, row[0], (0.0, 0.0), 12.0)
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
    draw_mark(draw_list, row[0], (0.0, 0.0), 12.0)
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
    assert timing_colour(np.nan) == GOOD
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


def test_pages_hold_whole_bars_and_show_the_next() -> None:
    """At 120 bpm a bar lasts two seconds: four to a page of eight."""
    found = pages(rock(6))
    assert [page.start_s for page in found] == [0.0, 8.0]
    assert [page.shown_s for page in found] == [(0.0, 10.0), (8.0, 12.0)]
    assert pages(rock(1))[0].shown_s == (0.0, 2.0)


def test_the_highway_has_a_lane_for_every_piece_the_highest_first() -> None:
    assert lanes(rock(1)) == [Piece.HIHAT, Piece.SNARE, Piece.KICK]


def test_the_highway_s_notes_roll_at_their_times_in_their_lanes() -> None:
    """A snare on two at 120 bpm lies half a second after the start, in the middle of the second lane."""
    score = rock(1)
    kit, figure = load_kit(), figure_of()
    shapes = Highway(Snapshot(score, 0.0, kit, figure), Atlas(), 40.0).rolling((-1.0, 3.0))
    notes = shapes[(shapes["kind"] == ShapeKind.BOX) & (shapes["half"][:, 0] > 0.1)]
    assert len(notes) == len(score)
    snares = notes[np.isclose(notes["centre"][:, 1], 1.5)]
    assert snares["time_s"][:, 0].tolist() == pytest.approx([0.5, 1.5])


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
    ("gap_ticks", "spaces", "half_s"),
    [
        (PPQ, 60.0, 4.0),  # half a second apart: 3.75 spaces
        (PPQ // 4, 60.0, 2.34375),  # 0.125 s for 1.6 spaces: 60 spaces are 4.6875 s
        (PPQ // 8, 60.0, 1.5),  # at the least
    ],
)
def test_so_much_is_shown_that_strokes_stand_apart(gap_ticks: int, spaces: float, half_s: float) -> None:
    assert shown_s(even(gap_ticks), spaces) == pytest.approx(half_s)
    assert shown_s(Score.from_notes([], TempoMap()), spaces) == 4.0

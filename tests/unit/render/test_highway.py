"""The highway without OpenGL: where its lanes and notes lie, and what a note tells."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb, Piece
from station.core.units import PPQ
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.music.judgement import Label
from station.music.score import Note, Score
from station.render.notation.screen.highway import MARK_UNITS, Highway, LaneGrid, lanes
from station.render.palette import piece_colour
from station.render.snapshot import Snapshot, no_marks
from station.render.text.atlas import Atlas
from station.render.text.draw_list import Colour, ShapeKind
from tests.unit.render.scores import rock, score_of

ATLAS = Atlas()


def highway(score: Score, falls: bool = False, marks: NDArray[np.void] | None = None) -> Highway:
    snapshot = Snapshot(score, 0.0, load_kit(), figure_of(), marks=marks)
    return Highway(snapshot, ATLAS, LaneGrid(tuple(lanes(score)), 1.0, falls), 4.0)


def of_colour(shapes: NDArray[np.void], colour: Colour) -> NDArray[np.void]:
    wanted = [round(255 * part) for part in colour]
    return np.asarray(shapes[(shapes["kind"] == ShapeKind.BOX) & (shapes["colour"] == wanted).all(axis=1)])


def test_there_is_a_lane_for_every_piece_the_highest_first() -> None:
    assert lanes(rock(1)) == [Piece.HIHAT, Piece.SNARE, Piece.KICK]


@pytest.mark.parametrize("falls", [False, True])
def test_notes_lie_at_their_times_in_their_lanes_in_their_pieces_colours(falls: bool) -> None:
    """A snare on two at 120 bpm lies half a second after the start, in the middle of the second of three lanes."""
    shapes = highway(rock(1), falls).rolling((-1.0, 3.0))
    snares = of_colour(shapes, piece_colour(Piece.SNARE))
    assert snares["time_s"][:, 0].tolist() == pytest.approx([0.5, 1.5])
    assert snares["centre"][:, 0 if falls else 1].tolist() == pytest.approx([1.5, 1.5])
    assert len(of_colour(shapes, piece_colour(Piece.HIHAT))) == 8


def test_upright_the_kick_is_on_the_left() -> None:
    score = rock(1)
    kicks = of_colour(highway(score, falls=True).rolling((-1.0, 3.0)), piece_colour(Piece.KICK))
    assert (kicks["centre"][:, 0] == 0.5).all()


def test_a_note_is_as_long_across_its_lane_as_it_is_loud() -> None:
    score = score_of(Note(0, Piece.SNARE, velocity=40), Note(PPQ, Piece.SNARE, velocity=120))
    for falls, across in ((False, 1), (True, 0)):
        halves = of_colour(highway(score, falls).rolling((-1.0, 3.0)), piece_colour(Piece.SNARE))["half"][:, across]
        assert halves[0] < halves[1] <= 0.5


def test_ghosts_are_hollow_accents_framed_and_rolls_drawn_out() -> None:
    score = score_of(
        Note(0, Piece.SNARE, dynamic=Dynamic.GHOST),
        Note(PPQ, Piece.SNARE),
        Note(2 * PPQ, Piece.SNARE, duration_ticks=PPQ),
    )
    shapes = highway(score).rolling((-1.0, 3.0))
    line_widths = {
        float(row["time_s"][0]): float(row["style"][1]) for row in of_colour(shapes, piece_colour(Piece.SNARE))
    }
    assert line_widths[0.0] > 0.0
    assert line_widths[0.5] == 0.0
    spans = shapes["time_s"][:, 1]
    assert spans.max() == pytest.approx(0.5), "a beat at 120"
    accented = score_of(Note(0, Piece.SNARE, dynamic=Dynamic.ACCENT))
    assert len(highway(accented).rolling((-1.0, 0.4))) > len(
        highway(score_of(Note(0, Piece.SNARE))).rolling((-1.0, 0.4))
    )


def test_each_note_bears_the_letter_of_its_limb() -> None:
    """Two strokes, one letter each: glyphs."""
    score = score_of(Note(0, Piece.SNARE, limb=Limb.RIGHT_HAND), Note(PPQ, Piece.SNARE, limb=Limb.LEFT_HAND))
    shapes = highway(score).rolling((-1.0, 3.0))
    assert (shapes["kind"] == ShapeKind.GLYPH).sum() == 2


@pytest.mark.parametrize(("falls", "asynchrony_ms", "way"), [(False, -40.0, (-1, 0)), (True, -40.0, (0, 1))])
def test_marks_are_the_staff_s_and_point_where_the_hit_fell(
    falls: bool, asynchrony_ms: float, way: tuple[int, int]
) -> None:
    """Early is to the left of a note that comes from the right, and below one that falls (heights run downwards)."""
    score = rock(1)
    marks = no_marks(score)
    marks["label"][0], marks["asynchrony_ms"][0] = Label.MATCH, asynchrony_ms
    view = highway(score, falls, marks)
    arrows = view.marks((-1.0, 3.0))
    arrow = arrows[arrows["kind"] == ShapeKind.TRIANGLE][0]
    x, y = view.grid.at(0.0, Piece(int(score.notes["piece"][0])))
    beside = arrow["centre"] - np.array([x, y]) / MARK_UNITS
    assert np.sign(np.round(beside, 3)).tolist() == list(way)
    assert np.round(arrow["axis"], 3).tolist() == list(way)


def test_bar_lines_cross_all_lanes_and_are_stronger_than_beats() -> None:
    shapes = highway(rock(2)).rolling((-0.1, 4.1))
    lines = shapes[(shapes["kind"] == ShapeKind.BOX) & np.isclose(shapes["half"][:, 1], 1.5)]
    strong = lines["colour"][:, 3].max()
    assert lines["time_s"][lines["colour"][:, 3] == strong, 0].tolist() == pytest.approx([0.0, 2.0, 4.0])
    assert len(lines) == 2 * 4 + 1

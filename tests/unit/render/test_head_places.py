"""Heads beside each other: sides by Gould's rule for seconds, edges by the font's metadata."""

import numpy as np
import pytest

from station.core.pieces import Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.score import Note, Score
from station.render.notation.chord_width import heads_extent, sticking
from station.render.notation.head_places import PlacedHead, heads_x, placed_heads
from station.render.notation.staff_strokes import staff_strokes
from tests.unit.render.scores import score_of

NOTE_HALF, CROSS_HALF, BRACKET = 0.59, 0.58, 0.436
"""Half the widths of noteheadBlack and noteheadXBlack, the width of noteheadParenthesisLeft: Bravura's metadata."""


def heads(*pieces: Piece, ghosts: tuple[Piece, ...] = ()) -> dict[Piece, PlacedHead]:
    notes = [Note(0, piece, dynamic=Dynamic.GHOST if piece in ghosts else Dynamic.NORMAL) for piece in pieces]
    rows = score_of(*notes).notes
    return {
        Piece(int(row["piece"])): head
        for row, head in zip(rows, placed_heads(staff_strokes(score_of(*notes))), strict=True)
    }


def reach(note: Note) -> tuple[float, float]:
    return heads_extent(staff_strokes(score_of(note)))


def test_a_third_stands_on_one_line_and_a_second_on_both_sides_of_the_stem() -> None:
    third = heads(Piece.SNARE, Piece.TOM_1)
    assert third[Piece.SNARE].x == third[Piece.TOM_1].x == 0
    second = heads(Piece.SNARE, Piece.TOM_2)
    assert second[Piece.SNARE].x == 0, "the lower one keeps its place where stems go up"
    assert second[Piece.TOM_2].left == pytest.approx(NOTE_HALF)


def test_the_feet_give_way_to_the_hands_to_the_left() -> None:
    both = heads(Piece.TOM_4, Piece.KICK)
    assert both[Piece.TOM_4].x == 0
    assert both[Piece.KICK].right == pytest.approx(-NOTE_HALF)
    assert heads(Piece.FLOOR_TOM_1, Piece.KICK)[Piece.KICK].x == 0, "a third apart"


def test_narrow_heads_touch_the_stem_as_round_ones_do() -> None:
    hat, pedal = heads(Piece.HIHAT)[Piece.HIHAT], heads(Piece.HIHAT_PEDAL)[Piece.HIHAT_PEDAL]
    assert hat.right == pytest.approx(NOTE_HALF)
    assert pedal.left == pytest.approx(-NOTE_HALF)


def test_brackets_stand_outside_of_a_neighbour_and_round_neighbouring_ghosts() -> None:
    alone = heads(Piece.SNARE, ghosts=(Piece.SNARE,))[Piece.SNARE].brackets
    assert alone is not None
    assert alone.right == -alone.left == pytest.approx(NOTE_HALF + BRACKET / 2, abs=0.05)
    beside = heads(Piece.SNARE, Piece.TOM_2, ghosts=(Piece.SNARE,))[Piece.SNARE].brackets
    assert beside is not None
    assert beside.right - BRACKET / 2 > 3 * NOTE_HALF, "beyond the tom, which stands beside the stem"
    feet = heads(Piece.KICK, Piece.HIHAT_PEDAL, ghosts=(Piece.KICK, Piece.HIHAT_PEDAL))
    assert [feet[piece].brackets is None for piece in (Piece.HIHAT_PEDAL, Piece.KICK)] == [False, True]
    pair = feet[Piece.HIHAT_PEDAL].brackets
    assert pair is not None
    assert pair.step == 0, "between D4 and F4"


def test_heads_of_a_whole_score() -> None:
    grace = Note(PPQ, Piece.SNARE, lead_ms=30.0, ornament=Ornament.FLAM)
    score = Score.from_notes(
        [Note(0, Piece.SNARE), Note(0, Piece.TOM_2), grace, Note(PPQ, Piece.SNARE)], score_of().tempo_map
    )
    assert heads_x(score).tolist() == pytest.approx([0, 2 * NOTE_HALF, 0, 0])


def test_how_far_heads_reach() -> None:
    assert reach(Note(0, Piece.SNARE)) == pytest.approx((NOTE_HALF, NOTE_HALF))
    crash = Note(0, Piece.CRASH_1, Zone.EDGE)
    assert reach(crash) == pytest.approx((0.4 + 2 * CROSS_HALF - NOTE_HALF, 0.4 + NOTE_HALF)), "its ledger line"
    ghost = Note(0, Piece.SNARE, dynamic=Dynamic.GHOST)
    assert reach(ghost) == pytest.approx((NOTE_HALF + 0.03 + BRACKET,) * 2, abs=0.001)
    accent = Note(0, Piece.SNARE, dynamic=Dynamic.ACCENT)
    assert reach(accent) == pytest.approx((1.356 / 2,) * 2), "articAccentAbove is 1.356 wide"


def test_letters_of_a_chord() -> None:
    notes = [Note(0, Piece.SNARE), Note(0, Piece.HIHAT), Note(0, Piece.KICK)]
    score = score_of(*notes)  # in the order of the pieces: kick, snare, hi-hat
    strokes = staff_strokes(score, np.array([Limb.LEFT_FOOT, Limb.LEFT_HAND, Limb.RIGHT_HAND], np.int8))
    assert sticking(strokes, is_up=True) == ["L", "R"], "from the staff outward, as the heads are"
    assert sticking(strokes, is_up=False) == ["L"]
    assert sticking(staff_strokes(score), is_up=True) == []
    early = [Note(0, Piece.SNARE, lead_ms=ms, ornament=Ornament.DRAG) for ms in (110.0, 55.0)]
    drag = score_of(*early, Note(0, Piece.SNARE, ornament=Ornament.DRAG))
    left = np.array([Limb.LEFT_HAND, Limb.LEFT_HAND, Limb.RIGHT_HAND], np.int8)
    assert sticking(staff_strokes(drag, left), is_up=True) == ["llR"]

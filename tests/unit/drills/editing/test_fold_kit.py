"""A lesson folded to a smaller kit: where each stroke goes, by hand."""

import pytest

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece
from station.core.stand_ins import STAND_INS, stand_in
from station.drills.editing.edit_lesson import edited
from station.drills.editing.folded_lesson import folded
from station.drills.editing.lesson_edits import Fold
from station.drills.library import lesson_names
from station.drills.reading.lesson_file import parse_lesson
from tests.shipped_lesson import shipped_lesson

HEAD = 'title = "T"\n'
SMALL = frozenset({Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.HIHAT_PEDAL, Piece.TOM_1, Piece.CRASH_1})


def _rows(text: str, *pieces: Piece) -> dict[str, str]:
    """The rows of the grid after folding, without blanks."""
    kit = frozenset(pieces) or SMALL
    found = edited(HEAD + text, Fold(kit))
    lesson = parse_lesson(found, "t.toml", "t")
    assert lesson.lesson is not None, [str(fault) for fault in lesson.faults]
    assert {note.piece for note in lesson.lesson.score} <= kit
    pairs = (row.split("=", 1) for row in found.splitlines() if "=" in row)
    return {key.strip(): value.strip().strip('"').replace(" ", "") for key, value in pairs}


def test_each_piece_has_its_nearest_and_at_last_what_every_kit_has() -> None:
    assert stand_in(Piece.TOM_2, SMALL) is Piece.TOM_1
    assert stand_in(Piece.TOM_2, {Piece.SNARE}) is Piece.SNARE
    assert stand_in(Piece.CRASH_2, {Piece.RIDE, Piece.HIHAT}) is Piece.RIDE
    assert stand_in(Piece.CRASH_2, {Piece.HIHAT}) is Piece.HIHAT
    assert stand_in(Piece.KICK, {Piece.KICK}) is Piece.KICK  # piece 0 is a piece
    assert stand_in(Piece.HIHAT_PEDAL, {Piece.KICK}) is None
    assert all(piece not in others for piece, others in STAND_INS.items())


def test_a_line_goes_to_a_line_that_is_there_or_becomes_one() -> None:
    rows = _rows('[grid]\ntom_1 = "| o--- | %3 |"\ntom_2 = "| -oO- | %3 |"\ncrash_2 = "| ---X | %3 |"\n')
    assert rows == {"title": "T", "tom_1": "|ooO-|%3|", "crash": "|---X|%3|"}


def test_where_two_fall_together_the_louder_stays() -> None:
    assert _rows('[grid]\ntom_1 = "oOgo"\ntom_2 = "Ooo-"\n')["tom_1"] == "|OOoo|"
    assert _rows('[grid]\ntom_2 = "oO"\nfloor_tom = "Oo"\n')["tom_1"] == "|OO|"


def test_the_hand_of_a_line_stays_and_no_bar_needs_a_third() -> None:
    text = '[grid]\nsnare = "oo--"\nright_hand.snare = "---o"\nright_hand.tom_1 = "Oo-O"\n'
    rows = _rows(text, Piece.SNARE)
    assert rows["snare"] == "|-o--|"  # the accent of the right hand took its place
    assert rows["right_hand.snare"] == "|O--O|"
    lesson = parse_lesson(edited(HEAD + text, Fold(frozenset({Piece.SNARE}))), "", "").lesson
    assert lesson is not None
    assert [note.limb for note in lesson.score] == [Limb.RIGHT_HAND, Limb.UNKNOWN, Limb.RIGHT_HAND]


def test_letters_become_those_that_play_the_same_there() -> None:
    text = '[grid]\nride = "xXbg"\ncrash_2 = "----|X-#-"\nhihat = "----|----"\n'
    rows = _rows(text.replace('"xXbg"', '"xXbg|----"'), Piece.HIHAT, Piece.SNARE)
    assert rows["hihat"] == "|xXxg|E---|"  # a hi-hat has no bell, and is not grabbed by a letter
    assert _rows('[grid]\ntom_2 = "b~fd|tov-"\n', Piece.SNARE)["snare"] == "|b~fd|tov-|"


def test_a_foot_has_no_other_piece() -> None:
    rows = _rows('[grid]\nhihat_pedal = "x-x-"\nsnare = "-o-o"\n', Piece.SNARE)
    assert rows == {"title": "T", "snare": "|-o-o|"}


def test_sticking_and_timing_go_along() -> None:
    text = '[grid]\nsnare = "o-o-"\ntom_2 = "-O-o"\nsticking = "RLRL"\n[grid.timing]\ntom_2 = [5, -5]\nsnare = [1, 2]\n'
    found = edited(HEAD + text, Fold(frozenset({Piece.SNARE})))
    lesson = parse_lesson(found, "", "").lesson
    assert lesson is not None
    assert [(note.late_ms, note.limb.name[0]) for note in lesson.score] == [(1, "R"), (5, "L"), (2, "R"), (-5, "L")]
    assert "tom" not in found


VARIED = """[[grid]]
name = "A"
snare = "o---"
tom_2 = "--o-"
[[grid]]
name = "B"
like = "A"
tom_2 = "---O"
[[grid]]
name = "C"
like = "A"
kick = "o---"
"""


def test_a_variation_plays_what_it_played() -> None:
    found = edited(HEAD + VARIED, Fold(frozenset({Piece.SNARE, Piece.KICK})))
    lesson = parse_lesson(found, "", "").lesson
    assert lesson is not None
    score = lesson.score
    ticks = [(note.tick // (score.end_tick // 12), note.piece) for note in score]
    snare, kick = Piece.SNARE, Piece.KICK
    assert ticks == [(0, snare), (2, snare), (4, snare), (7, snare), (8, kick), (8, snare), (10, snare)]
    assert found.count("snare") == 2  # C goes on taking A's over


def test_the_landing_is_folded_too() -> None:
    text = '[grid]\nsnare = "o-o-"\n[landing]\ncrash_2 = "X"\nkick = "o"\n'
    rows = _rows(text, Piece.SNARE, Piece.KICK, Piece.CRASH_1)
    assert (rows["crash"], rows["kick"]) == ("X", "o")


def test_a_kit_on_which_nothing_is_left_is_told() -> None:
    with pytest.raises(BadInput):
        edited(f'{HEAD}[grid]\nkick = "o---"\n', Fold(frozenset({Piece.SNARE})))
    with pytest.raises(BadInput, match="at least one piece"):
        edited(f'{HEAD}[grid]\nkick = "o---"\n', Fold(frozenset()))


@pytest.mark.parametrize("name", lesson_names()[::9])
def test_shipped_lessons_can_be_played_on_a_kit_of_four(name: str) -> None:
    lesson = shipped_lesson(name)
    four = {Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.HIHAT_PEDAL}
    small = folded(lesson, four)
    assert {note.piece for note in small.score} <= four
    assert small.score.end_tick == lesson.score.end_tick
    assert set(small.score.notes["tick"].tolist()) <= set(lesson.score.notes["tick"].tolist())
    assert folded(small, four) is small


def test_a_landing_that_strikes_nothing_any_more_is_taken_away() -> None:
    text = 'title = "T"\n\n[grid]\nsnare = "o---"\ntom_1 = "--o-"\n\n[landing]\ncrash = "X"\n'
    folded = edited(text, Fold(frozenset({Piece.TOM_1, Piece.TOM_4})))
    assert "landing" not in folded
    assert parse_lesson(folded, "t.toml", "t").lesson is not None

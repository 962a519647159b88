"""Which hand strikes: expected limbs read off the letters by eye."""

import pytest

from station.core.pieces import Limb, Piece
from tests.unit.drills.reading import faults, notes, text_of

R, L, NOBODY = Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.UNKNOWN


def limbs(grid: str) -> list[tuple[Piece, Limb]]:
    return [(n.piece, n.limb) for n in notes(grid)]


def test_letters_name_the_hand() -> None:
    assert [limb for _, limb in limbs('snare = "oooo"\nsticking = "RLL-"')] == [R, L, L, NOBODY]


def test_the_sticking_may_be_cut_differently() -> None:
    assert [limb for _, limb in limbs('snare = "oo"\nsticking = "R--- L---"')] == [R, L]


@pytest.mark.parametrize(
    ("right", "left"),
    [
        ("hihat", "snare"),
        ("ride", "snare"),
        ("ride", "hihat"),
        ("crash", "snare"),
        ("hihat", "tom_1"),
        ("floor_tom", "snare"),
        ("tom_2", "tom_1"),
        ("crash_2", "crash"),
    ],
)
def test_both_hands(right: str, left: str) -> None:
    def letter(line: str) -> str:
        return "o" if line == "snare" or "tom" in line else "x"

    for first, second in ((right, left), (left, right)):
        grid = f'{first} = "{letter(first)}---"\n{second} = "{letter(second)}---"\nsticking = "B---"'
        found = {n.piece.name.lower().removesuffix("_1"): n.limb for n in notes(grid)}
        assert found == {right.removesuffix("_1"): R, left.removesuffix("_1"): L}


def test_feet_are_no_concern_of_the_sticking() -> None:
    found = dict(limbs('snare = "o---"\nkick = "o---"\nhihat_pedal = "x---"\nsticking = "L---"'))
    assert found == {Piece.SNARE: L, Piece.KICK: Limb.RIGHT_FOOT, Piece.HIHAT_PEDAL: Limb.LEFT_FOOT}


def test_a_limb_table_and_the_sticking_may_agree() -> None:
    assert limbs('left_hand.snare = "oo--"\nsticking = "L---"') == [(Piece.SNARE, L), (Piece.SNARE, L)]


@pytest.mark.parametrize(
    ("grid", "line", "column", "words"),
    [
        ('snare = "o-o-"\nsticking = "RL--"', 5, 14, "no hand strikes here"),
        ('kick = "o---"\nsticking = "R---"', 5, 13, "no hand strikes here"),
        ('snare = "o-o-"\nsticking = "B---"', 5, 13, "but one strikes here (snare)"),
        ('snare = "oo--"\nhihat = "-x--"\nsticking = "RL--"', 6, 14, "two strokes here"),
        ('snare = "o---"\nsticking = "X---"', 5, 13, "'X' is no sticking; expected R, L, B"),
        ('snare = "o---"\nsticking = "r---"', 5, 13, "'r' is no sticking"),
        ('right_hand.snare = "o---"\nsticking = "L---"', 5, 13, "contradicts the right_hand.snare line"),
        ('snare = "o---"\nsticking = "R--- ---"', 5, 18, "7 cells do not fill"),
    ],
)
def test_faults(grid: str, line: int, column: int, words: str) -> None:
    (found,) = faults(text_of(grid))
    assert (found.line, found.column) == (line, column), found
    assert words in found.text


def test_a_fault_elsewhere_is_not_blamed_on_the_sticking() -> None:
    (found,) = faults(text_of('snare = "oooo | ooo"\nsticking = "RLRL | RLRL"'))
    assert (found.line, found.column) == (4, 17)


def test_but_a_letter_without_a_stroke_in_a_sound_bar_is_named_all_the_same() -> None:
    found = faults(text_of('snare = "oo-- | ooo"\nsticking = "RLR- | RLRL"'))
    assert [(f.line, f.column) for f in found] == [(4, 17), (5, 15)]


def test_a_swung_eighth_may_be_written_as_the_last_of_three_cells() -> None:
    lines = 'ride = "x-x x-x x-x x-x"\nsticking = "RL RL RL RL"'
    assert [limb for _, limb in limbs(f"swing_ratio = 2\n{lines}")] == [R, L] * 4
    assert "says a hand" in faults(text_of(lines))[0].text

"""The thesis' five passes (figure 4.19) on the patterns that the captions of its figures 4.20–4.22 describe.

The expected hands and passes are worked out by hand from the printed algorithm.
"""

import numpy as np

from station.core.pieces import Limb, Piece
from station.motion.kit.kit import load_kit
from station.motion.sticking.limbs import Assignment, assign_limbs
from station.music.score import Score
from tests.unit.motion.patterns import ROCK, score_of

SEVEN = load_kit("seven_piece")
HAT, SNARE, HIGH, MID, FLOOR = Piece.HIHAT, Piece.SNARE, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1
SECOND, THIRD, FOURTH = "second pass", "third pass", "fourth pass"


def smed(score: Score) -> Assignment:
    return assign_limbs(score, SEVEN, "smed")


def hands(assignment: Assignment) -> str:
    return "".join("RLrl"[m] for m in assignment.limbs)


def passes(assignment: Assignment) -> list[str]:
    """Which pass spoke; two drums parted by their sides is the second's or the third's work."""
    return [next((p for p in (SECOND, THIRD, FOURTH) if p in why), why) for why in assignment.why]


def test_figure_4_20_quick_notes_on_different_drums_part_and_the_hats_are_left_to_the_fourth_pass() -> None:
    score = score_of(ROCK)
    assignment = smed(score)
    for note, limb, why in zip(score, assignment.limbs, passes(assignment), strict=True):
        with_snare = note.tick in {n.tick for n in score if n.piece is SNARE}
        if note.piece is Piece.KICK:
            assert (limb, why) == (Limb.RIGHT_FOOT, "the kick's foot")
        elif note.piece is SNARE:
            assert (limb, why) == (Limb.LEFT_HAND, "left and right drum at once")
        else:
            assert (limb, why) == (Limb.RIGHT_HAND, "left and right drum at once" if with_snare else FOURTH)


def test_figure_4_21_sixteenths_before_the_snare_are_skipped_and_then_assigned_backwards() -> None:
    """Hats up to a snare: it parts from the hat before it; what follows alternates on, what precedes back."""
    score = score_of([*((i, HAT) for i in range(4)), (4, SNARE), *((i, HAT) for i in range(5, 8))], tempo_bpm=120)
    assignment = smed(score)
    assert hands(assignment) == "LRLR" + "L" + "RLR"
    assert passes(assignment) == [THIRD] * 3 + ["left and right drum at once"] * 2 + [SECOND] * 3


def test_figure_4_22_a_fill_down_the_toms_comes_out_best() -> None:
    fill = [*((i, HIGH) for i in range(4)), *((i, MID) for i in range(4, 8)), *((i, FLOOR) for i in range(8, 12))]
    assignment = smed(score_of(fill, tempo_bpm=120))
    assert hands(assignment) == "RLRL" * 3
    assert passes(assignment) == [THIRD] * 3 + ["left and right drum at once"] * 2 + [SECOND] * 7


def test_figure_4_22_a_fill_that_ends_on_the_snare_crosses_over() -> None:
    """The alternation is carried on to the snare, where the right hand crosses over the left on the toms."""
    fill = [*((i, HIGH) for i in range(4)), *((i, MID) for i in range(4, 8)), *((i, SNARE) for i in range(8, 12))]
    score = score_of(fill, tempo_bpm=120)
    assert hands(smed(score)) == "RLRL" * 3
    assert crossings(score, smed(score).limbs) == 1
    assert crossings(score, assign_limbs(score, SEVEN).limbs) <= 1


def test_a_single_drum_alternates_from_the_note_on_the_simpler_division() -> None:
    """Nothing gives context, so the third pass begins from the last pair: the right hand has the eighth."""
    assignment = smed(score_of([(i, SNARE) for i in range(4)], tempo_bpm=120))
    assert hands(assignment) == "RLRL"


def test_slow_notes_alternate_in_the_fifth_pass_but_for_the_leading_hands_pieces() -> None:
    score = score_of([(0, SNARE), (4, SNARE), (8, HIGH), (12, FLOOR), (16, HAT), (20, Piece.RIDE)])
    assignment = smed(score)
    assert hands(assignment) == "RLRRRR"
    assert passes(assignment)[3:] == [FOURTH, FOURTH, "fixed to its hand (first pass)"]


def crossings(score: Score, limbs: np.ndarray) -> int:
    """Strokes that fall on the wrong side of the other hand's last one by more than 8 cm."""
    last: list[float | None] = [None, None]
    count = 0
    for note, limb in zip(score, limbs.tolist(), strict=True):
        x = float(SEVEN.target(note.piece, note.zone, Limb(limb)).point_m[0])
        other = last[1 - limb]
        if other is not None and (other - x if limb == Limb.RIGHT_HAND else x - other) > 0.08:
            count += 1
        last[limb] = x
    return count

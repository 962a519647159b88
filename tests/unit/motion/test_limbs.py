"""Limb assignment on the patterns that drummers' rules and the captions of the thesis' figures 4.20–4.22 describe."""

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.motion.hand_notes import Hands
from station.motion.kit import load_kit
from station.motion.limbs import METHODS, assign_limbs
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from tests.unit.motion.patterns import BACKBEAT, EIGHTH_HATS, ROCK, hand_letters, score_of

KIT = load_kit("four_piece")
SEVEN = load_kit("seven_piece")
HAT, SNARE, RIDE, TOM, FLOOR = Piece.HIHAT, Piece.SNARE, Piece.RIDE, Piece.TOM_1, Piece.FLOOR_TOM_1


def letters(items: object, piece: Piece, tempo_bpm: float = 100, division: int = 4, method: str = "station") -> str:
    score = score_of(items, tempo_bpm, division)  # type: ignore[arg-type]
    return hand_letters(score, assign_limbs(score, KIT, method).limbs, piece)


def sixteenths(piece: Piece, first: int, last: int) -> list[tuple[int, Piece]]:
    return [(i, piece) for i in range(first, last)]


@pytest.mark.parametrize("method", METHODS)
def test_rock_is_hats_right_snare_left_feet_on_the_pedals(method: str) -> None:
    score = score_of((*ROCK, (4, Piece.HIHAT_PEDAL)))
    limbs = assign_limbs(score, KIT, method).limbs
    assert hand_letters(score, limbs, HAT) == "R" * 8
    assert hand_letters(score, limbs, SNARE) == "LL"
    assert {Limb(m) for n, m in zip(score, limbs, strict=True) if n.piece is Piece.KICK} == {Limb.RIGHT_FOOT}
    assert {Limb(m) for n, m in zip(score, limbs, strict=True) if n.piece is Piece.HIHAT_PEDAL} == {Limb.LEFT_FOOT}


def test_an_ostinato_stays_in_one_hand_up_to_that_hands_speed() -> None:
    assert letters(sixteenths(HAT, 0, 16), HAT, tempo_bpm=80) == "R" * 16


def test_beyond_it_the_hands_alternate_and_the_leading_hand_takes_the_backbeat() -> None:
    groove = [(i, HAT) for i in range(16) if i not in (4, 12)] + list(BACKBEAT)
    assert letters(groove, HAT, tempo_bpm=120) == "RLRLLRLRLRLLRL"
    assert letters(groove, SNARE, tempo_bpm=120) == "RR"


def test_sixteenths_alternate_from_the_leading_hand() -> None:
    assert letters(sixteenths(SNARE, 0, 16), SNARE) == "RL" * 8


def test_triplets_alternate() -> None:
    assert letters(sixteenths(SNARE, 0, 12), SNARE, tempo_bpm=120, division=3) == "RL" * 6


def test_a_rest_does_not_shift_the_hands() -> None:
    """Natural sticking: the leading hand has the beat and the "and", the other "e" and "a"."""
    places = (0, 2, 3, 4, 6, 7, 8, 9, 11, 12, 14, 15)
    expected = "".join("R" if p % 2 == 0 else "L" for p in places)
    assert letters([(p, SNARE) for p in places], SNARE) == expected


def test_a_fill_down_the_toms_alternates() -> None:
    fill = sixteenths(SNARE, 0, 4) + sixteenths(TOM, 4, 8) + sixteenths(FLOOR, 8, 16)
    for piece, count in ((SNARE, 2), (TOM, 2), (FLOOR, 4)):
        assert letters(fill, piece, tempo_bpm=110) == "RL" * count


def test_a_roll_too_fast_for_singles_comes_out_as_doubles() -> None:
    """Thirty-seconds at 120 bpm are 16 strokes a second: one hand would have to single-stroke eight."""
    score = score_of(sixteenths(SNARE, 0, 32), 120, division=8)
    assignment = assign_limbs(score, KIT)
    assert hand_letters(score, assignment.limbs, SNARE) == "RRLL" * 8
    assert assignment.why[1] == "a double stroke: the second is the rebound"


@pytest.mark.parametrize(("ornament", "leads"), [(Ornament.FLAM, (25.0,)), (Ornament.DRAG, (110.0, 55.0))])
def test_grace_notes_fall_to_the_other_hand(ornament: Ornament, leads: tuple[float, ...]) -> None:
    notes = [Note(2 * PPQ, SNARE, velocity=30, ornament=ornament, lead_ms=lead) for lead in leads]
    score = Score.from_notes([*notes, Note(2 * PPQ, SNARE, velocity=100)], TempoMap.constant(100))
    hands = hand_letters(score, assign_limbs(score, KIT).limbs, SNARE)
    assert hands == "L" * len(leads) + "R"


def test_a_written_sticking_is_played_exactly() -> None:
    sticking = [Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.RIGHT_HAND, Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.RIGHT_HAND]
    notes = [Note(i * PPQ // 4, SNARE, limb=limb) for i, limb in enumerate(sticking)]
    score = Score.from_notes(notes, TempoMap.constant(100))
    for method in METHODS:
        assignment = assign_limbs(score, KIT, method)
        assert assignment.limbs.tolist() == [int(limb) for limb in sticking]
        assert set(assignment.why) == {"written"}


def test_a_partly_written_sticking_leads_the_rest() -> None:
    """A paradiddle's second half is written; what comes before it is free and stays possible."""
    notes = [Note(i * PPQ // 4, SNARE, limb=Limb.RIGHT_HAND if i == 1 else Limb.UNKNOWN) for i in range(3)]
    limbs = assign_limbs(Score.from_notes(notes, TempoMap.constant(160)), KIT).limbs
    assert limbs.tolist() == [Limb.LEFT_HAND, Limb.RIGHT_HAND, Limb.LEFT_HAND]


@pytest.mark.parametrize(
    ("hands", "hat", "snare"), [(Hands.RIGHT, "R", "L"), (Hands.LEFT, "L", "R"), (Hands.OPEN, "L", "R")]
)
def test_right_left_and_open_handed_players(hands: Hands, hat: str, snare: str) -> None:
    kit = load_kit("left_handed") if hands is Hands.LEFT else KIT
    score = score_of((*EIGHTH_HATS, *BACKBEAT))
    limbs = assign_limbs(score, kit, hands=hands).limbs
    assert hand_letters(score, limbs, HAT) == hat * 8
    assert hand_letters(score, limbs, SNARE) == snare * 2


def test_a_left_handed_kit_leads_with_the_left_and_kicks_with_the_left() -> None:
    score = score_of(ROCK)
    limbs = assign_limbs(score, load_kit("left_handed")).limbs
    assert hand_letters(score, limbs, HAT) == "L" * 8
    assert {Limb(m) for n, m in zip(score, limbs, strict=True) if n.piece is Piece.KICK} == {Limb.LEFT_FOOT}


def test_ghost_notes_between_the_hats_go_to_the_snares_hand() -> None:
    groove = [*EIGHTH_HATS, *BACKBEAT, (1, SNARE), (7, SNARE), (9, SNARE), (10, SNARE), (15, SNARE)]
    assert letters(groove, SNARE, tempo_bpm=95) == "L" * 7


def test_a_jazz_ride_is_the_leading_hands() -> None:
    groove = [(0, RIDE), (3, RIDE), (5, RIDE), (6, RIDE), (9, RIDE), (11, RIDE), (2, SNARE), (8, SNARE)]
    assert letters(groove, RIDE, tempo_bpm=160, division=3) == "R" * 6
    assert letters(groove, SNARE, tempo_bpm=160, division=3) == "LL"


def test_two_hands_never_share_an_instant() -> None:
    score = score_of([(0, SNARE), (0, Piece.CRASH_1), (4, FLOOR), (4, TOM), (8, HAT), (8, SNARE)])
    limbs = assign_limbs(score, KIT).limbs.reshape(3, 2)
    assert (limbs[:, 0] != limbs[:, 1]).all()


def test_what_no_human_can_is_told_with_its_bar() -> None:
    """Forty-eighths at 140 bpm on the crash and the floor tom at once: 28 strokes a second of each hand."""
    notes = [Note(4 * PPQ + i * PPQ // 12, p, Zone.HEAD) for i in range(24) for p in (SNARE, FLOOR)]
    warnings = assign_limbs(Score.from_notes(notes, TempoMap.constant(140)), KIT).warnings
    assert warnings
    assert all(w.startswith("bar 2 needs ") and "strokes a second of one hand" in w for w in warnings)


def test_a_playable_score_has_no_warnings() -> None:
    assert assign_limbs(score_of(ROCK), KIT).warnings == ()


def test_every_choice_has_its_reason() -> None:
    for method in METHODS:
        assert all(assign_limbs(score_of(ROCK), KIT, method).why)


def test_an_unknown_method_is_refused() -> None:
    with pytest.raises(BadInput, match="station and smed"):
        assign_limbs(score_of(ROCK), KIT, "random")


def test_an_empty_score_has_no_limbs() -> None:
    assert len(assign_limbs(Score.from_notes([], TempoMap.constant(100)), KIT).limbs) == 0


# --- the thesis' own algorithm ----------------------------------------------------------------------------------------


def test_figure_4_20_quick_notes_on_different_drums_part_and_hats_lead() -> None:
    score = score_of(ROCK)
    why = assign_limbs(score, KIT, "smed").why
    assert "left and right drum at once" in why  # second pass
    assert "the leading hand's piece (fourth pass)" in why
    assert "the kick's foot" in why  # first pass


def test_figure_4_21_sixteenths_before_a_snare_are_assigned_backward() -> None:
    """Hats in sixteenths up to a snare: the forward pass skips them, the third pass alternates back from it."""
    score = score_of([*sixteenths(HAT, 0, 4), (4, SNARE), *sixteenths(HAT, 5, 8)], tempo_bpm=120)
    assignment = assign_limbs(score, KIT, "smed")
    assert any("third pass" in reason for reason in assignment.why[:4])
    assert len({*zip(assignment.limbs[:-1].tolist(), assignment.limbs[1:].tolist(), strict=True)}) == 2  # alternates


def test_figure_4_22_a_fill_that_ends_on_the_snare_crosses_over_in_smed_alone() -> None:
    """High tom, mid tom, then snare in sixteenths: SMED's forward pass carries the alternation into a crossover."""
    fill = [*sixteenths(TOM, 0, 4), *sixteenths(Piece.TOM_2, 4, 8), *sixteenths(SNARE, 8, 12)]
    score = score_of(fill, tempo_bpm=120)
    smed, ours = (assign_limbs(score, SEVEN, method).limbs for method in ("smed", "station"))
    assert "".join("RL"[m] for m in smed) in ("RL" * 6, "LR" * 6)
    assert crossings(score, smed) >= crossings(score, ours)


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


def test_buzz_and_cross_stick_are_hands_work() -> None:
    notes = [Note(0, SNARE, articulation=Articulation.BUZZ), Note(PPQ, SNARE, articulation=Articulation.CROSS_STICK)]
    limbs = assign_limbs(Score.from_notes(notes, TempoMap.constant(100)), KIT).limbs
    assert set(limbs.tolist()) <= {Limb.RIGHT_HAND, Limb.LEFT_HAND}


def test_the_same_score_gives_the_same_limbs() -> None:
    score = score_of(ROCK)
    assert assign_limbs(score, KIT).limbs.tolist() == assign_limbs(score, KIT).limbs.tolist()

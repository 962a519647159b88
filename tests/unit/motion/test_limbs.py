"""Limb assignment on the patterns that drummers' rules and the captions of the thesis' figures 4.20–4.22 describe."""

import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.motion.kit.kit import load_kit
from station.motion.sticking.hand_choice import WORDS
from station.motion.sticking.hand_costs import AFTER_OWN, ALONE, BESIDE
from station.motion.sticking.hand_notes import Hands
from station.motion.sticking.limbs import METHODS, assign_limbs
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from tests.unit.motion.patterns import BACKBEAT, EIGHTH_HATS, ROCK, hand_letters, score_of

KIT = load_kit("four_piece")
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


def test_a_bounce_that_dies_away_stays_in_its_hand_while_the_other_is_away() -> None:
    """A recorded drummer's backbeat of 127, 33, 8 at 60 ms with the ride around it: no hand comes over for a bounce."""
    ms = PPQ / 600  # at 100 bpm
    snare = [Note(4 * PPQ + round(60 * i * ms), Piece.SNARE, velocity=v) for i, v in enumerate((127, 33, 8))]
    ride = [Note(4 * PPQ + round(at * ms), Piece.RIDE, Zone.BOW, 80) for at in (-300, 0, 200, 400)]
    score = Score.from_notes([*snare, *ride], TempoMap.constant(100))
    found = assign_limbs(score, KIT)
    assert hand_letters(score, found.limbs, Piece.SNARE) == "LLL"
    assert found.infeasible == ()


@pytest.mark.parametrize("tempo_bpm", [60, 100, 140, 180])
def test_a_snare_between_the_hats_is_the_other_hands(tempo_bpm: float) -> None:
    """Punk's eighths, hat and snare in turn: nobody goes to and fro with one hand."""
    beat = [(i, SNARE if i % 4 else HAT) for i in range(0, 16, 2)]
    assert letters(beat, HAT, tempo_bpm) == "RRRR"
    assert letters(beat, SNARE, tempo_bpm) == "LLLL"


def test_two_hands_do_not_lie_on_one_drum() -> None:
    clicks = [Note(i * PPQ // 4, SNARE, Zone.RIM, articulation=Articulation.CROSS_STICK) for i in range(8)]
    for hands, hand in ((Hands.RIGHT, Limb.LEFT_HAND), (Hands.LEFT, Limb.RIGHT_HAND)):
        limbs = assign_limbs(Score.from_notes(clicks, TempoMap.constant(115)), KIT, hands=hands).limbs
        assert set(limbs.tolist()) == {hand}


def test_a_diddles_second_stroke_is_on_the_same_drum() -> None:
    """Three on the snare and two on the tom are a double, a single and a double: no stick rebounds elsewhere."""
    drums = (SNARE, SNARE, SNARE, TOM, TOM)
    notes = [Note(i * PPQ // 8, drum, ornament=Ornament.DIDDLE) for i, drum in enumerate(drums)]
    limbs = assign_limbs(Score.from_notes(notes, TempoMap.constant(120)), KIT).limbs
    assert limbs[0] == limbs[1]
    assert limbs[2] != limbs[3]
    assert limbs[3] == limbs[4]


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


def test_an_open_handed_players_ride_is_the_right_hands() -> None:
    limbs = assign_limbs(score_of([*((i, RIDE) for i in range(0, 16, 2)), *BACKBEAT]), KIT, hands=Hands.OPEN).limbs
    assert "".join("RL"[m] for m in limbs) == "RRLRRRRLRR"


def test_a_left_handed_kit_leads_with_the_left_and_kicks_with_the_left() -> None:
    score = score_of(ROCK)
    limbs = assign_limbs(score, load_kit("left_handed")).limbs
    assert hand_letters(score, limbs, HAT) == "L" * 8
    assert {Limb(m) for n, m in zip(score, limbs, strict=True) if n.piece is Piece.KICK} == {Limb.LEFT_FOOT}


def all_letters(items: list[tuple[int, Piece]], tempo_bpm: float, division: int = 4) -> str:
    """The hands of every stroke in order; strokes at once in the order of `Piece`: the snare before the hat."""
    score = score_of(items, tempo_bpm, division)
    return "".join("RLrl"[m] for m in assign_limbs(score, KIT).limbs)


MID = Piece.TOM_2
TOMS_16 = [*sixteenths(SNARE, 0, 4), *sixteenths(TOM, 4, 8), *sixteenths(MID, 8, 12), *sixteenths(FLOOR, 12, 16)]
TOMS_3 = [*sixteenths(SNARE, 0, 3), *sixteenths(TOM, 3, 6), *sixteenths(MID, 6, 9), *sixteenths(FLOOR, 9, 12)]
HATS_16 = sixteenths(HAT, 0, 16)
HATS_BETWEEN = [(i, HAT) for i in range(16) if i not in (4, 12)]


@pytest.mark.parametrize("tempo_bpm", [80, 100])
def test_sixteenth_hats_to_100_bpm_are_one_hands_also_under_the_backbeat(tempo_bpm: float) -> None:
    assert all_letters([*HATS_16, *BACKBEAT], tempo_bpm) == "RRRRLRRRRRRRRLRRRR"
    assert all_letters([*HATS_BETWEEN, *BACKBEAT], tempo_bpm) == "RRRRLRRRRRRRLRRR"


@pytest.mark.parametrize("tempo_bpm", [110, 120, 140, 160])
def test_quicker_hats_alternate_around_a_backbeat_of_the_leading_hand(tempo_bpm: float) -> None:
    assert all_letters([*HATS_BETWEEN, *BACKBEAT], tempo_bpm) == "RL" * 8
    assert letters([*HATS_16, *BACKBEAT], SNARE, tempo_bpm) == "RR"


def test_eighth_hats_too_quick_for_one_hand_alternate_too() -> None:
    """At 240 bpm eighths are as quick as sixteenths at 120."""
    assert letters([(i, HAT) for i in range(0, 16, 2)], HAT, 200) == "R" * 8
    assert letters([(i, HAT) for i in range(0, 16, 2)], HAT, 240) == "RL" * 4


def test_a_swung_rides_skip_note_stays_in_the_leading_hand() -> None:
    """Triplets at 200 bpm: the skip note comes 100 ms before the beat."""
    ride = [(i, RIDE) for beat in range(0, 12, 6) for i in (beat, beat + 3, beat + 5)]
    assert letters(ride, RIDE, 200, division=3) == "R" * 6


@pytest.mark.parametrize("tempo_bpm", [80, 120, 160, 180])
def test_sixteenths_around_the_toms_alternate(tempo_bpm: float) -> None:
    assert all_letters(TOMS_16, tempo_bpm) == "RL" * 8


@pytest.mark.parametrize("tempo_bpm", [100, 120, 140])
def test_triplets_around_the_toms_alternate(tempo_bpm: float) -> None:
    assert all_letters(TOMS_3, tempo_bpm, division=3) == "RL" * 6


def test_rests_in_a_fill_over_two_drums_do_not_shift_the_hands() -> None:
    fill = [(p, SNARE) for p in (0, 2, 3, 4, 6, 7)] + [(p, TOM) for p in (8, 9, 11, 12, 14, 15)]
    assert all_letters(fill, 110) == "RRLRRLRLLRRL"


@pytest.mark.parametrize(
    ("tempo_bpm", "hands"), [(60, "RL" * 16), (100, "RL" * 16), (120, "RRLL" * 8), (140, "RRLL" * 8)]
)
def test_thirty_seconds_are_singles_to_100_bpm_and_doubles_beyond(tempo_bpm: float, hands: str) -> None:
    """100 bpm: 6.7 strokes a second of each hand; 120 bpm: 8."""
    assert all_letters(sixteenths(SNARE, 0, 32), tempo_bpm, division=8) == hands


@pytest.mark.parametrize("sticking", ["RLRRLRLL", "RLLRRL", "RRLRLLRLR"])
def test_a_written_rudiment_is_played_as_written(sticking: str) -> None:
    notes = [Note(i * PPQ // 8, SNARE, limb=Limb("RL".index(hand))) for i, hand in enumerate(sticking)]
    limbs = assign_limbs(Score.from_notes(notes, TempoMap.constant(90)), KIT).limbs
    assert "".join("RL"[m] for m in limbs) == sticking


def test_a_third_note_at_once_says_that_it_is_impossible() -> None:
    score = score_of([(0, HAT), (0, RIDE), (0, Piece.CRASH_1), (4, SNARE)])
    assignment = assign_limbs(score, KIT)
    assert [why.startswith("impossible") for why in assignment.why].count(True) == 1
    assert len(assignment.warnings) == 1
    assert assignment.warnings[0].startswith("bar 1 needs one hand to be in two places at once")


def test_a_third_stroke_at_once_on_one_drum_is_impossible_too() -> None:
    assignment = assign_limbs(score_of([(0, SNARE), (0, SNARE), (0, SNARE), (4, SNARE)]), KIT)
    assert [why.startswith("impossible") for why in assignment.why] == [False, False, True, False]
    assert assignment.warnings == ("bar 1 needs one hand to strike twice at once",)
    assert assign_limbs(score_of([(0, SNARE), (0, SNARE), (4, SNARE)]), KIT).warnings == ()


def test_the_hat_under_the_foot_is_no_hands() -> None:
    score = score_of([(0, HAT), (2, Piece.HIHAT_PEDAL), (4, SNARE), (4, HAT), (6, Piece.HIHAT_PEDAL)])
    assert "".join("RLrl"[m] for m in assign_limbs(score, KIT).limbs) == "RlLRl"


def test_an_open_handed_player_keeps_the_feet_where_the_pedals_are() -> None:
    limbs = assign_limbs(score_of(ROCK), KIT, hands=Hands.LEFT).limbs
    assert Limb.RIGHT_FOOT in limbs
    assert Limb.LEFT_FOOT not in limbs


def test_a_fills_reasons_speak_of_what_decided() -> None:
    why = assign_limbs(score_of([*HATS_16, *BACKBEAT], 120), KIT).why
    assert set(why) <= {*ALONE, *AFTER_OWN, *BESIDE, *WORDS}
    hats = assign_limbs(score_of(HATS_16, 100), KIT).why
    assert set(hats) == {"the ostinato's hand"}


def test_ghost_notes_between_the_hats_go_to_the_snares_hand() -> None:
    groove = [*EIGHTH_HATS, *BACKBEAT, (1, SNARE), (7, SNARE), (9, SNARE), (10, SNARE), (15, SNARE)]
    assert letters(groove, SNARE, tempo_bpm=95) == "L" * 7


def test_a_jazz_ride_is_the_leading_hands() -> None:
    groove = [(0, RIDE), (3, RIDE), (5, RIDE), (6, RIDE), (9, RIDE), (11, RIDE), (2, SNARE), (8, SNARE)]
    assert letters(groove, RIDE, tempo_bpm=160, division=3) == "R" * 6
    assert letters(groove, SNARE, tempo_bpm=160, division=3) == "LL"


@pytest.mark.parametrize("tempo_bpm", [200, 240, 300])
def test_in_blast_beats_each_hand_stays_on_its_piece(tempo_bpm: float) -> None:
    """Hat and snare at once in eighths, up to 10 a second: hands that change places would strike as often."""
    blast = [(i, piece) for i in range(0, 32, 2) for piece in (HAT, SNARE, Piece.KICK)]
    assert letters(blast, SNARE, tempo_bpm) == "L" * 16
    assert letters(blast, HAT, tempo_bpm) == "R" * 16
    assert assign_limbs(score_of(blast, tempo_bpm), KIT).warnings == ()  # a champion's rate, no way to go


def test_two_hands_never_share_an_instant() -> None:
    score = score_of([(0, SNARE), (0, Piece.CRASH_1), (4, FLOOR), (4, TOM), (8, HAT), (8, SNARE)])
    limbs = assign_limbs(score, KIT).limbs.reshape(3, 2)
    assert (limbs[:, 0] != limbs[:, 1]).all()


def test_every_choice_has_its_reason() -> None:
    for method in METHODS:
        assert all(assign_limbs(score_of(ROCK), KIT, method).why)


def test_an_unknown_method_is_refused() -> None:
    with pytest.raises(BadInput, match="station and smed"):
        assign_limbs(score_of(ROCK), KIT, "random")


def test_an_empty_score_has_no_limbs() -> None:
    assert len(assign_limbs(Score.from_notes([], TempoMap.constant(100)), KIT).limbs) == 0


def test_buzz_and_cross_stick_are_hands_work() -> None:
    notes = [Note(0, SNARE, articulation=Articulation.BUZZ), Note(PPQ, SNARE, articulation=Articulation.CROSS_STICK)]
    limbs = assign_limbs(Score.from_notes(notes, TempoMap.constant(100)), KIT).limbs
    assert set(limbs.tolist()) <= {Limb.RIGHT_HAND, Limb.LEFT_HAND}


def test_the_same_score_gives_the_same_limbs() -> None:
    score = score_of(ROCK)
    assert assign_limbs(score, KIT).limbs.tolist() == assign_limbs(score, KIT).limbs.tolist()

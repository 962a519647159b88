"""What letters become in the score; ticks by hand, leads and velocity shares from HUMANS' flam and drag figures."""

from itertools import pairwise

import pytest

from station.core.note_map import NoteMeaning, general_midi_note
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from tests.unit.drills.reading import (
    EIGHTH,
    QUARTER,
    SIXTEENTH,
    THIRTY_SECOND,
    TRIPLET,
    WHOLE,
    faults,
    notes,
    read,
    text_of,
)

GHOST, NORMAL, ACCENT = 32, 80, 116


def test_dynamics_have_the_velocities_of_the_default_table() -> None:
    found = notes('snare = "ogO-"')
    assert [(n.dynamic, n.velocity) for n in found] == [
        (Dynamic.NORMAL, NORMAL),
        (Dynamic.GHOST, GHOST),
        (Dynamic.ACCENT, ACCENT),
    ]
    assert 20 <= GHOST <= 45
    assert 60 <= NORMAL <= 95
    assert 105 <= ACCENT <= 127


def test_dynamics_can_be_set_for_all_and_for_one_piece() -> None:
    head = "tempo_bpm = 60\n[dynamics]\naccent = 110\n[dynamics.kick]\nnormal = 100"
    found = {(n.piece, n.dynamic): n.velocity for n in notes('snare = "goO-"\nkick = "oO--"', head)}
    assert found == {
        (Piece.SNARE, Dynamic.GHOST): 32,
        (Piece.SNARE, Dynamic.NORMAL): 80,
        (Piece.SNARE, Dynamic.ACCENT): 110,
        (Piece.KICK, Dynamic.NORMAL): 100,
        (Piece.KICK, Dynamic.ACCENT): 110,
    }


@pytest.mark.parametrize(
    ("line", "letter", "meaning", "midi"),
    [
        ("kick", "o", NoteMeaning(Piece.KICK, Zone.HEAD), 36),
        ("snare", "o", NoteMeaning(Piece.SNARE, Zone.HEAD), 38),
        ("snare", "x", NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK), 37),
        ("snare", "r", NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT), 40),
        ("hihat", "x", NoteMeaning(Piece.HIHAT, Zone.BOW, Articulation.NORMAL, 0.0), 42),
        ("hihat", "h", NoteMeaning(Piece.HIHAT, Zone.BOW, Articulation.NORMAL, 0.5), 46),
        ("hihat", "o", NoteMeaning(Piece.HIHAT, Zone.BOW, Articulation.NORMAL, 1.0), 46),
        ("hihat", "e", NoteMeaning(Piece.HIHAT, Zone.EDGE, Articulation.NORMAL, 0.0), 42),
        ("hihat", "s", NoteMeaning(Piece.HIHAT, Zone.EDGE, Articulation.NORMAL, 0.5), 46),
        ("hihat", "w", NoteMeaning(Piece.HIHAT, Zone.EDGE, Articulation.NORMAL, 1.0), 46),
        ("hihat_pedal", "x", NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, 0.0), 44),
        ("hihat_pedal", "o", NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH, 1.0), 44),
        ("ride", "x", NoteMeaning(Piece.RIDE, Zone.BOW), 51),
        ("ride", "b", NoteMeaning(Piece.RIDE, Zone.BELL), 53),
        ("ride", "e", NoteMeaning(Piece.RIDE, Zone.EDGE), 51),
        ("crash", "x", NoteMeaning(Piece.CRASH_1, Zone.EDGE), 49),
        ("crash_2", "t", NoteMeaning(Piece.CRASH_2, Zone.BOW), 57),
        ("tom_1", "x", NoteMeaning(Piece.TOM_1, Zone.RIM), 50),
        ("floor_tom", "o", NoteMeaning(Piece.FLOOR_TOM_1, Zone.HEAD), 43),
        ("cowbell", "x", NoteMeaning(Piece.COWBELL, Zone.HEAD), 56),
    ],
)
def test_letters_mean_what_drummers_read(line: str, letter: str, meaning: NoteMeaning, midi: int) -> None:
    for written, dynamic in ((letter, Dynamic.NORMAL), (letter.upper(), Dynamic.ACCENT)):
        (note,) = notes(f'{line} = "{written}---"')
        assert NoteMeaning(note.piece, note.zone, note.articulation, note.openness) == meaning
        assert note.dynamic is dynamic
        assert general_midi_note(note.piece, note.zone, note.articulation, note.openness) == midi


def test_a_flam_has_one_soft_grace_stroke_by_the_other_hand() -> None:
    grace, main = notes('snare = "-f--"\nsticking = "-R--"')
    assert (grace.tick, grace.lead_ms, grace.limb, grace.velocity) == (QUARTER, 30, Limb.LEFT_HAND, 32)  # 0.4 of 80
    assert (main.tick, main.lead_ms, main.limb, main.velocity) == (QUARTER, 0, Limb.RIGHT_HAND, NORMAL)
    assert grace.ornament is main.ornament is Ornament.FLAM
    assert grace.dynamic is Dynamic.GHOST


def test_an_accented_flam_leads_a_little_louder() -> None:
    grace, main = notes('snare = "F---"')
    assert (grace.velocity, main.velocity) == (46, ACCENT)  # 0.4 of 116 is 46.4
    assert grace.limb is main.limb is Limb.UNKNOWN


def test_a_drag_has_two_grace_strokes_of_one_hand() -> None:
    first, second, main = notes('snare = "d---"\nsticking = "L---"')
    assert [n.lead_ms for n in (first, second, main)] == [110, 55, 0]
    assert [n.limb for n in (first, second, main)] == [Limb.RIGHT_HAND, Limb.RIGHT_HAND, Limb.LEFT_HAND]
    for a, b in pairwise((first, second, main)):
        assert 40 <= a.lead_ms - b.lead_ms <= 70
    assert {first.ornament, second.ornament, main.ornament} == {Ornament.DRAG}


def test_a_grace_stroke_on_the_first_beat_sounds_before_it() -> None:
    assert read('snare = "f---"').score.onset_ns.tolist() == [-30_000_000, 0]


def test_a_diddle_is_two_strokes_of_one_hand_in_its_cell() -> None:
    found = notes('snare = "o-t- ---- ---- ----"\nsticking = "R-L- ---- ---- ----"')
    assert [(n.tick, n.limb, n.ornament) for n in found] == [
        (0, Limb.RIGHT_HAND, Ornament.NONE),
        (2 * SIXTEENTH, Limb.LEFT_HAND, Ornament.DIDDLE),
        (2 * SIXTEENTH + THIRTY_SECOND, Limb.LEFT_HAND, Ornament.DIDDLE),
    ]
    assert THIRTY_SECOND == 13440


def test_the_accent_of_a_diddle_is_on_its_first_stroke() -> None:
    assert [n.velocity for n in notes('snare = "T---"')] == [ACCENT, NORMAL]


def test_diddles_that_touch_are_a_roll() -> None:
    found = notes('snare = "tto- t--- ---- ----"')
    assert [n.ornament for n in found] == [Ornament.ROLL] * 4 + [Ornament.NONE] + [Ornament.DIDDLE] * 2
    assert [n.tick for n in found[:4]] == [0, THIRTY_SECOND, SIXTEENTH, SIXTEENTH + THIRTY_SECOND]


def test_a_roll_goes_over_the_bar_line() -> None:
    found = notes('snare = "---- ---- ---- ---t | t--- ---- ---- ----"')
    assert {n.ornament for n in found} == {Ornament.ROLL}


def test_a_buzz_is_one_row_that_lasts_its_cells() -> None:
    short, long = notes('snare = "b--- b~~~ ---- ----"')
    assert (short.duration_ticks, long.duration_ticks) == (SIXTEENTH, QUARTER)
    assert short.articulation is Articulation.BUZZ
    assert short.ornament is Ornament.ROLL


def test_a_buzz_goes_on_over_the_bar_line_and_in_other_divisions() -> None:
    (note,) = notes('snare = "---b | ~-- --- --- ---"')
    assert note.duration_ticks == QUARTER + TRIPLET


def test_a_choke_counts_from_the_stroke_before_it() -> None:
    first, second = notes('crash = "x-#- | --x#"')
    assert (first.tick, first.choke_ticks) == (0, 2 * QUARTER)
    assert (second.tick, second.choke_ticks) == (WHOLE + 2 * QUARTER, QUARTER)


def test_a_cymbal_is_grabbed_once() -> None:
    (fault,) = faults(text_of('crash = "x#-#"'))
    assert (fault.line, fault.column) == (4, 13)
    assert "no stroke that still rings" in fault.text


def test_nothing_to_grab() -> None:
    (fault,) = faults(text_of('crash = "#-x-"'))
    assert (fault.line, fault.column) == (4, 10)


def test_feet_play_the_pedals() -> None:
    found = {n.piece: n.limb for n in notes('kick = "o---"\nhihat_pedal = "-x--"\nsnare = "--o-"')}
    assert found == {
        Piece.KICK: Limb.RIGHT_FOOT,
        Piece.HIHAT_PEDAL: Limb.LEFT_FOOT,
        Piece.SNARE: Limb.UNKNOWN,
    }


def test_limb_tables_say_who_plays() -> None:
    found = notes('right_hand.hihat = "x---"\nleft_hand.snare = "-o--"\nleft_foot.kick = "--o-"\nkick = "---o"')
    assert [n.limb for n in found] == [Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.LEFT_FOOT, Limb.RIGHT_FOOT]


def test_both_hands_may_strike_one_drum() -> None:
    found = notes('right_hand.snare = "o---"\nleft_hand.snare = "o---"')
    assert {n.limb for n in found} == {Limb.RIGHT_HAND, Limb.LEFT_HAND}
    assert [n.tick for n in found] == [0, 0]


def test_eighths_are_half_a_quarter() -> None:
    assert 2 * EIGHTH == QUARTER


def test_soft_flams_drags_and_diddles_are_as_soft_as_ghosts() -> None:
    """Grace strokes at 0.4 of 32: 12.8."""
    found = notes('snare = "vwu-"\nsticking = "RLR-"')
    assert [(n.ornament, n.lead_ms, n.velocity) for n in found] == [
        *((Ornament.FLAM, 30, 13), (Ornament.FLAM, 0, GHOST)),
        *((Ornament.DRAG, 110, 13), (Ornament.DRAG, 55, 13), (Ornament.DRAG, 0, GHOST)),
        *((Ornament.DIDDLE, 0, GHOST), (Ornament.DIDDLE, 0, GHOST)),
    ]
    assert {n.dynamic for n in found} == {Dynamic.GHOST}


def test_a_soft_buzz_goes_on_as_any_buzz() -> None:
    (note,) = notes('tom_1 = "z~--"')
    assert (note.articulation, note.velocity, note.duration_ticks) == (Articulation.BUZZ, GHOST, 2 * QUARTER)


def test_soft_diddles_that_touch_are_a_soft_roll() -> None:
    assert [(n.ornament, n.velocity) for n in notes('snare = "uuu- ----"')] == [(Ornament.ROLL, GHOST)] * 6


def test_a_diddle_shares_a_cell_that_divides_no_beat_exactly() -> None:
    """The second of nine cells reaches from round(11946.67) to round(23893.33); its middle is half of 11946 later."""
    assert [n.tick for n in notes('snare = "(-t-------) ---"', "tempo_bpm = 20")] == [11947, 11947 + 5973]

"""Note numbers and what they mean, against the published tables."""

import pytest

from station.core.note_map import GENERAL_MIDI, V_DRUMS, KitMap, NoteMeaning, general_midi_note, guess_map, strike_of
from station.core.pieces import Articulation, Piece, Zone

GM_1 = {
    35: Piece.KICK,
    36: Piece.KICK,
    37: Piece.SNARE,
    38: Piece.SNARE,
    40: Piece.SNARE,
    41: Piece.FLOOR_TOM_2,
    42: Piece.HIHAT,
    43: Piece.FLOOR_TOM_1,
    44: Piece.HIHAT_PEDAL,
    46: Piece.HIHAT,
    49: Piece.CRASH_1,
    51: Piece.RIDE,
    52: Piece.CHINA,
    53: Piece.RIDE,
    55: Piece.SPLASH,
    56: Piece.COWBELL,
    57: Piece.CRASH_2,
    59: Piece.RIDE_2,
}
"""General MIDI 1 percussion (RP-003): the drum set's numbers."""

TD_11 = {
    36: (Piece.KICK, Zone.HEAD),
    38: (Piece.SNARE, Zone.HEAD),
    48: (Piece.TOM_1, Zone.HEAD),
    50: (Piece.TOM_1, Zone.RIM),
    45: (Piece.TOM_2, Zone.HEAD),
    47: (Piece.TOM_2, Zone.RIM),
    43: (Piece.FLOOR_TOM_1, Zone.HEAD),
    58: (Piece.FLOOR_TOM_1, Zone.RIM),
    46: (Piece.HIHAT, Zone.BOW),
    26: (Piece.HIHAT, Zone.EDGE),
    42: (Piece.HIHAT, Zone.BOW),
    22: (Piece.HIHAT, Zone.EDGE),
    44: (Piece.HIHAT_PEDAL, Zone.PEDAL),
    49: (Piece.CRASH_1, Zone.BOW),
    55: (Piece.CRASH_1, Zone.EDGE),
    57: (Piece.CRASH_2, Zone.BOW),
    52: (Piece.CRASH_2, Zone.EDGE),
    51: (Piece.RIDE, Zone.BOW),
    59: (Piece.RIDE, Zone.EDGE),
    53: (Piece.RIDE, Zone.BELL),
}
"""The Groove MIDI Dataset's table of what a Roland TD-11 sends."""


@pytest.mark.parametrize(("number", "piece"), GM_1.items())
def test_general_midi(number: int, piece: Piece) -> None:
    assert GENERAL_MIDI[number].piece is piece


@pytest.mark.parametrize(("number", "struck"), TD_11.items())
def test_v_drums(number: int, struck: tuple[Piece, Zone]) -> None:
    assert (V_DRUMS[number].piece, V_DRUMS[number].zone) == struck


def test_the_general_midi_toms_fall_in_pitch_from_50_to_41() -> None:
    toms = [GENERAL_MIDI[n].piece for n in (50, 48, 47, 45, 43, 41)]
    assert toms == sorted(toms)
    assert len(set(toms)) == 6


@pytest.mark.parametrize(
    ("numbers", "guess"),
    [({36, 38, 42}, GENERAL_MIDI), ({36, 38, 22}, V_DRUMS), ({26}, V_DRUMS), (set(), GENERAL_MIDI)],
)
def test_numbers_that_only_v_drums_send_tell_the_map(numbers: set[int], guess: KitMap) -> None:
    assert guess_map(numbers) is guess


def test_an_unknown_number_is_percussion() -> None:
    assert strike_of(76, GENERAL_MIDI) == NoteMeaning(Piece.PERCUSSION)


@pytest.mark.parametrize("piece", Piece)
def test_every_piece_has_a_number_that_reads_back_as_itself(piece: Piece) -> None:
    number = general_midi_note(piece, Zone.HEAD, Articulation.NORMAL)
    assert 35 <= number <= 81, "General MIDI sounds no others"
    assert strike_of(number, GENERAL_MIDI).piece is piece


@pytest.mark.parametrize(
    ("zone", "articulation", "openness", "piece", "number"),
    [
        (Zone.HEAD, Articulation.NORMAL, None, Piece.KICK, 36),
        (Zone.HEAD, Articulation.NORMAL, None, Piece.SNARE, 38),
        (Zone.RIM, Articulation.CROSS_STICK, None, Piece.SNARE, 37),
        (Zone.RIM, Articulation.RIM_SHOT, None, Piece.SNARE, 40),
        (Zone.BELL, Articulation.NORMAL, None, Piece.RIDE, 53),
        (Zone.BOW, Articulation.NORMAL, None, Piece.RIDE, 51),
        (Zone.BOW, Articulation.NORMAL, 0.0, Piece.HIHAT, 42),
        (Zone.EDGE, Articulation.NORMAL, 0.49, Piece.HIHAT, 42),
        (Zone.BOW, Articulation.NORMAL, 0.5, Piece.HIHAT, 46),
        (Zone.EDGE, Articulation.NORMAL, None, Piece.HIHAT, 42),
        (Zone.PEDAL, Articulation.CHICK, None, Piece.HIHAT_PEDAL, 44),
    ],
)
def test_the_number_that_sounds_closest(
    zone: Zone, articulation: Articulation, openness: float | None, piece: Piece, number: int
) -> None:
    assert general_midi_note(piece, zone, articulation, openness) == number

import pytest

from station.core.pieces import Articulation, Piece, Zone
from station.devices.midi.midi_encoder import all_off, choke, note_off, note_on, pedal

# General MIDI level 1 percussion (RP-003, table 3) on channel 10, written out by hand.
STROKES = [
    ((Piece.KICK, Zone.HEAD, Articulation.NORMAL, 100), ["99 24 64"]),
    ((Piece.SNARE, Zone.HEAD, Articulation.NORMAL, 1), ["99 26 01"]),
    ((Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK, 90), ["99 25 5a"]),
    ((Piece.CRASH_1, Zone.EDGE, Articulation.NORMAL, 127), ["99 31 7f"]),
    ((Piece.RIDE, Zone.BELL, Articulation.NORMAL, 80), ["99 35 50"]),
    ((Piece.HIHAT, Zone.BOW, Articulation.NORMAL, 80), ["99 2a 50"]),
    ((Piece.HIHAT, Zone.BOW, Articulation.NORMAL, 80, 0.0), ["b9 04 7f", "99 2a 50"]),
    ((Piece.HIHAT, Zone.EDGE, Articulation.NORMAL, 80, 1.0), ["b9 04 00", "99 2e 50"]),
    ((Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, 70), ["99 2c 46"]),
]


@pytest.mark.parametrize(("stroke", "expected"), STROKES)
def test_a_stroke_is_general_midi(stroke: tuple[Piece, Zone, Articulation, int], expected: list[str]) -> None:
    assert [message.hex(" ") for message in note_on(*stroke)] == expected


def test_a_note_is_ended_by_its_own_number() -> None:
    assert note_off(Piece.HIHAT, Zone.BOW, Articulation.NORMAL, 1.0).hex(" ") == "89 2e 00"


def test_a_hand_grabs_and_lets_go() -> None:
    assert [message.hex(" ") for message in choke(Piece.CRASH_2, Zone.EDGE)] == ["a9 39 7f", "a9 39 00"]


@pytest.mark.parametrize(("openness", "value"), [(0.0, 127), (0.5, 64), (1.0, 0), (-3.0, 127), (7.0, 0)])
def test_the_pedal_is_turned_round(openness: float, value: int) -> None:
    assert pedal(openness)[2] == value


def test_all_notes_end() -> None:
    assert all_off().hex(" ") == "b9 7b 00"

"""Where each piece stands on the staff, and with which head.

Steps count half spaces up from the bottom line (E4 on a treble staff, which percussion parts are read against): kick
F4, snare C5, toms E5 D5 A4, hi-hat G5, ride F5, crash A5, foot hi-hat D4. Source: Weinberg, "Guidelines for Drumset
Notation" (Percussive Arts Society, 1994), and our choice for pieces that it leaves open. Hands' stems point up, feet's
down.
"""

from dataclasses import dataclass
from enum import IntEnum

from station.core.pieces import CYMBALS, Articulation, Piece, Zone

MIDDLE_LINE = 4
TOP_LINE = 8


class NoteHead(IntEnum):
    """The shape of a note's head."""

    ROUND = 0
    CROSS = 1
    DIAMOND = 2
    TRIANGLE = 3
    RINGED_CROSS = 4
    HEAVY_CROSS = 5
    ORNATE_CROSS = 6
    HOLLOW_DIAMOND = 7
    SLASHED = 8


@dataclass(frozen=True, slots=True)
class StaffPlace:
    """A piece's step on the staff and its usual head."""

    step: int
    head: NoteHead = NoteHead.ROUND


PLACES: dict[Piece, StaffPlace] = {
    Piece.KICK: StaffPlace(1),
    Piece.SNARE: StaffPlace(5),
    Piece.HIHAT: StaffPlace(9, NoteHead.CROSS),
    Piece.HIHAT_PEDAL: StaffPlace(-1, NoteHead.CROSS),
    Piece.RIDE: StaffPlace(8, NoteHead.CROSS),
    Piece.RIDE_2: StaffPlace(8, NoteHead.RINGED_CROSS),
    Piece.CRASH_1: StaffPlace(10, NoteHead.CROSS),
    Piece.CRASH_2: StaffPlace(11, NoteHead.CROSS),
    Piece.SPLASH: StaffPlace(12, NoteHead.CROSS),
    Piece.CHINA: StaffPlace(11, NoteHead.RINGED_CROSS),
    Piece.TOM_1: StaffPlace(7),
    Piece.TOM_2: StaffPlace(6),
    Piece.TOM_3: StaffPlace(4),
    Piece.TOM_4: StaffPlace(2),
    Piece.FLOOR_TOM_1: StaffPlace(3),
    Piece.FLOOR_TOM_2: StaffPlace(0),
    Piece.COWBELL: StaffPlace(10, NoteHead.TRIANGLE),
    Piece.TAMBOURINE: StaffPlace(11, NoteHead.TRIANGLE),
    Piece.CLAP: StaffPlace(5, NoteHead.TRIANGLE),
    Piece.PERCUSSION: StaffPlace(12, NoteHead.TRIANGLE),
}

FOOT_PIECES = frozenset({Piece.KICK, Piece.HIHAT_PEDAL})
_EDGED = CYMBALS - {Piece.RIDE, Piece.RIDE_2}
"""Cymbals that are struck on the edge as a rule; the others are on the bow."""
_BELLS = {NoteHead.CROSS: NoteHead.DIAMOND, NoteHead.RINGED_CROSS: NoteHead.HOLLOW_DIAMOND}
_OTHER_ZONES = {NoteHead.CROSS: NoteHead.HEAVY_CROSS, NoteHead.RINGED_CROSS: NoteHead.ORNATE_CROSS}
"""The heads of a cymbal's bell, and of its bow or edge where that is not struck as a rule, by its usual head."""


def step_of(piece: Piece) -> int:
    """The step that a piece stands on."""
    return PLACES[piece].step


def head_of(piece: Piece, zone: Zone, articulation: Articulation) -> NoteHead:
    """The head that a stroke is written with: no two of one step mean different pieces or zones."""
    usual = PLACES[piece].head
    if articulation is Articulation.CROSS_STICK:
        return NoteHead.CROSS
    if articulation is Articulation.RIM_SHOT:
        return NoteHead.SLASHED
    if zone is Zone.RIM and articulation is Articulation.NORMAL:
        return NoteHead.HEAVY_CROSS
    if zone is Zone.BELL:
        return _BELLS.get(usual, usual)
    if zone is (Zone.BOW if piece in _EDGED else Zone.EDGE):
        return _OTHER_ZONES.get(usual, usual)
    return usual


def height(step: float) -> float:
    """Staff spaces **down** from the middle line to `step`."""
    return (MIDDLE_LINE - step) / 2


def ledger_steps(step: int) -> range:
    """The steps of the short extra lines that a head at `step` needs above or below the staff."""
    if step > TOP_LINE:
        return range(TOP_LINE + 2, step + 1, 2)
    return range(-2, step - 1, -2)

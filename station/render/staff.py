"""Where each piece stands on the staff, and with which head.

Steps count half spaces up from the bottom line (E4 on a treble staff, which percussion parts are read against): kick
F4, snare C5, toms E5 D5 A4, hi-hat G5, ride F5, crash A5, foot hi-hat D4. Source: Weinberg, "Guidelines for Drumset
Notation" (Percussive Arts Society, 1994), and our choice for pieces that it leaves open. Hands' stems point up, feet's
down.
"""

from dataclasses import dataclass
from enum import IntEnum

from station.core.pieces import Articulation, Piece, Zone

MIDDLE_LINE = 4
TOP_LINE = 8


class Head(IntEnum):
    """The shape of a note's head."""

    ROUND = 0
    CROSS = 1
    DIAMOND = 2
    TRIANGLE = 3
    RINGED_CROSS = 4


@dataclass(frozen=True, slots=True)
class Place:
    """A piece's step on the staff and its usual head."""

    step: int
    head: Head = Head.ROUND


PLACES: dict[Piece, Place] = {
    Piece.KICK: Place(1),
    Piece.SNARE: Place(5),
    Piece.HIHAT: Place(9, Head.CROSS),
    Piece.HIHAT_PEDAL: Place(-1, Head.CROSS),
    Piece.RIDE: Place(8, Head.CROSS),
    Piece.RIDE_2: Place(8, Head.RINGED_CROSS),
    Piece.CRASH_1: Place(10, Head.CROSS),
    Piece.CRASH_2: Place(11, Head.CROSS),
    Piece.SPLASH: Place(12, Head.CROSS),
    Piece.CHINA: Place(11, Head.RINGED_CROSS),
    Piece.TOM_1: Place(7),
    Piece.TOM_2: Place(6),
    Piece.TOM_3: Place(4),
    Piece.TOM_4: Place(2),
    Piece.FLOOR_TOM_1: Place(3),
    Piece.FLOOR_TOM_2: Place(0),
    Piece.COWBELL: Place(7, Head.TRIANGLE),
    Piece.TAMBOURINE: Place(10, Head.TRIANGLE),
    Piece.CLAP: Place(5, Head.TRIANGLE),
    Piece.PERCUSSION: Place(12, Head.TRIANGLE),
}

FOOT_PIECES = frozenset({Piece.KICK, Piece.HIHAT_PEDAL})


def head_of(piece: Piece, zone: Zone, articulation: Articulation) -> Head:
    """The head that a stroke is written with."""
    if articulation is Articulation.CROSS_STICK:
        return Head.CROSS
    if zone is Zone.BELL:
        return Head.DIAMOND
    return PLACES[piece].head


def height(step: float) -> float:
    """Staff spaces **down** from the middle line to `step`."""
    return (MIDDLE_LINE - step) / 2


def ledger_steps(step: int) -> range:
    """The steps of the short extra lines that a head at `step` needs above or below the staff."""
    if step > TOP_LINE:
        return range(TOP_LINE + 2, step + 1, 2)
    return range(-2, step - 1, -2)

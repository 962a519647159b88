"""A line of the hi-hat under a ride: where both hands are busy at its strokes, it is the foot that closes the hat."""

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from station.core.pieces import HAND_PIECES, Piece
from station.music.formats.ascii_tab.tab_letters import RESTS, LineMeaning
from station.music.formats.ascii_tab.tab_text import TabRow, TabSystem

_HANDS = 2
_OF_A_FOOT = frozenset("xX")
"""Letters that mean a chick on a line of the pedal and a closed hat on the hand's."""
_SHARE = Fraction(1, 2)
"""Of its strokes that find no hand (our choice: a slip or two of the typist make no foot)."""


def with_hat_of_the_foot(system: TabSystem) -> tuple[TabSystem, tuple[str, ...]]:
    """The system with its hi-hat under the foot where no hand is free for it, and that in words."""
    hats = [row for row in system.rows if row.meaning == LineMeaning(Piece.HIHAT)]
    has_pedal = any(row.meaning.piece is Piece.HIHAT_PEDAL for row in system.rows)
    if len(hats) != 1 or has_pedal or not _is_the_foots(hats[0], system):
        return system, ()
    said = f"line {hats[0].line}: read as the hi-hat of the foot, for both hands are busy at its strokes"
    foot = replace(hats[0], meaning=LineMeaning(Piece.HIHAT_PEDAL))
    return replace(system, rows=[foot if row is hats[0] else row for row in system.rows]), (said,)


def _is_the_foots(hat: TabRow, system: TabSystem) -> bool:
    if not {cell for bar in hat.bars for cell in bar.cells} <= _OF_A_FOOT | set(RESTS):
        return False
    others = [set(_places(row)) for row in system.rows if row is not hat and row.meaning.piece in HAND_PIECES]
    places = list(_places(hat))
    handless = sum(sum(place in other for other in others) >= _HANDS for place in places)
    return handless > 0 and handless >= _SHARE * len(places)


def _places(row: TabRow) -> Iterator[tuple[int, Fraction]]:
    """Bar, and share of it, of each stroke."""
    for k, bar in enumerate(row.bars):
        yield from ((k, Fraction(i, len(bar.cells))) for i, cell in enumerate(bar.cells) if cell not in RESTS)

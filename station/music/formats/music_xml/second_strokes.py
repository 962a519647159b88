"""How loud the strokes of a slashed note are after its first: the note has one velocity for all of them.

An accent is the first stroke's alone. The others are as loud as most plain notes of that piece, else of all that hands
play, else as much softer as normal strokes are than accents. Reader and writer both ask here.
"""

from collections import Counter, defaultdict
from collections.abc import Iterable

from station.core.pieces import HAND_PIECES, Dynamic, Piece
from station.music.stroke_velocities import shaded


class SecondStrokes:
    """Made of the `plain` notes, those without a slash: (piece, dynamic, velocity) each."""

    def __init__(self, plain: Iterable[tuple[Piece, Dynamic, int]]) -> None:
        counts: dict[Piece, Counter[int]] = defaultdict(Counter)
        for piece, dynamic, velocity in plain:
            if dynamic is Dynamic.NORMAL:
                counts[piece][velocity] += 1
        self._usual = {piece: _commonest(count) for piece, count in counts.items()}
        hands = sum((counts[piece] for piece in counts if piece in HAND_PIECES), Counter[int]())
        self._of_hands = _commonest(hands) if hands else None

    def velocity(self, piece: Piece, dynamic: Dynamic, first: int) -> int:
        """The velocity of the strokes after one of `dynamic` and velocity `first`."""
        if dynamic is not Dynamic.ACCENT:
            return first
        usual = self._usual.get(piece, self._of_hands)
        return min(first, shaded(first, Dynamic.NORMAL, beside=dynamic) if usual is None else usual)


def _commonest(counts: Counter[int]) -> int:
    """The commonest velocity, of two the louder."""
    return max(counts, key=lambda velocity: (counts[velocity], velocity))

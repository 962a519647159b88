"""What the kit commands while nobody is judged: two kicks ask for the count-in.

Pure: hits with their own times in, whether the gesture is complete out. Whoever listens decides when it may mean
anything: never in the middle of a drill.
"""

from station.core.events import Hit
from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S

TOGETHER_NS = NS_PER_S
"""Two kicks within a second, and nothing else between them, are meant (our choice)."""
DOUBLE_TRIGGER_NS = 60 * NS_PER_MS
"""A second kick that comes so soon is the same stroke, triggered twice (our choice: no foot repeats faster than 16
times a second)."""


class TwoKicks:
    """Waits for two kicks."""

    def __init__(self) -> None:
        self._kick_ns: int | None = None

    def take(self, hit: Hit) -> bool:
        """Take a hit; returns whether it is the second of two kicks."""
        before_ns, self._kick_ns = self._kick_ns, None
        if hit.piece is not Piece.KICK:
            return False
        if before_ns is not None:
            gap_ns = hit.at_ns - before_ns
            if gap_ns < DOUBLE_TRIGGER_NS:
                self._kick_ns = before_ns
                return False
            if gap_ns <= TOGETHER_NS:
                return True
        self._kick_ns = hit.at_ns
        return False

    def forget(self) -> None:
        """What was struck so far means nothing."""
        self._kick_ns = None

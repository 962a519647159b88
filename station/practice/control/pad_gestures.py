"""What the kit commands: two kicks ask for the count-in, two pads struck at once for a pause.

Pure: hits with their own times in, whether the gesture is complete out. Whoever listens decides when it may mean
anything: kicks never in the middle of a drill, and no single pad there at all.
"""

from collections.abc import Collection, Iterable

import numpy as np

from station.core.events import Hit, Switched
from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.music.score import Score

TOGETHER_NS = NS_PER_S
"""Two kicks within a second, and nothing else between them, are meant (our choice)."""
DOUBLE_TRIGGER_NS = 60 * NS_PER_MS
"""A second kick that comes so soon is the same stroke, triggered twice (our choice: no foot repeats faster than 16
times a second)."""


class TwoKicks:
    """Waits for two kicks."""

    def __init__(self) -> None:
        self._kick_ns: int | None = None

    def feed(self, hit: Hit) -> bool:
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


AT_ONCE_NS = 50 * NS_PER_MS
"""Two pads so near are struck together (our choice: hands that mean it lie within 30 ms)."""


class PadsTogether:
    """Waits for one of some `pairs` of pads to be struck at once.

    A pair that `score` asks for at once somewhere commands nothing: a drill never pauses because it is played.
    """

    def __init__(self, pairs: Iterable[frozenset[Piece]], score: Score) -> None:
        self._pairs = [pair for pair in pairs if not is_written(pair, score)]
        self._last: dict[Piece, Hit] = {}

    def feed(self, hit: Hit) -> tuple[Hit, ...]:
        """Take a hit; returns the strokes of the pair that it completes, nothing where it completes none."""
        self._last[hit.piece] = hit
        near = {piece for piece, last in self._last.items() if abs(hit.at_ns - last.at_ns) <= AT_ONCE_NS}
        complete = next((pair for pair in self._pairs if hit.piece in pair and pair <= near), frozenset())
        return tuple(self._last[piece] for piece in sorted(complete))

    def forget(self) -> None:
        """What was struck so far means nothing."""
        self._last.clear()


def is_written(pair: frozenset[Piece], score: Score) -> bool:
    """Whether the score has both of a pair so near that one who plays it may strike them at once."""
    one, other = (np.sort(score.onset_ns[score.notes["piece"] == piece]) for piece in pair)
    if not len(one) or not len(other):
        return False
    place = np.searchsorted(other, one)
    before = np.abs(one - other[np.maximum(place - 1, 0)])
    after = np.abs(one - other[np.minimum(place, len(other) - 1)])
    return bool(np.minimum(before, after).min() <= WRITTEN_NEAR_NS)


WRITTEN_NEAR_NS = 3 * AT_ONCE_NS
"""So near in the score, and an uneven student may strike them at once (our choice)."""


class FootSwitch:
    """Presses of `switches`; one that repeats itself is pressed once."""

    def __init__(self, switches: Collection[str]) -> None:
        self._switches = switches
        self._last_ns: dict[str, int] = {}

    def feed(self, event: Switched) -> bool:
        """Take an event; returns whether one of the switches was pressed."""
        before_ns = self._last_ns.get(event.switch)
        self._last_ns[event.switch] = event.at_ns
        return event.switch in self._switches and (before_ns is None or event.at_ns - before_ns > PRESS_NS)


PRESS_NS = 300 * NS_PER_MS
"""So long a switch is quiet between two presses (our choice: a pedal that moves sends without such a gap)."""

"""What the kit commands: two kicks ask for the count-in, two pads struck at once for a pause.

Pure: hits with their own times and the clock in, whether the gesture is complete out. Whoever listens decides when it
may mean anything: kicks never in the middle of a drill, and no single pad there at all.
"""

from collections.abc import Collection, Iterable

import numpy as np

from station.core.events import Hit, Switched
from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.music.score import Score

TOGETHER_NS = NS_PER_S
"""Two kicks within a second, and nothing else between them, are meant (our choice)."""
BEFORE_NS, AFTER_NS = 2 * NS_PER_S, NS_PER_S // 2
"""So long nothing is struck before the first and after the second (our choice: whoever noodles, warms up or ends a
song has a stroke within a bar, and goes on within a beat; `benchmarks/stray_kicks.py` measures it)."""
AFTER_SHARE = 1.25
"""After the second it is quiet for longer than the two lie apart, too: a third in the same pulse is a groove (our
choice: a quarter more than the steadiest foot is late)."""
DOUBLE_TRIGGER_NS = 60 * NS_PER_MS
"""A second kick that comes so soon is the same stroke, triggered twice (our choice: no foot repeats faster than 16
times a second)."""


class TwoKicks:
    """Waits for two kicks that stand alone; hand it every stroke, and the clock when all until then are handed over."""

    def __init__(self) -> None:
        self._last_ns: int | None = None
        self._first_ns: int | None = None
        self._second_ns: int | None = None

    def feed(self, hit: Hit) -> bool:
        """Take a stroke; returns whether two kicks before it were meant."""
        is_meant = self.advance(hit.at_ns)
        if hit.piece is not Piece.KICK:
            self.forget()
        elif not self._is_same_stroke(hit.at_ns):
            self._kicked(hit.at_ns)
        self._last_ns = hit.at_ns
        return is_meant

    def advance(self, now_ns: int) -> bool:
        """Whether two kicks were meant, and nothing came after them until `now_ns`; it is told once."""
        if self._first_ns is None or self._second_ns is None:
            return False
        after_ns = max(AFTER_NS, AFTER_SHARE * (self._second_ns - self._first_ns))
        is_meant = now_ns - self._second_ns >= after_ns
        if is_meant:
            self.forget()
        return is_meant

    def _kicked(self, at_ns: int) -> None:
        is_second = self._first_ns is not None and at_ns - self._first_ns <= TOGETHER_NS and self._second_ns is None
        if is_second:
            self._second_ns = at_ns
            return
        self.forget()
        if self._last_ns is None or at_ns - self._last_ns >= BEFORE_NS:
            self._first_ns = at_ns

    def _is_same_stroke(self, at_ns: int) -> bool:
        kick_ns = self._first_ns if self._second_ns is None else self._second_ns
        return kick_ns is not None and at_ns - kick_ns < DOUBLE_TRIGGER_NS

    def forget(self) -> None:
        """What was struck so far means nothing; that it was struck is remembered."""
        self._first_ns = self._second_ns = None


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

"""Hits that look like false triggers though the kit's rules let them pass: for a page on which a person sets the rules.

A suspicion is no verdict: two limbs may strike together, one softly. Times are monotonic ns.
"""

from collections import deque
from dataclasses import dataclass

from station.core.events import Hit
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.devices.mapping.device_map import CROSSTALK_WITHIN_NS
from station.devices.mapping.trigger_filter import FALSE_STOMP_NS, HeldBack

DOUBLE_NS = 25 * NS_PER_MS
"""Strokes of one pad nearer than this, the second softer, are suspect; our choice. All suspicions together fall on one
in a hundred strokes of the Groove MIDI Dataset, mostly on ghost strokes that coincide with a kick or the hi-hat."""
BEFORE_NS = 10 * NS_PER_MS
_SOFTER_DOUBLE = 0.7
_SOFTER_CROSSTALK = 0.3
"""Softer than so much of the other stroke; our choice."""
_SOFT_STOMP = 0.6


@dataclass(frozen=True, slots=True)
class Suspicion:
    """`hit` may be a false trigger of `cause`, which came `after_ns` before it (negative: after it)."""

    hit: Hit
    why: HeldBack
    cause: Hit

    @property
    def after_ns(self) -> int:
        """How long after its cause the hit came."""
        return self.hit.at_ns - self.cause.at_ns

    @property
    def share(self) -> float:
        """The hit's velocity as a share of its cause's."""
        return self.hit.velocity / self.cause.velocity


class Suspects:
    """Looks at one kit's hits, in order of time."""

    def __init__(self) -> None:
        self._recent: deque[Hit] = deque(maxlen=16)

    def look(self, hit: Hit) -> list[Suspicion]:
        """What `hit` brings under suspicion: itself, or a softer one just before it."""
        found: list[Suspicion] = []
        for other in self._recent:
            gap_ns = hit.at_ns - other.at_ns
            if (why := _why(hit, other, gap_ns)) is not None:
                found.append(Suspicion(hit, why, other))
            elif gap_ns <= BEFORE_NS and other.piece is not hit.piece and _is_softer(other, hit, _SOFTER_CROSSTALK):
                found.append(Suspicion(other, HeldBack.CROSSTALK, hit))
        self._recent.append(hit)
        return found


def _why(hit: Hit, cause: Hit, gap_ns: int) -> HeldBack | None:
    if hit.piece is cause.piece:
        return HeldBack.DOUBLE if gap_ns <= DOUBLE_NS and _is_softer(hit, cause, _SOFTER_DOUBLE) else None
    if hit.piece is Piece.HIHAT_PEDAL and cause.piece is Piece.HIHAT:
        return HeldBack.FALSE_STOMP if 0 < gap_ns <= FALSE_STOMP_NS and _is_softer(hit, cause, _SOFT_STOMP) else None
    return HeldBack.CROSSTALK if gap_ns <= CROSSTALK_WITHIN_NS and _is_softer(hit, cause, _SOFTER_CROSSTALK) else None


def _is_softer(hit: Hit, than: Hit, share: float) -> bool:
    return hit.velocity <= share * than.velocity

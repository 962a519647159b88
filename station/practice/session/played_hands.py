"""Which hand played the strokes of a session, by the sensors on the sticks.

Hits and strokes are matched in session time, a hit's less its pad's latency: there a pause moves nothing, and it does
not matter when the session heard of a stroke. So a session that is judged again names the same hands.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from station.core.events import Hit, StickStroke
from station.core.pieces import Limb
from station.core.units import NS_PER_MS
from station.sync.strokes.hand_naming import limb_of, strokes_of_hits

NEAR_NS = 100 * NS_PER_MS
"""Strokes before the first judged hit and after the last by more belong to none: latencies differ by 70 ms at most."""


@dataclass(eq=False)
class PlayedHands:
    """The sticks' `strokes` as they were told, and when each judged hit was played."""

    strokes: list[StickStroke] = field(default_factory=list)
    _played_ns: dict[Hit, int] = field(default_factory=dict)

    def judged(self, hit: Hit, played_ns: int) -> None:
        """Take a `hit` in score time, and when in session time it was played."""
        self._played_ns[hit] = played_ns

    def felt(self, hits: Sequence[Hit]) -> tuple[StickStroke | None, ...]:
        """The stroke that made each of the judged `hits`, None where nobody can tell; empty without sensors."""
        span_ns = self.span_ns(hits)
        if not self.strokes or span_ns is None:
            return ()
        first, last = span_ns
        played = [replace(hit, at_ns=self._played_ns[hit]) for hit in hits]
        return strokes_of_hits(played, [stroke for stroke in self.strokes if first <= stroke.at_ns <= last])

    def span_ns(self, hits: Sequence[Hit]) -> tuple[int, int] | None:
        """From just before the first of the judged `hits` to just after the last, session time; None of none."""
        played_ns = [self._played_ns[hit] for hit in hits]
        return (min(played_ns) - NEAR_NS, max(played_ns) + NEAR_NS) if played_ns else None


def limbs_of(hits: Sequence[Hit], felt: Sequence[StickStroke | None]) -> list[Limb] | None:
    """The limbs of `hits`, each with the stroke that was felt of it; None where no sensor felt anything."""
    return [limb_of(hit, stroke) for hit, stroke in zip(hits, felt, strict=True)] if felt else None

"""A choice on the screen that a pad makes: which pad means what, and when a stroke means it.

A stroke that belongs to the music chooses nothing: a choice hears pads only after some silence, and takes only a stroke
that stands alone: no flam, no crosstalk, no phrase. Pure: strokes and the clock in, the number of the option out, the
same for any frame rate. The kick never chooses, for two kicks start.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from station.core.events import Hit
from station.core.pieces import Piece
from station.core.units import NS_PER_S
from station.practice.control.pad_gestures import DOUBLE_TRIGGER_NS


@dataclass(frozen=True, slots=True)
class Stillness:
    """How long nothing else is struck `before_ns` and `after_ns` the stroke that chooses."""

    before_ns: int
    after_ns: int


ANSWERS = Stillness(NS_PER_S, NS_PER_S // 2)
"""For a choice that begins nothing (our choice, of TEACHING's "only when stopped": more than a beat of any lesson
faster than 60 bpm before it, a beat at 120 bpm after it)."""
BEGINS = Stillness(2 * NS_PER_S, NS_PER_S)
"""For a choice that begins a session: as alone as two kicks are (our choice: whoever noodles beside a result begins
one 8 times in an hour, and 43 times by `ANSWERS`; `benchmarks/stray_kicks.py`)."""

PAD_ORDER = (
    Piece.SNARE,
    Piece.TOM_1,
    Piece.TOM_2,
    Piece.TOM_3,
    Piece.TOM_4,
    Piece.FLOOR_TOM_1,
    Piece.FLOOR_TOM_2,
    Piece.HIHAT,
    Piece.RIDE,
    Piece.CRASH_1,
    Piece.CRASH_2,
)
"""Which pads choose, the first option first: the snare lies under both hands, then the toms from left to right."""

Pads = Sequence[Collection[Piece]]
"""The pads of each option in turn; empty for one that no pad chooses."""


def pads_for(options: int, there: Collection[Piece]) -> tuple[frozenset[Piece], ...]:
    """A pad for each of so many `options` on a kit of the pieces `there`; the last have none where it has too few."""
    found = [frozenset({piece}) for piece in PAD_ORDER if piece in there][:options]
    return (*found, *[frozenset[Piece]()] * (options - len(found)))


class PadChoice:
    """Waits for a stroke, as alone as `still` asks, that chooses one of `pads`; it has been on the screen from `up_ns`.

    Hand it every stroke, and the clock when all strokes until then are handed over. It chooses once.
    """

    def __init__(self, pads: Pads, up_ns: int, still: Stillness = ANSWERS) -> None:
        self._option_of = {piece: option for option, several in enumerate(pads) for piece in several}
        assert Piece.KICK not in self._option_of, "kicks start"
        self._quiet_since_ns, self._still = up_ns, still
        self._meant: Hit | None = None
        self._is_made = False

    def feed(self, hit: Hit) -> int | None:
        """Take a stroke; returns the option that the one before it has chosen, None for none."""
        if (chosen := self.advance(hit.at_ns)) is not None or self._is_made:
            return chosen
        if self._meant is not None and self._meant.piece is hit.piece and _is_double_trigger(self._meant, hit):
            return None
        may_mean = self._meant is None and self.hears(hit.at_ns) and hit.piece in self._option_of
        self._meant = hit if may_mean else None
        self._quiet_since_ns = max(self._quiet_since_ns, hit.at_ns)
        return None

    def advance(self, now_ns: int) -> int | None:
        """The option that is chosen by `now_ns`; None while there is none, and once it was told."""
        if self._meant is None or now_ns - self._meant.at_ns < self._still.after_ns:
            return None
        chosen, self._meant, self._is_made = self._option_of[self._meant.piece], None, True
        return chosen

    def hears(self, now_ns: int) -> bool:
        """Whether a stroke at `now_ns` may choose: nothing was struck for long enough."""
        return not self._is_made and now_ns - self._quiet_since_ns >= self._still.before_ns

    @property
    def meant(self) -> int | None:
        """The option that is chosen if nothing follows its stroke; None for none."""
        return None if self._meant is None else self._option_of[self._meant.piece]


def _is_double_trigger(one: Hit, other: Hit) -> bool:
    return other.at_ns - one.at_ns < DOUBLE_TRIGGER_NS

"""Every fault that a report can name, with the smallest size that a teacher minds: the table of docs/scoring.md.

A size is a length, never signed: the word says to which side. `least` is what a teacher minds, in `unit`; where the
music decides it (a share of the interval, a contrast that is written) `findings` works it out and the row says how.
Words of a piece are made of its name: `late_snare`, `early_ride`; they are measured by the rows `late_piece` and
`early_piece`. A lesson or a course may ask for other sizes, or mute a word (`Asked`).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from types import MappingProxyType

from station.core.pieces import Piece, word

MUTE = "mute"
"""What a lesson writes in place of a size, of a fault that is never to be named."""


class Group(IntEnum):
    """The order in which a teacher takes faults."""

    NOTES = 0
    PULSE = 1
    LEAN = 2
    DYNAMICS = 3
    STICKS = 4
    """What only sensors on the sticks tell: said beside the advice, never in it."""


@dataclass(frozen=True, slots=True)
class FaultKind:
    """One row: the word, its group and unit, the smallest size that a teacher minds, and where that comes from."""

    word: str
    group: Group
    unit: str
    least: float
    source: str


_LEAN = "HUMANS: 19–28 ms are just noticed in a mix"
_BRIEF = "the teacher's table of this station, a hypothesis"
_FLAM = "HUMANS: flams are 15–40 ms wide; under 10 one stroke is heard, over 50 two"
_EVENLY = "a fifth of the interval: twice what is heard as uneven in fast strokes (HUMANS)"
_DB = "HUMANS: 2–3 dB are heard by anyone; " + _BRIEF
_SHARE = "TEACHING: a pass is 90 % right; one stroke in twenty-five goes wrong with anyone"
_ONCE = "once is heard"


def _both(words: str, *row: object) -> tuple[FaultKind, ...]:
    return tuple(FaultKind(each, *row) for each in words.split())  # type: ignore[arg-type]


_ROWS = (
    FaultKind("missed", Group.NOTES, "%", 4.0, _SHARE),
    FaultKind("extra", Group.NOTES, "%", 3.0, _SHARE + "; what a kit adds is rarer"),
    FaultKind("wrong_piece", Group.NOTES, "%", 5.0, _SHARE),
    FaultKind("wrong_sticking", Group.NOTES, "%", 5.0, _SHARE + "; sensors on the sticks tell the hand"),
    *_both("stopped left_out_bars repeated_bars", Group.NOTES, "times", 1.0, _ONCE),
    *_both("came_in_late came_in_early", Group.NOTES, "beats", 0.5, _ONCE),
    *_both("open_hats closed_hats", Group.NOTES, "%", 25.0, _BRIEF),
    *_both("rushing dragging", Group.PULSE, "% in 8 bars", 4.0, "HUMANS: professionals hold ±1–2 %; " + _BRIEF),
    *_both("unsteady", Group.PULSE, "ms", 30.0, "TEACHING: a pass's SD is at most 35 ms; professionals 26–28"),
    *_both(
        "unsteady_left_hand unsteady_right_hand unsteady_right_foot unsteady_left_foot",
        Group.PULSE,
        "ms",
        30.0,
        "and 1.5 times the others': " + _BRIEF,
    ),
    *_both(
        "early late", Group.LEAN, "ms", 30.0, "HUMANS: professionals stand up to 16 ms ahead; beyond 40 a clear fault"
    ),
    *_both("late_piece early_piece slow_hihat_foot early_hihat_foot", Group.LEAN, "ms", 25.0, _LEAN),
    *_both("late_left_hand early_left_hand late_right_hand early_right_hand", Group.LEAN, "ms", 25.0, _LEAN),
    *_both("late_offbeats early_offbeats", Group.LEAN, "ms", 25.0, _LEAN),
    *_both("straight_swing hard_swing swung_straight", Group.LEAN, "ms", 30.0, "of the short note: " + _BRIEF),
    *_both("rush_fills drag_fills", Group.LEAN, "ms", 20.0, "on average, so that its end is 40 ms off: " + _BRIEF),
    *_both("fill_lands_late fill_lands_early", Group.LEAN, "ms", 40.0, "HUMANS: beyond 40 ms a clear fault"),
    *_both("drag_slow rush_slow", Group.LEAN, "ms", 25.0, _LEAN),
    *_both("uneven_doubles lazy_doubles", Group.LEAN, "% of the interval", 20.0, _EVENLY),
    FaultKind("wide_flams", Group.LEAN, "ms", 50.0, _FLAM),
    FaultKind("tight_flams", Group.LEAN, "ms", 10.0, _FLAM),
    *_both("weak_left weak_right", Group.DYNAMICS, "dB", 3.0, _DB),
    FaultKind("weak_doubles", Group.DYNAMICS, "dB", 4.0, _DB),
    FaultKind("flat_accents", Group.DYNAMICS, "dB", 4.0, "over the taps, at least: " + _BRIEF),
    FaultKind("loud_ghosts", Group.DYNAMICS, "dB", 8.0, "under the taps, at least: " + _BRIEF),
    FaultKind("loud_graces", Group.DYNAMICS, "dB", 6.0, "under the main strokes, at least; HUMANS: 12–24 are usual"),
    *_both("fades grows", Group.DYNAMICS, "dB", 6.0, _BRIEF),
)
FAULTS: Mapping[str, FaultKind] = MappingProxyType({row.word: row for row in _ROWS})
"""What advice can name."""

_STEP = "half a step between levels (3, 4.5, 6 inches: HUMANS)"
_FREE_FALL = "more of a hand's strokes slower than a free fall from their height make a habit; our choice"
_MADE = "height grows 1.7 times as fast as loudness from p to fff (HUMANS), 170 %; our choice, under a third of that"
_STICK_ROWS = (
    FaultKind("uneven_heights", Group.STICKS, "% higher", 22.0, _STEP),
    FaultKind("uneven_rebound", Group.STICKS, "% of the speed", 10.0, "our choice: a fifth of a usual rebound"),
    FaultKind("wasted_motion", Group.STICKS, "% of the strokes", 25.0, _FREE_FALL),
    FaultKind("same_height", Group.STICKS, "% of the loudness that height does not make", 50.0, _MADE),
    FaultKind("grip_changed", Group.STICKS, "°", 30.0, "the sensor no longer sits as it did; our choice"),
    *_both("hand_ahead hand_behind", Group.STICKS, "ms", 1.0, "nobody hears less (HUMANS: 6 ms at best)"),
)
STICK_FAULTS: Mapping[str, FaultKind] = MappingProxyType({row.word: row for row in _STICK_ROWS})
"""What the report says of sticks, and of a hand's lean against the common motion of both."""

_FEET = MappingProxyType({"late_hihat_pedal": "slow_hihat_foot", "early_hihat_pedal": "early_hihat_foot"})


def of_piece(side: str, piece: str) -> str:
    """The word for a piece that is `late` or `early`."""
    plain = f"{side}_{piece}"
    return _FEET.get(plain, plain)


PIECE_WORDS = frozenset(of_piece(side, word(piece)) for piece in Piece for side in ("late", "early"))
WORDS = frozenset(FAULTS) - {"late_piece", "early_piece"} | PIECE_WORDS | frozenset(STICK_FAULTS)
"""Every word that a report can say, each of which a lesson may size or mute."""


def kind_of(fault: str) -> FaultKind:
    """The row that measures a word of `WORDS`."""
    row = FAULTS.get(fault) or STICK_FAULTS.get(fault)
    return row or FAULTS[f"{fault.partition('_')[0]}_piece"]


@dataclass(frozen=True, slots=True)
class Asked:
    """What a lesson asks of faults: the smallest size by word in the table's unit, None for a word that is mute."""

    sizes: Mapping[str, float | None] = field(default_factory=lambda: MappingProxyType({}), hash=False)

    def least(self, fault: str) -> float:
        """The smallest size of `fault` that counts, in its unit; infinite where it is mute."""
        asked = self.sizes.get(fault, kind_of(fault).least)
        return float("inf") if asked is None else asked

"""The sticking line: which hand strikes, written under the strokes as R, L, B (both) or - (not said).

A letter stands at a stroke of a hand and says the hand of that stroke; the grace strokes of a flam or drag fall to the
other hand, a diddle stays in one. B says that both hands strike: the right hand takes the piece that comes first in
`RIGHT_FIRST`. Where that is not what is meant, `right_hand.snare = …` and `left_hand.tom_1 = …` say it.
"""

from collections.abc import Callable, Iterable, Sequence
from types import MappingProxyType

from station.core.pieces import TOMS, Limb, Piece, word
from station.drills.grid.cell_strokes import BarClock, WrittenCell
from station.drills.grid.grid import Bar
from station.drills.grid.tab_symbols import RESTS

STICKING = "sticking"

HANDS = MappingProxyType({"R": Limb.RIGHT_HAND, "L": Limb.LEFT_HAND})
BOTH = "B"

RIGHT_FIRST: tuple[Piece, ...] = (
    Piece.RIDE,
    Piece.RIDE_2,
    Piece.CRASH_2,
    Piece.CHINA,
    Piece.CRASH_1,
    Piece.SPLASH,
    Piece.COWBELL,
    Piece.HIHAT,
    Piece.TAMBOURINE,
    Piece.CLAP,
    Piece.PERCUSSION,
    *reversed(TOMS),
    Piece.SNARE,
)
"""Of two pieces struck together the right hand's stands first: the timekeeping cymbal, then what lies further right."""


def apply_sticking(
    bars: Iterable[tuple[int, Bar]],
    clock: BarClock,
    strokes: Iterable[WrittenCell],
    report: Callable[[int, str], None],
    unsure_bars: frozenset[int],
) -> list[WrittenCell]:
    """The strokes with the hands that the line says, its bars each with the tick of its start; faults go to `report`.

    A letter stands for what is played at its moment: a swung eighth may be written as the last of three cells.
    `unsure_bars` are those (from 0) in which another line is at fault: there a missing stroke is no fault.
    """
    by_tick: dict[int, list[WrittenCell]] = {}
    others: list[WrittenCell] = []
    for stroke in strokes:
        if is_of_a_hand(stroke):
            by_tick.setdefault(stroke.place.played, []).append(stroke)
        else:
            others.append(stroke)
    for number, (start, bar) in enumerate(bars):
        for cell in bar.cells:
            if cell.letter in RESTS:
                continue
            tick = clock.place(start + cell.tick, cell.swings).played
            here = by_tick.get(tick, [])
            if len(here) > len(HANDS):
                continue  # nobody can play it, whoever's hands they are: `motion.feasibility` says so
            lacking, fault = _lacking(cell.letter, here), _fault(cell.letter, here)
            if fault or (lacking and number not in unsure_bars):
                report(cell.char, fault or lacking)
            elif not lacking:
                by_tick[tick] = _with_hands(cell.letter, here)
    return [*others, *(s for here in by_tick.values() for s in here)]


def is_of_a_hand(stroke: WrittenCell) -> bool:
    """Whether a hand plays it, or may: the sticking line speaks of such strokes."""
    return stroke.limb in HANDS.values() or stroke.limb is Limb.UNKNOWN


def sign_fault(letter: str, here: Sequence[WrittenCell]) -> str:
    """What is wrong with a letter under these strokes of hands, all of one moment; empty if nothing."""
    return _fault(letter, here) or _lacking(letter, here)


def _lacking(letter: str, here: Sequence[WrittenCell]) -> str:
    """What is wrong where this letter says more hands than strike; empty if nothing."""
    if not here:
        return f"{letter} says a hand, but no hand strikes here; expected -"
    if letter == BOTH and len(here) < len(HANDS):
        return f"B says both hands, but one strikes here ({_names(here)}); expected R or L"
    return ""


def _fault(letter: str, here: Sequence[WrittenCell]) -> str:
    """What else is wrong with this letter over these strokes; empty if nothing."""
    if letter not in HANDS and letter != BOTH:
        return f"{letter!r} is no sticking; expected R, L, B (both hands) or -"
    if letter in HANDS and len(here) > 1:
        return f"two strokes here ({_names(here)}); expected B, or write right_hand.… and left_hand.… lines"
    if letter == BOTH and len(here) == 1:
        return ""
    for stroke, limb in zip(here, _hands(letter, here), strict=True):
        if stroke.limb not in (Limb.UNKNOWN, limb):
            return f"{letter} contradicts the {word(stroke.limb)}.{word(stroke.piece)} line"
    return ""


def _names(strokes: Iterable[WrittenCell]) -> str:
    return " and ".join(word(s.piece) for s in strokes)


def _hands(letter: str, here: Sequence[WrittenCell]) -> list[Limb]:
    """The hand of each stroke of one moment."""
    if not here:
        return []
    if letter in HANDS:
        return [HANDS[letter]]
    first = min(here, key=lambda s: RIGHT_FIRST.index(s.piece))
    return [Limb.RIGHT_HAND if s is first else Limb.LEFT_HAND for s in here]


def _with_hands(letter: str, here: Sequence[WrittenCell]) -> list[WrittenCell]:
    return [s.played_by(limb) for s, limb in zip(here, _hands(letter, here), strict=True)]

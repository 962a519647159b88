"""The letters of the grid: one table a family of pieces says what each letter plays.

A small letter is a normal stroke, its capital the same stroke accented, `g` a ghost stroke; `v w u z` are a flam, drag,
diddle and buzz as soft as that. The letters follow those that drummers know from drum tablature and GrooveScribe (`o`
drum, `x` cymbal, `O`/`X` accent, `g` ghost, `f` flam, `d` drag, `b` buzz, `#` choke) where those agree with each other.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum
from types import MappingProxyType

from station.core.pieces import CLOSED, HALF_OPEN, OPEN, TOMS, Articulation, Dynamic, Limb, Ornament, Piece, Zone, word

RESTS = "-."
HOLD = "~"
"""Goes on with the buzz roll before it."""
CHOKE = "#"
"""Grabs the cymbal that the same line struck last."""
BEYOND = "*"
"""A stroke of the music that this player cannot make besides: written and kept, neither asked nor played."""


@dataclass(frozen=True, slots=True)
class TabSymbol:
    """What one letter plays; `ornament` FLAM and DRAG add grace strokes, DIDDLE is two strokes, ROLL is a buzz.

    What `is_beyond` the player stands in the music only (`BEYOND`).
    """

    zone: Zone
    articulation: Articulation = Articulation.NORMAL
    dynamic: Dynamic = Dynamic.NORMAL
    openness: float | None = None
    ornament: Ornament = Ornament.NONE
    is_beyond: bool = False


class TabFamily(Enum):
    """Pieces that share their letters."""

    KICK = "kick"
    SNARE = "snare"
    TOM = "tom"
    HIHAT = "hihat"
    PEDAL = "hihat_pedal"
    RIDE = "ride"
    CRASH = "crash"
    SMALL = "small percussion"


def _both(
    small: str,
    zone: Zone,
    articulation: Articulation = Articulation.NORMAL,
    openness: float | None = None,
    ornament: Ornament = Ornament.NONE,
) -> dict[str, TabSymbol]:
    """The small letter as a normal stroke and its capital as an accent."""
    return {
        small: TabSymbol(zone, articulation, Dynamic.NORMAL, openness, ornament),
        small.upper(): TabSymbol(zone, articulation, Dynamic.ACCENT, openness, ornament),
    }


def _ghost(
    zone: Zone,
    openness: float | None = None,
    letter: str = "g",
    articulation: Articulation = Articulation.NORMAL,
    ornament: Ornament = Ornament.NONE,
) -> dict[str, TabSymbol]:
    """A letter for what is played as softly as a ghost stroke."""
    return {letter: TabSymbol(zone, articulation, Dynamic.GHOST, openness, ornament)}


_DRUM = {
    **_both("o", Zone.HEAD),
    **_ghost(Zone.HEAD),
    **_both("f", Zone.HEAD, ornament=Ornament.FLAM),
    **_both("d", Zone.HEAD, ornament=Ornament.DRAG),
    **_both("t", Zone.HEAD, ornament=Ornament.DIDDLE),
    **_both("b", Zone.HEAD, Articulation.BUZZ, ornament=Ornament.ROLL),
    **_both("r", Zone.RIM, Articulation.RIM_SHOT),
    **_ghost(Zone.HEAD, letter="v", ornament=Ornament.FLAM),
    **_ghost(Zone.HEAD, letter="w", ornament=Ornament.DRAG),
    **_ghost(Zone.HEAD, letter="u", ornament=Ornament.DIDDLE),
    **_ghost(Zone.HEAD, letter="z", articulation=Articulation.BUZZ, ornament=Ornament.ROLL),
}

SYMBOLS: Mapping[TabFamily, Mapping[str, TabSymbol]] = MappingProxyType(
    {
        TabFamily.KICK: {**_both("o", Zone.HEAD), **_ghost(Zone.HEAD)},
        TabFamily.SNARE: {**_DRUM, **_both("x", Zone.RIM, Articulation.CROSS_STICK)},
        TabFamily.TOM: {**_DRUM, **_both("x", Zone.RIM)},
        TabFamily.HIHAT: {
            **_both("x", Zone.BOW, openness=CLOSED),
            **_ghost(Zone.BOW, CLOSED),
            **_both("h", Zone.BOW, openness=HALF_OPEN),
            **_both("o", Zone.BOW, openness=OPEN),
            **_both("e", Zone.EDGE, openness=CLOSED),
            **_both("s", Zone.EDGE, openness=HALF_OPEN),
            **_both("w", Zone.EDGE, openness=OPEN),
        },
        TabFamily.PEDAL: {
            **_both("x", Zone.PEDAL, Articulation.CHICK, CLOSED),
            **_ghost(Zone.PEDAL, CLOSED, articulation=Articulation.CHICK),
            **_both("o", Zone.PEDAL, Articulation.SPLASH, OPEN),
        },
        TabFamily.RIDE: {
            **_both("x", Zone.BOW),
            **_ghost(Zone.BOW),
            **_both("b", Zone.BELL),
            **_both("e", Zone.EDGE),
        },
        TabFamily.CRASH: {
            **_both("x", Zone.EDGE),
            **_ghost(Zone.EDGE),
            **_both("b", Zone.BELL),
            **_both("t", Zone.BOW),
        },
        TabFamily.SMALL: {**_both("x", Zone.HEAD), **_ghost(Zone.HEAD)},
    }
)

_FAMILY = {
    Piece.KICK: TabFamily.KICK,
    Piece.SNARE: TabFamily.SNARE,
    Piece.HIHAT: TabFamily.HIHAT,
    Piece.HIHAT_PEDAL: TabFamily.PEDAL,
    Piece.RIDE: TabFamily.RIDE,
    Piece.RIDE_2: TabFamily.RIDE,
    **dict.fromkeys((Piece.CRASH_1, Piece.CRASH_2, Piece.SPLASH, Piece.CHINA), TabFamily.CRASH),
    **dict.fromkeys(TOMS, TabFamily.TOM),
}


def family_of(piece: Piece) -> TabFamily:
    """The family whose letters `piece` is written with."""
    return _FAMILY.get(piece, TabFamily.SMALL)


BEYOND_SYMBOLS: Mapping[TabFamily, TabSymbol] = MappingProxyType(
    {family: replace(next(iter(table.values())), is_beyond=True) for family, table in SYMBOLS.items()}
)
"""What `BEYOND` stands for in a line: the family's first letter, a plain stroke."""

LETTER_OF: Mapping[TabFamily, Mapping[TabSymbol, str]] = MappingProxyType(
    {family: {letter: char for char, letter in table.items()} for family, table in SYMBOLS.items()}
)

ALIASES: Mapping[str, Piece] = MappingProxyType({"crash": Piece.CRASH_1, "floor_tom": Piece.FLOOR_TOM_1})
"""Shorter names for the first of their kind."""

LINE_PIECES: Mapping[str, Piece] = MappingProxyType({**{word(p): p for p in Piece}, **ALIASES})

_SHORT_NAMES: Mapping[Piece, str] = {piece: name for name, piece in ALIASES.items()}


def key_of_piece(piece: Piece) -> str:
    """The key of the piece's line, the shorter where there are two."""
    return _SHORT_NAMES.get(piece, word(piece))


LINE_ORDER: tuple[Piece, ...] = (
    Piece.CRASH_1,
    Piece.CRASH_2,
    Piece.SPLASH,
    Piece.CHINA,
    Piece.RIDE,
    Piece.RIDE_2,
    Piece.HIHAT,
    Piece.COWBELL,
    Piece.TAMBOURINE,
    Piece.CLAP,
    Piece.PERCUSSION,
    *TOMS[:4],
    Piece.SNARE,
    *TOMS[4:],
    Piece.KICK,
    Piece.HIHAT_PEDAL,
)
"""From the top of the page to its foot, as drum notation stacks them."""

LIMB_TABLES: Mapping[str, Limb] = MappingProxyType({word(limb): limb for limb in Limb if limb is not Limb.UNKNOWN})
"""`right_hand.snare = …` says the limb of every stroke of a line."""

_HINTS: Mapping[tuple[TabFamily, str], str] = MappingProxyType(
    {
        (TabFamily.KICK, "x"): "the hi-hat foot has its own line, hihat_pedal",
        (TabFamily.KICK, "X"): "the hi-hat foot has its own line, hihat_pedal",
        (TabFamily.HIHAT, "+"): "the hi-hat foot has its own line, hihat_pedal",
        (TabFamily.HIHAT, "b"): "a bell has its line: ride",
        (TabFamily.RIDE, "o"): "a cymbal is struck with x",
        (TabFamily.CRASH, "o"): "a cymbal is struck with x",
        (TabFamily.SNARE, "@"): "a rim shot is r",
    }
)


_LONG_DASHES = "‐‑‒–—−"
"""What word processors make of -, which looks much the same."""


def not_a_letter(char: str, family: TabFamily) -> str:
    """The fault of a character that this family does not know, with those that it does."""
    hint = "a long dash; a rest is the short one" if char in _LONG_DASHES else _HINTS.get((family, char))
    known = " ".join([*SYMBOLS[family], "-"])
    return f"{char!r} is no letter for a {family.value} line{f' ({hint})' if hint else ''}; expected one of {known}"

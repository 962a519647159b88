"""What can be written in a line, with a name for each: the letters of a piece, hands, marks of loudness."""

from functools import cache

from station.core.labels import limb_name
from station.core.pieces import CLOSED, HALF_OPEN, OPEN, Articulation, Dynamic, Ornament
from station.drills.editing.lesson_edits import REST, LineAt, TextLine
from station.drills.grid.loudness_line import STICK_HEIGHTS_IN
from station.drills.grid.sticking_line import BOTH, HANDS
from station.drills.grid.tab_symbols import BEYOND, CHOKE, HOLD, SYMBOLS, TabFamily, TabSymbol, family_of
from station.music.loudness_marks import FADE, GROW

_DYNAMICS = {Dynamic.GHOST: "ghost", Dynamic.NORMAL: "", Dynamic.ACCENT: "accent"}
_ORNAMENTS = {
    Ornament.FLAM: "flam",
    Ornament.DRAG: "drag",
    Ornament.DIDDLE: "diddle",
    Ornament.ROLL: "buzz",
}
_ARTICULATIONS = {
    Articulation.CROSS_STICK: "cross-stick",
    Articulation.RIM_SHOT: "rim shot",
    Articulation.CHICK: "chick",
    Articulation.SPLASH: "splash",
}
_OPENNESS = {CLOSED: "closed", HALF_OPEN: "half open", OPEN: "open"}
_CHOKED = (TabFamily.HIHAT, TabFamily.RIDE, TabFamily.CRASH)
_ROLLED = (TabFamily.SNARE, TabFamily.TOM)

_SIGNS = {
    TextLine.STICKING: {letter: limb_name(limb) for letter, limb in HANDS.items()} | {BOTH: "both hands"},
    TextLine.LOUDNESS: dict.fromkeys(STICK_HEIGHTS_IN, "")
    | {GROW: "louder up to the next mark", FADE: "softer up to the next mark"},
}


@cache
def family_letters(family: TabFamily) -> dict[str, str]:
    """The letters of a family of pieces, each with its words, in the order of the table."""
    words = {letter: symbol_words(symbol, family) for letter, symbol in SYMBOLS[family].items()}
    if family in _CHOKED:
        words[CHOKE] = "choke"
    if family in _ROLLED:
        words[HOLD] = "the buzz goes on"
    return words | {BEYOND: "beyond the player"}


def symbol_words(symbol: TabSymbol, family: TabFamily) -> str:
    """What a letter plays, as a drummer says it: "flam, accent"."""
    how = [
        _OPENNESS.get(symbol.openness, "") if family is TabFamily.HIHAT and symbol.openness is not None else "",
        _ORNAMENTS.get(symbol.ornament, ""),
        _ARTICULATIONS.get(symbol.articulation, ""),
        _zone(symbol, family),
        _DYNAMICS[symbol.dynamic],
    ]
    return ", ".join(word for word in how if word) or "stroke"


def _zone(symbol: TabSymbol, family: TabFamily) -> str:
    usual = next(iter(SYMBOLS[family].values())).zone
    is_said = symbol.articulation in _ARTICULATIONS
    return "" if symbol.zone is usual or is_said else symbol.zone.name.lower()


def line_letters(line: LineAt | TextLine) -> dict[str, str]:
    """Everything that can be written in a line, the rest apart: what is written, and what it is called."""
    return _SIGNS[line] if isinstance(line, TextLine) else family_letters(family_of(line.piece))


def usual_letter(line: LineAt | TextLine) -> str:
    """What a click writes where nothing else was chosen."""
    return "f" if line is TextLine.LOUDNESS else next(iter(line_letters(line)))


def typed_letter(line: LineAt | TextLine, typed: str, present: str) -> str | None:
    """What a typed character writes in a line where `present` stands; None where it is none of its letters.

    Hands may be typed small; in a loudness line p, f and m walk through their marks: p, pp, ppp.
    """
    if typed in (REST, "."):
        return REST
    letters = line_letters(line)
    if line is TextLine.LOUDNESS and typed in _WALKS:
        marks = _WALKS[typed]
        return marks[(marks.index(present) + 1) % len(marks)] if present in marks else marks[0]
    if line is TextLine.STICKING:
        typed = typed.upper()
    return typed if typed in letters else None


_WALKS = {"p": ("p", "pp", "ppp"), "f": ("f", "ff", "fff"), "m": ("mf", "mp")}
"""Marks by the key that begins them."""

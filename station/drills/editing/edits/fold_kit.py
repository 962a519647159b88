"""A lesson on a smaller kit: what is written for pieces that it lacks goes to the nearest that it has.

Which is nearest, `core.stand_ins` says; the letter is that of the other piece which plays most nearly the same. Where
two strokes fall together on one piece the louder stays, of equals the one that was written there: a folded bar never
needs more hands than before. A foot has no other piece: its strokes are left out. Hands, timing and variations stay.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace

from station.core.pieces import CYMBALS, Dynamic, Piece
from station.core.stand_ins import stand_in
from station.core.toml.toml_edits import without
from station.core.toml.toml_places import KeyPath
from station.drills.editing.bar_text import with_letter
from station.drills.editing.draft import Draft, DraftLine
from station.drills.editing.edits.cell_edits import place_words, setting_of
from station.drills.editing.edits.own_lines import with_own_line
from station.drills.editing.edits.timing_upkeep import Late, Place, key_of, late_of, with_late
from station.drills.editing.lesson_edits import REST, Fold, LineAt
from station.drills.editing.line_words import bar_total, with_all_bars, written_text
from station.drills.grid.grid import Bar, parse_line
from station.drills.grid.tab_symbols import (
    BEYOND,
    CHOKE,
    HOLD,
    LETTER_OF,
    LINE_PIECES,
    RESTS,
    SYMBOLS,
    family_of,
    key_of_piece,
)
from station.drills.transcription.strokes.letters import nearest_letter

LANDING = "landing"


def fold(draft: Draft, edit: Fold) -> Draft:
    """The draft on the pieces of `edit` alone; raises `BadInput` where no piece is left, or nothing to play."""
    if not edit.pieces:
        raise draft.refused("expected at least one piece that is left")
    before = draft
    for grid in range(len(before.grids)):
        draft = _grid_folded(before, draft, grid, edit.pieces)
    return _landing_folded(draft, edit.pieces)


def folded_letter(letter: str, piece: Piece, to: Piece) -> str:
    """The letter of `to` that plays most nearly what `letter` plays on `piece`; empty for a sign that it has not."""
    if letter == CHOKE:
        return letter if to in CYMBALS else ""
    if letter in (BEYOND, HOLD):
        return letter
    return LETTER_OF[family_of(to)][nearest_letter(family_of(to), SYMBOLS[family_of(piece)][letter])]


# --- a grid -----------------------------------------------------------------------------------------------------------


@dataclass(slots=True)
class _Target:
    """A line that strokes go to: its text, and the letters that it gets, by bar and tick."""

    text: str
    letters: dict[tuple[int, int], str] = field(default_factory=dict)


def _grid_folded(before: Draft, draft: Draft, grid: int, pieces: Collection[Piece]) -> Draft:
    """The draft with one grid folded; `before` has all grids as they were, for those that are like others."""
    lines = [line for line in before.lines(grid) if isinstance(line.at, LineAt)]
    moving = [(line, stand_in(_piece(line), pieces)) for line in lines if _piece(line) not in pieces]
    goals = {to for _, to in moving}
    if not any(line.is_own for line in lines if _piece(line) not in pieces or _piece(line) in goals):
        return draft  # it takes over what was folded above
    late = late_of(before, grid)
    folding = _Folding(before, lines, late)
    for line, to in moving:
        if to is not None:
            folding.move(line, to)
    for at, target in folding.targets.items():
        if target.letters:
            draft = _with_target(draft, at, target)
    for line, _ in moving:
        draft = draft.now(without(draft.text, line.path)) if line.is_own else draft
    return with_late(draft, grid, {key: places for key, places in late.items() if key[0] in pieces})


class _Folding:
    """The lines of a grid while strokes go from one to another; the timing goes along in `late`."""

    def __init__(self, draft: Draft, lines: Sequence[DraftLine], late: Late) -> None:
        self._draft, self._late = draft, late
        self.targets = {_at(line): _Target(line.text) for line in lines}
        self._loudest: dict[tuple[int | None, Piece, int, int], Dynamic] = {}
        for line in lines:
            for bar, tick, letter in _letters(draft, line):
                self._loudest[line.cycle, _piece(line), bar, tick] = _loud(line, letter)

    def move(self, line: DraftLine, to: Piece) -> None:
        """All strokes of a line to a line of the piece `to`, which the same limb plays."""
        at = replace(_at(line), piece=to)
        target = self.targets.setdefault(at, _Target(_silenced(self._draft, line)))
        timing = self._late.get(key_of(_at(line)), {})
        stays = True
        for bar, tick, letter in _letters(self._draft, line):
            if letter not in (HOLD, CHOKE):
                stays = self._is_louder(line, to, (bar, tick), letter)
                if stays:
                    self._make_room(at, (bar, tick))
                if stays and line.cycle is None:
                    self._late.setdefault(key_of(at), {})[bar, tick] = timing.get((bar, tick), 0)
            if stays and (sign := folded_letter(letter, _piece(line), to)):
                target.letters[bar, tick] = sign

    def _is_louder(self, line: DraftLine, to: Piece, place: Place, letter: str) -> bool:
        """Whether nothing as loud stands on `to` at that place."""
        here, loud = (line.cycle, to, *place), _loud(line, letter)
        if here in self._loudest and self._loudest[here] >= loud:
            return False
        self._loudest[here] = loud
        return True

    def _make_room(self, at: LineAt, place: Place) -> None:
        """Take the softer stroke of another hand's line of that piece away."""
        for other, target in self.targets.items():
            if (other.piece, other.cycle) == (at.piece, at.cycle) and other != at:
                line = self._draft.line(other, other.grid)
                was_there = line is not None and place in {place[:2] for place in _letters(self._draft, line)}
                if was_there:
                    target.letters[place] = REST
                else:
                    target.letters.pop(place, None)


def _with_target(draft: Draft, at: LineAt, target: _Target) -> Draft:
    """The draft with the letters of a line that strokes go to; what repeats goes on to repeat."""
    draft, path = with_own_line(draft, at, at.grid)
    texts = [written_text(target.text, bar) for bar in range(bar_total(target.text))]
    for (bar, tick), letter in sorted(target.letters.items()):
        changed = with_letter(texts[bar], tick, letter, setting_of(draft, at, at.grid, bar))
        if changed is None:
            fault = "no cell can begin there without moving what stands in the bar"
            raise draft.refused(fault, place_words(at, bar))
        texts[bar] = changed
    return draft.with_lines({path: with_all_bars(target.text, texts)})


def _silenced(draft: Draft, line: DraftLine) -> str:
    """The line with a rest in each of its cells."""
    signs = list(line.text)
    for bar in _bars(draft, line):
        for cell in bar.cells:
            signs[cell.char] = REST
    return "".join(signs)


def _bars(draft: Draft, line: DraftLine) -> list[Bar]:
    grid, cycle = _at(line).grid, line.cycle
    frames = draft.frames(grid) if cycle is None else [draft.frame(grid, 0, cycle)]
    return parse_line(line.text, frames, lambda _char, _words: None) if frames else []


def _letters(draft: Draft, line: DraftLine) -> list[tuple[int, int, str]]:
    """Bar, tick and letter of all that a line says but rests."""
    bars = enumerate(_bars(draft, line))
    return [(i, cell.tick, cell.letter) for i, bar in bars for cell in bar.cells if cell.letter not in RESTS]


def _loud(line: DraftLine, letter: str) -> Dynamic:
    """How loud a letter is; what is none is as loud as any stroke."""
    symbol = SYMBOLS[family_of(_piece(line))].get(letter)
    return Dynamic.NORMAL if symbol is None else symbol.dynamic


def _piece(line: DraftLine) -> Piece:
    return _at(line).piece


def _at(line: DraftLine) -> LineAt:
    assert isinstance(line.at, LineAt), "a line that is played"
    return line.at


# --- the landing ------------------------------------------------------------------------------------------------------


def _landing_folded(draft: Draft, pieces: Collection[Piece]) -> Draft:
    """The draft whose landing strikes these pieces alone; one that would strike nothing is taken away."""
    for path, piece, letter in _landed(draft):
        if piece in pieces:
            continue
        draft, to = draft.now(without(draft.text, path)), stand_in(piece, pieces)
        if to is not None and to not in {other for _, other, _ in _landed(draft)}:
            said = folded_letter(letter, piece, to)
            draft = draft.with_key((*path[:-1], key_of_piece(to)), said)
    is_empty = LANDING in draft.raw and not _landed(draft)
    return draft.now(without(draft.text, (LANDING,))) if is_empty else draft


def _landed(draft: Draft) -> list[tuple[KeyPath, Piece, str]]:
    """The path, piece and letter of each line of the landing."""
    table = draft.raw.get(LANDING)
    rows = [((LANDING, key), value) for key, value in table.items()] if isinstance(table, dict) else []
    limbs = [((*path, key), line) for path, value in rows if isinstance(value, dict) for key, line in value.items()]
    return [
        (path, LINE_PIECES[path[-1]], line.strip(" |"))
        for path, line in (*rows, *limbs)
        if path[-1] in LINE_PIECES and isinstance(line, str)
    ]

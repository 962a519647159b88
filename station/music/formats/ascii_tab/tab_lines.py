"""One line of tablature: its label, wherever people put it, and the cells of its bars.

`HH|x-x-|` and `HH: x-x-`, but also `HH-x-x-|` or `HH x-x-|` without the first bar line, `|x-x-| HH` with the label
behind, and `Hi-hat  x-x-x-x-` or `HH-x-x-x-x-` without a bar line. Cells may be parted by blanks to be read,
`x-x- x-x-`; where a line has no other rest, its blanks are the rests.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from station.core.errors import BadInput
from station.music.formats.ascii_tab.tab_letters import LABELS, RESTS, TAB_CHARACTERS, label_key

_LABEL = r"[A-Za-z][A-Za-z0-9 /_.-]{0,13}?"
_BEFORE = re.compile(rf"\s*({_LABEL})\s*[|:]{{1,3}}(.*)$")
_DASHED = re.compile(rf"\s*({_LABEL})-(?=[^ |:]+\|)")
_SPACED = re.compile(rf"\s*({_LABEL})\s+(?=[-.=_xXoOgfFdDbBcshHrRzZ#@]{{4,}}\|)")
_WORD = re.compile(r"[A-Za-z]{3,}")
_BEHIND = re.compile(rf"\s*[|:]{{1,2}}(.{{6,}})\|[|:]?\s*({_LABEL})\s*$")
_DASHED_BARE = re.compile(rf"\s*({_LABEL})-([^ |:]{{8,}})\s*$")
_WITHOUT_BAR_LINES = re.compile(rf"\s*({_LABEL})(?::\s*|\s+)((?=[^ ]*-)[^ |:]{{6,}})\s*$")
_KNOWN = 0.8
"""A line of fewer known letters is words (our choice)."""
_SHORTEST_BAR = 4
"""Cells of a bar that nobody closed: shorter ones are the typist's dashes (our choice)."""
_BLANK = " "
_AGAIN = "%"
_USUAL_LABELS = "BD, SD, HH, Hf, Rd, C1, T1, T2, FT, Sp, Cn or Cb"


@dataclass(frozen=True, slots=True)
class TabBar:
    """The cells of one bar of one line; `columns` where each stands, from 1; whether it opens or closes a repeat."""

    cells: str
    columns: tuple[int, ...]
    opens: bool = False
    closes: bool = False

    def part(self, first: int, end: int | None = None) -> "TabBar":
        """Some of its cells, with its signs."""
        return TabBar(self.cells[first:end], self.columns[first:end], self.opens, self.closes)


@dataclass(frozen=True, slots=True)
class FoundLine:
    """What looks like a line of tablature: its label as typed, and its text from `start` to `end`, in characters."""

    label: str
    start: int
    end: int

    @property
    def is_known(self) -> bool:
        """Whether its label is that of a drum."""
        return label_key(self.label) in LABELS


def found_line(line: str) -> FoundLine | None:
    """The label and the cells of a line in any of the shapes, whether or not its label is known."""
    if "|" in line:
        if (spaced := _SPACED.match(line)) and label_key(spaced[1]) in LABELS:
            return FoundLine(spaced[1], spaced.end(), _end_of_cells(line, spaced.end()))
        if (dashed := _DASHED.match(line)) and label_key(dashed[1]) in LABELS:
            start = dashed.end() - _is_a_rest(line, dashed.end())
            return FoundLine(dashed[1], start, _end_of_cells(line, start))
        if found := _BEFORE.match(line):
            return FoundLine(found[1], found.start(2), _end_of_cells(line, found.start(2)))
        behind = _BEHIND.match(line)
        return FoundLine(behind[2], behind.start(1), behind.end(1)) if behind else None
    if (dashed := _DASHED_BARE.match(line)) and label_key(dashed[1]) in LABELS:
        return FoundLine(dashed[1], dashed.start(2) - (len(dashed[2]) % _SHORTEST_BAR > 0), dashed.end(2))
    bare = _WITHOUT_BAR_LINES.match(line)
    return FoundLine(bare[1], bare.start(2), bare.end(2)) if bare else None


def _is_a_rest(line: str, start: int) -> bool:
    """Whether the dash between a label and the cells from `start` is one of them: all bars then are as long with it."""
    first, *others = line[start:].rstrip(" |").split("|")
    return bool(others) and all(len(bar) == len(first) + 1 for bar in others)


def tab_line(line: str) -> FoundLine | None:
    """The line as tablature, even with a letter or two that nobody knows; None for words and unknown labels."""
    found = found_line(line)
    if not found or not found.is_known:
        return None
    cells = line[found.start : found.end]
    if any(_is_a_word(run) for run in _WORD.findall(cells)):
        return None
    known = sum(c in TAB_CHARACTERS or c in f"|:{_AGAIN}" for c in cells)
    is_sure = "|" in line and known >= _KNOWN * len(cells) and any(c in cells for c in "-xo")
    return found if cells.strip() and (known == len(cells) or is_sure) else None


def _is_a_word(letters: str) -> bool:
    """Whether no drummer strikes so: the key of some tabs has names between its bar lines, `SN|-Snare drum-----|`."""
    return sum(letter not in TAB_CHARACTERS for letter in letters) > 1


def refuse_unknown_label(line: str, number: int, source: str) -> None:
    """Raises `BadInput` for a line that looks like tablature in all but its label: it is no comment."""
    found = found_line(line)
    if found and is_like_tab(line):
        fault = f"no drum is called {found.label!r} here; expected one such as {_USUAL_LABELS}"
        raise BadInput(source, f"line {number}", fault)


def is_like_tab(line: str) -> bool:
    """Whether a line looks like tablature in all but its label, which no drum has."""
    found = found_line(line)
    if not found or "|" not in line or found.is_known:
        return False
    cells = line[found.start : found.end]
    return "-" in cells and bool(re.fullmatch(r"[|:\-xXoO.]{6,}\s*", cells))


def bars_of(line: str, found: FoundLine) -> Iterator[TabBar]:
    """The bars between the line's strokes; one of a single `%` is the bar before it."""
    text = line[found.start : found.end]
    are_rests = _BLANK in text.strip() and not set(text) & (set(RESTS) - {_BLANK}) and not _is_grouped(text)
    at, opens, last = found.start, False, TabBar("", ())
    for bar in text.split("|"):
        opens = opens or bar.lstrip().startswith(":")
        cells = _cells(bar, are_rests)
        if cells.strip(_BLANK) or (are_rests and len(cells) > 1):
            if not last.cells or cells.strip(RESTS) != _AGAIN:
                last = TabBar(cells, _columns(bar, at, are_rests))
            yield replace(last, opens=opens, closes=bar.rstrip().endswith(":"))
            opens = False
        at += len(bar) + 1


def _is_grouped(text: str) -> bool:
    """Whether blanks part groups of as many letters each, such as `xxxx xxxx`."""
    groups = {len(group) for bar in text.split("|") for group in bar.split()}
    return len(groups) == 1 and groups != {1} and "  " not in text.strip()


def _cells(bar: str, are_rests: bool) -> str:
    """The letters of a bar; the blank behind the last cell, which few type, is a rest like the others."""
    cells = "".join(c for c in bar if c != ":" and (are_rests or c != _BLANK))
    return cells + _BLANK if are_rests and len(cells) % 4 == 3 else cells


def _columns(bar: str, at: int, are_rests: bool) -> tuple[int, ...]:
    return tuple(at + i + 1 for i, c in enumerate([*bar, _BLANK]) if c != ":" and (are_rests or c != _BLANK))


def _end_of_cells(line: str, start: int) -> int:
    """What follows the last bar line is words, if it is no bar that nobody closed."""
    last = line.rfind("|")
    rest = line[last + 1 :].rstrip()
    is_open = len(rest) >= _SHORTEST_BAR and "-" in rest and all(letter in TAB_CHARACTERS for letter in rest)
    return last if last >= start and not is_open else len(line)

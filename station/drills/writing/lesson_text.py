"""The text of a lesson, kept as it was written: `show` lays out its lines.

A teacher's comments, the order of keys and the spelling of values stay. What `show` changes is layout alone
(docs/lesson-format.md, "What show changes"): within a grid the `=` and the strings stand under each other, bars and
beats too, with the count above them; blanks at the ends of rows go. Showing what was shown changes nothing.

The TOML of the texts is without a fault; offsets and key paths are those of `core.toml.toml_places`.
"""

import re
from bisect import bisect_left
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise

from station.core.toml.toml_edits import Splice, spliced
from station.core.toml.toml_places import KeyPath, Places
from station.core.toml.toml_source import load
from station.drills.grid.grid import parse_line
from station.drills.grid.tab_symbols import LIMB_TABLES, LINE_PIECES
from station.drills.writing.line_layout import Meters, bar_count, laid_out
from station.drills.writing.written_meters import written_meters

LANDING = "landing"
_LINE_KEYS = frozenset({*LINE_PIECES, "sticking", "loudness"})
_COUNT = re.compile(r"#[ ]{2,}1[\d&.·a-z]*(?: +(?:\d[\d&.·a-z]*|[&·eat]+))*")
"""A count that `show` or a teacher wrote above the lines: digits and the syllables after them, first a 1."""
_BLANKS_AT_END = re.compile(r"[ \t]+(?=\n|$)")


def show(text: str) -> str:
    """The text of a lesson with its lines laid out, but for those at fault; the lesson that it says is the same."""
    text = plain(text)
    raw, _, _ = load(text)
    return _tidied(spliced(text, _edits(raw, Places.of(text))))


def with_grids_shown(text: str, raw: Mapping[str, object], places: Places, grids: Collection[KeyPath]) -> str:
    """The text, plain, with the lines of these grids laid out alone; `raw` is what it says, `places` where."""
    return spliced(text, _edits(raw, places, grids))


def plain(text: str) -> str:
    """The text without a byte order mark, its line ends those of Unix."""
    return text.removeprefix("\ufeff").replace("\r\n", "\n")


def _row_end(text: str, at: int) -> int:
    """Offset of the line end of the row that holds `at`."""
    end = text.find("\n", at)
    return len(text) if end < 0 else end


# --- edits ------------------------------------------------------------------------------------------------------------


def _tidied(text: str) -> str:
    """No blanks at the ends of rows, but for those within a string; one line end at the end."""
    places = Places.of(text)
    strings = sorted((places.values[path], places.ends[path]) for path in places.chars)
    ends_before = [0, *(end for _, end in strings)]
    blanks = (m.span() for m in _BLANKS_AT_END.finditer(text))
    cut = [(a, b, "") for a, b in blanks if a >= ends_before[bisect_left(strings, (a, 0))]]
    return spliced(text, cut).strip("\n") + "\n"


@dataclass(frozen=True, slots=True)
class _Entry:
    """A line of a grid in the text: from `row` to `row_end`, its key as it is spelt, its string, what follows that."""

    row: int
    row_end: int
    key: str
    quote: str
    line: str
    rest: str

    @property
    def has_rows(self) -> bool:
        """Whether its string runs over several rows of the text."""
        return "\n" in self.line.strip()

    def edit(self, width: int, string: str) -> Splice:
        """The whole row written anew: the key, `=` at column `width`, its string in quotes, and what followed."""
        return self.row, self.row_end, f"{self.key:<{width}} = {string}{self.rest}"


def _edits(raw: Mapping[str, object], places: Places, grids: Collection[KeyPath] | None = None) -> list[Splice]:
    """What changes in the blocks of lines of all grids, or of some; a block is what stands below one header."""
    meters = written_meters(raw)
    blocks: dict[tuple[KeyPath, int], list[_Entry]] = {}
    for path, offset in places.values.items():
        table = _table_of(path)
        if table is None or (grids is not None and not any(table[: len(grid)] == grid for grid in grids)):
            continue
        entry = _entry(raw, places, path)
        if entry:
            header = bisect_left(places.headers, offset)
            blocks.setdefault((table, header), []).append(entry)
    edits: list[Splice] = []
    for (table, _), block in blocks.items():
        sound = [entry for entry in block if table == (LANDING,) or _is_sound(entry.line, meters.get(table))]
        edits += _block_edits(places.text, sound, meters.get(table)) if sound else []
    return edits


def _is_sound(line: str, meters: Meters | None) -> bool:
    """Whether all bars of a line can be read."""
    if meters is None:
        return False
    frames = [meters.frame(bar) for bar in range(len(meters.in_turn))]
    return all(bar.sound for bar in parse_line(line, frames, lambda _char, _words: None))


def _table_of(path: KeyPath) -> KeyPath | None:
    """The path of the grid, cycle or landing whose line stands at `path`; None where no line does."""
    if path[-1] not in _LINE_KEYS or path[0] not in ("grid", LANDING) or "dynamics" in path:
        return None
    return path[:-2] if path[-2] in LIMB_TABLES else path[:-1]


def _entry(raw: Mapping[str, object], places: Places, path: KeyPath) -> _Entry | None:
    """The line at `path`; None where it has no row of its own, as in a table in braces."""
    text, key, start, end = places.text, places.keys[path], places.values[path], places.ends[path]
    row, row_end = text.rfind("\n", 0, key) + 1, _row_end(text, end)
    line = _value_at(raw, path)
    if text[row:key].strip() or "\n" in text[key:start] or not isinstance(line, str):
        return None
    return _Entry(
        row, row_end, text[key : text.index("=", key)].rstrip(), text[start], line, text[end:row_end].rstrip()
    )


def _value_at(raw: object, path: KeyPath) -> object:
    for key in path:
        raw = raw[key]  # type: ignore[index] # the path is one of this value
    return raw


# --- a block of lines -------------------------------------------------------------------------------------------------


def _block_edits(text: str, block: Sequence[_Entry], meters: Meters | None) -> list[Splice]:
    """The rows of one block; `meters` None where lines are single letters (a landing)."""
    width = max(len(entry.key) for entry in block)
    single = [entry for entry in block if not entry.has_rows]
    lines, count = [entry.line.strip() for entry in single], ""
    if meters:
        lines, count = laid_out(lines, meters)
    edits = [entry.edit(width, f"{entry.quote}{line}{entry.quote}") for entry, line in zip(single, lines, strict=True)]
    for entry in block:
        if entry.has_rows:
            edits.append(entry.edit(width, f"{entry.quote * 3}\n{_rows(entry.line, meters)}{entry.quote * 3}"))
    return edits + (_count_edits(text, single[0].row, f"#{'':{width + 3}}{count}") if count.strip() else [])


def _count_edits(text: str, row: int, count: str) -> list[Splice]:
    """The count above the line that begins at `row`: in the place of an older one among the comments there, or new."""
    end = row - 1
    while end >= 0:
        start = text.rfind("\n", 0, end) + 1
        older = text[start:end].strip()
        if not older.startswith("#"):
            break
        if _COUNT.fullmatch(older):
            return [(start, end, _in_the_words_of(older, count))]
        end = start - 1
    return [(row, row, f"{count}\n")]


def _in_the_words_of(older: str, count: str) -> str:
    """The count with the letters of an older one that counts as many cells in each beat: people count as they like."""
    theirs, ours = older[1:].split(), count[1:].split()
    if [*map(len, theirs)] != [*map(len, ours)]:
        return count
    letters = iter("".join(theirs))
    return "#" + "".join(" " if char == " " else next(letters) for char in count[1:])


def _rows(line: str, meters: Meters | None) -> str:
    """The rows of a string of several; as they are where a bar goes on in the next row."""
    rows = [row.strip() for row in line.strip().split("\n")]
    said = [row for row in rows if row]
    if meters and all(a.endswith("|") or b.startswith("|") for a, b in pairwise(said)):
        laid = iter(_under_each_other(said, meters))
        rows = [row and next(laid) for row in rows]
    return "".join(f"{row}\n" for row in rows)


def _under_each_other(rows: Sequence[str], meters: Meters) -> list[str]:
    """The rows of one line with their bars under each other, where all bars are of one meter."""
    if len(meters.in_turn) == 1:
        return laid_out(rows, meters)[0]
    starts = accumulate(map(bar_count, rows[:-1]), initial=0)
    return [laid_out([row], meters.after(start))[0][0] for row, start in zip(rows, starts, strict=True)]

"""What a text of tablature holds: systems of lines, their bars cut into cells, and the words about them.

A system is a run of tab lines; a blank line or one of words ends it. A label that stands twice in a run begins the next
system, for some tabs leave no line between.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from station.core.errors import BadInput
from station.music.formats.ascii_tab.tab_letters import LABELS, TAB_CHARACTERS, LineMeaning, label_key
from station.music.tempo import MAX_BPM, MIN_BPM

_TAB_LINE = re.compile(r"\s*([A-Za-z][A-Za-z0-9 /_.-]{0,13}?)\s*[|:]{1,3}(.*)$")
_COUNT_LINE = re.compile(r"[\s|]*1[\s|+&aeiou.\-0-9]*$")
_TIMES = re.compile(r"(?:[x×]\s*([0-9]{1,3})|([0-9]{1,3})\s*[x×])(?![A-Za-z0-9])", re.IGNORECASE)
_METER = re.compile(r"(?<![0-9/])([0-9]{1,2})\s*/\s*(1|2|4|8|16|32)(?![0-9/])")
_TEMPO = re.compile(
    r"(?:tempo|bpm|♩|speed)\s*[:=]?\s*([0-9]{2,3}(?:\.[0-9]{1,9})?)|([0-9]{2,3}(?:\.[0-9]{1,9})?)\s*bpm", re.I
)
_NAMED = {
    "title": re.compile(r"\s*(?:song|title|name)\s*[:=]\s*(.+)", re.IGNORECASE),
    "author": re.compile(r"\s*(?:artist|band|by|tabbed by|author)\s*[:=]\s*(.+)", re.IGNORECASE),
    "about": re.compile(r"\s*(?:notes?|comments?|about)\s*[:=]\s*(.+)", re.IGNORECASE),
}
_SECTION = re.compile(r"\s*(?:\[([^\]|]{1,40})\]|([A-Za-z][A-Za-z0-9 '/-]{0,30}):?)\s*(?:\(?[x×0-9\s]*\)?)\s*$")
_LOOSE_X = re.compile(r"\bX\b[^A-Za-z\n]{1,6}[^\n]*\b(?:loose|open|slosh)", re.IGNORECASE)

_KNOWN = 0.8
"""A line of fewer known letters is words (our choice)."""


@dataclass(frozen=True, slots=True)
class TabBar:
    """The cells of one bar of one line; `column` where they begin, from 1; whether a repeat begins or ends with it."""

    cells: str
    column: int
    opens: bool = False
    closes: bool = False


@dataclass(frozen=True, slots=True)
class TabRow:
    """One line of a system."""

    label: str
    meaning: LineMeaning
    bars: tuple[TabBar, ...]
    line: int


@dataclass(slots=True)
class TabSystem:
    """Lines that are played together, `times` in all; `count` is the line of counting above or below them."""

    rows: list[TabRow] = field(default_factory=list)
    count: str = ""
    times: int = 1
    section: str = ""
    meter: tuple[int, int] | None = None
    tempo_bpm: float | None = None

    @property
    def labels(self) -> set[str]:
        """What its lines are called."""
        return {row.label for row in self.rows}


@dataclass(slots=True)
class TabText:
    """All of a text. `loose_x`: its key says that X on a hi-hat is a loose stroke, and no accent."""

    systems: list[TabSystem] = field(default_factory=list)
    words: dict[str, str] = field(default_factory=dict)
    loose_x: bool = False


def tab_text(text: str, source: str) -> TabText:
    """The systems of `text` in their order; raises `BadInput` for a tab line whose label or letters are unknown."""
    found, waiting, system = TabText(loose_x=bool(_LOOSE_X.search(text))), TabSystem(), TabSystem()

    def close() -> None:
        nonlocal system, waiting
        if system.rows:
            found.systems.append(system)
            waiting = TabSystem()
        system = TabSystem()

    for number, line in enumerate(text.expandtabs().splitlines(), 1):
        if (row := _row(line, number, source)) is not None:
            if row.label in system.labels:
                close()
            if not system.rows:
                system = waiting
            system.rows.append(row)
            system.times = max(system.times, _times(line.rpartition("|")[2]))
        elif _COUNT_LINE.match(line):
            (system if system.rows else waiting).count = line
        else:
            close()
            _read_words(line, found, waiting)
    close()
    return found


def is_tab(data: bytes) -> bool:
    """Whether a text holds tablature: two lines one below the other that begin with labels of drums."""
    text = data[: 1 << 16].decode("utf-8", "replace")
    runs = 0
    for line in text.splitlines():
        runs = runs + 1 if _is_tab_line(line) else 0
        if runs == 2:
            return True
    return False


# --- a line -----------------------------------------------------------------------------------------------------------


def _is_tab_line(line: str) -> bool:
    """Whether a line is tablature, even with a letter or two that nobody knows."""
    found = _TAB_LINE.match(line)
    if not found or label_key(found[1]) not in LABELS or "|" not in line:
        return False
    cells = found[2].rpartition("|")[0] or found[2]
    known = sum(c in TAB_CHARACTERS or c in "|:" for c in cells)
    return bool(cells.strip()) and (
        known == len(cells) or (known >= _KNOWN * len(cells) and any(c in cells for c in "-xo"))
    )


def _row(line: str, number: int, source: str) -> TabRow | None:
    if not _is_tab_line(line):
        _refuse_unknown_label(line, number, source)
        return None
    found = _TAB_LINE.match(line)
    assert found is not None, "_is_tab_line matches it too"
    label = label_key(found[1])
    return TabRow(label, LABELS[label], tuple(_bars(line, found.start(2))), number)


def _refuse_unknown_label(line: str, number: int, source: str) -> None:
    """A line that looks like tablature in all but its label is no comment."""
    found = _TAB_LINE.match(line)
    if found and re.fullmatch(r"[|:\-xXoO.]{6,}\s*(?:\|.*)?", found[2]) and "-" in found[2] and "|" in line:
        raise BadInput(source, f"line {number}", f"no drum is called {found[1]!r} here")


def _bars(line: str, start: int) -> Iterator[TabBar]:
    """The bars between the lines' strokes; what follows the last stroke is words."""
    end = line.rindex("|") if line.rfind("|") >= start else len(line)
    at, opens = start, False
    for cells in line[start:end].split("|"):
        opens = opens or cells.lstrip().startswith(":")
        if bare := cells.strip().strip(":"):
            yield TabBar(bare, at + 1 + cells.index(bare), opens, cells.rstrip().endswith(":"))
            opens = False
        at += len(cells) + 1


def _times(words: str) -> int:
    found = _TIMES.search(words)
    return min(max(int(found[1] or found[2]), 1), 64) if found else 1


# --- words ------------------------------------------------------------------------------------------------------------


def _read_words(line: str, found: TabText, waiting: TabSystem) -> None:
    """What a line of words says of the whole, or of the system that follows."""
    if not line.strip():
        return
    for key, pattern in _NAMED.items():
        if (said := pattern.match(line)) and key not in found.words:
            found.words[key] = " ".join(said[1].split())
            return
    if (meter := _METER.search(line)) and int(meter[1]):
        waiting.meter = int(meter[1]), int(meter[2])
    if tempo := _TEMPO.search(line):
        bpm = float(tempo[1] or tempo[2])
        waiting.tempo_bpm = bpm if MIN_BPM <= bpm <= MAX_BPM else None
    if not (meter or tempo) and (section := _SECTION.match(line)):
        waiting.section = " ".join((section[1] or section[2]).split())
        waiting.times = _times(line)

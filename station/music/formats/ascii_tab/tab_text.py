"""What a text of tablature holds: systems of lines, their bars cut into cells, and the words about them.

A system is a run of tab lines; a blank line or one of words ends it. A label that stands twice in a run begins the next
system, for some tabs leave no line between.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from station.core.errors import BadInput
from station.music.formats.ascii_tab.tab_letters import LABELS, LineMeaning, label_key
from station.music.formats.ascii_tab.tab_lines import TabBar, bars_of, is_like_tab, refuse_unknown_label, tab_line
from station.music.formats.ascii_tab.words_of_tabs import (
    MOST_WORDS,
    asks_for_order,
    author_in,
    meter_in,
    part_name,
    says_again,
    swing_in,
    tempo_in,
    tidy,
    times_in,
    title_in,
)
from station.music.swing import Swing

_COUNT_LINE = re.compile(r"[\s|]*1[\s|+&aeiou.\-0-9]*$")
_NAMED = {
    "title": re.compile(r"\s*(?:song|title|name)\s*[:=]\s*(.+)", re.IGNORECASE),
    "author": re.compile(r"\s*(?:artist|band|by|tabbed by|author)\s*[:=]\s*(.+)", re.IGNORECASE),
    "about": re.compile(r"\s*(?:notes?|comments?|about)\s*[:=]\s*(.+)", re.IGNORECASE),
}
_LOOSE_X = re.compile(r"\bX\b[^A-Za-z\n]{1,6}[^\n]{0,80}\b(?:loose|open|slosh)", re.IGNORECASE)

_MOST_LINES = 50_000
"""Our choice: 2000 bars, each in a system of its own with every drum there is, read in less than a second."""


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
    """All of a text.

    `loose_x`: its key says that X on a hi-hat is a loose stroke, and no accent. `unheeded` are the lines, each with its
    number, that ask for an order of playing in words which nobody here understands.
    """

    systems: list[TabSystem] = field(default_factory=list)
    words: dict[str, str] = field(default_factory=dict)
    loose_x: bool = False
    swing: Swing = field(default_factory=Swing)
    unheeded: list[tuple[int, str]] = field(default_factory=list)


def tab_text(text: str, source: str) -> TabText:
    """The systems of `text` in their order; raises `BadInput` for a tab line whose label or letters are unknown."""
    lines = text.expandtabs().splitlines()
    if len(lines) > _MOST_LINES:
        raise BadInput(source, "", f"{len(lines):,} lines; expected at most {_MOST_LINES:,}")
    loose_x = any(_LOOSE_X.search(line[:MOST_WORDS]) for line in lines)
    found, waiting, system = TabText(loose_x=loose_x), TabSystem(), TabSystem()

    def close() -> None:
        nonlocal system, waiting
        if system.rows:
            found.systems.append(system)
            waiting = TabSystem()
        system = TabSystem()

    for number, line in enumerate(lines[(top := _heading(lines, found, waiting)) :], top + 1):
        if (row := _row(line, number, source)) is not None:
            if row.label in system.labels:
                close()
            if not system.rows:
                system = waiting
            system.rows.append(row)
            system.times = max(system.times, times_in(line.rpartition("|")[2][:MOST_WORDS]))
        elif _COUNT_LINE.match(line):
            (system if system.rows else waiting).count = line
        elif system.rows and says_again(line) and times_in(tidy(line)) > 1:
            system.times = max(system.times, times_in(tidy(line)))
        else:
            close()
            is_alone = not "".join(lines[number : number + 1]).strip()
            repeats = found.systems and is_alone and says_again(line) and waiting == TabSystem()
            if repeats and times_in(tidy(line)) > 1:
                found.systems[-1].times = max(found.systems[-1].times, times_in(tidy(line)))
            else:
                _read_words(line, number, found, waiting)
    close()
    return found


def is_tab(data: bytes) -> bool:
    """Whether a text holds tablature: two such lines one below the other, and one of them has the label of a drum."""
    text = data[: 1 << 16].decode("utf-8", "replace")
    lines = text.splitlines()
    known = [tab_line(line) is not None for line in lines]
    return any(
        (known[i] or known[i + 1]) and all(known[k] or is_like_tab(lines[k]) for k in (i, i + 1))
        for i in range(len(lines) - 1)
    )


# --- a line -----------------------------------------------------------------------------------------------------------


def _row(line: str, number: int, source: str) -> TabRow | None:
    found = tab_line(line)
    if found is None:
        refuse_unknown_label(line, number, source)
        return None
    label = label_key(found.label)
    return TabRow(label, LABELS[label], tuple(bars_of(line, found)), number)


# --- words ------------------------------------------------------------------------------------------------------------


def _heading(lines: Sequence[str], found: TabText, waiting: TabSystem) -> int:
    """Read the title, and who it is by, where they stand alone at the top; how many lines that took.

    A line right above tablature is the name of a part, and so is one that is called as parts are.
    """
    top = next((i for i, line in enumerate(lines) if any(map(str.isalnum, line))), len(lines))
    below = lines[top + 1 : top + 2]
    if (
        not below
        or max(len(lines[top]), len(below[0])) > MOST_WORDS
        or tab_line(below[0])
        or _COUNT_LINE.match(below[0])
    ):
        return 0
    title = title_in(tidy(lines[top]))
    if not title or tab_line(lines[top]):
        return 0
    found.words["title"] = title
    _read_time(tidy(lines[top]), waiting)
    author = author_in(tidy(below[0]), not "".join(lines[top + 2 : top + 3]).strip())
    if author:
        found.words["author"] = author
    return top + (2 if author else 1)


def _read_words(line: str, number: int, found: TabText, waiting: TabSystem) -> None:
    """What a line of words says of the whole, or of the system that follows."""
    if not line.strip():
        return
    words = " ".join(line.split())
    for key, pattern in _NAMED.items():
        if (said := pattern.match(words)) and key not in found.words:
            found.words[key] = said[1]
            return
    line = tidy(line)
    _read_time(line, waiting)
    found.swing = swing_in(line) or found.swing
    if name := part_name(line):
        waiting.section, waiting.times = name, times_in(line)
    if asks_for_order(line):
        found.unheeded.append((number, line))


def _read_time(line: str, waiting: TabSystem) -> None:
    waiting.meter = meter_in(line) or waiting.meter
    waiting.tempo_bpm = tempo_in(line) or waiting.tempo_bpm

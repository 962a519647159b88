"""What a text of tablature holds: systems of lines, their bars cut into cells, and the words about them.

A system is a run of tab lines; a blank line or one of words ends it. A label that stands twice in a run begins the next
system, for some tabs leave no line between.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from station.core.errors import BadInput
from station.music.formats.ascii_tab.tab_letters import LABELS, LineMeaning, label_key
from station.music.formats.ascii_tab.tab_lines import TabBar, bars_of, refuse_unknown_label, tab_line
from station.music.tempo import MAX_BPM, MIN_BPM

_COUNT_LINE = re.compile(r"[\s|]*1[\s|+&aeiou.\-0-9]*$")
_TIMES = re.compile(
    r"(?:\b(?:repeat(?:ed|s)?|play(?:ed|s)?)(?: (?:this|it|all))?[ :]*)?"
    r"(?:[x×]\s*([0-9]{1,3})|([0-9]{1,3})\s*(?:[x×]|times)|(twice))(?![A-Za-z0-9])",
    re.IGNORECASE,
)
_METER = re.compile(r"(?<![0-9/])([0-9]{1,2})\s*/\s*(1|2|4|8|16|32)(?![0-9/])")
_TEMPO = re.compile(
    r"(?:tempo|bpm|♩|speed)\s*[:=]?\s*([0-9]{2,4}(?:\.[0-9]{1,9})?)|([0-9]{2,4}(?:\.[0-9]{1,9})?)\s*bpm", re.I
)
_NAMED = {
    "title": re.compile(r"\s*(?:song|title|name)\s*[:=]\s*(.+)", re.IGNORECASE),
    "author": re.compile(r"\s*(?:artist|band|by|tabbed by|author)\s*[:=]\s*(.+)", re.IGNORECASE),
    "about": re.compile(r"\s*(?:notes?|comments?|about)\s*[:=]\s*(.+)", re.IGNORECASE),
}
_IN_BRACKETS = re.compile(r"\s*\[(?=[^\]|]{0,39}[A-Za-z])([^\]|]{1,40})\]")
_SECTION = re.compile(r"\s*([A-Za-z][A-Za-z0-9 '/-]{0,30}):?\s*(?:\([\s0-9]*\))?:?\s*$")
_PART = re.compile(
    r"\s*(?:intro|verse|(?:pre|post)?[ -]?chorus|refrain|bridge|solo|outro|ending|break|interlude|fill|groove|beat|"
    r"part|main|middle|coda|tag|hook|riff|[a-h])\b",
    re.IGNORECASE,
)
"""What parts of songs are called."""
_TITLE = re.compile(r"\s*([^\s|:=*#~-][^|:=]{0,59}?)\s*$")
_BY = re.compile(r"\s*by\s+(.{1,60}?)\s*$", re.IGNORECASE)
_KEY = re.compile(r"\s*(?:\S\s*[-–=:]\s|(?:key|legend)\b|(?:bar|measure)s? ?[0-9])", re.IGNORECASE)
"""A line of the key of letters, "f - flam", or the word above it, or numbers of bars: no name of a part."""
_AGAIN = re.compile(r"[\s(]*(?:repeat|play|[x×]\s*[0-9]|[0-9]+\s*(?:[x×]|times)|twice)", re.IGNORECASE)
_LOOSE_X = re.compile(r"\bX\b[^A-Za-z\n]{1,6}[^\n]{0,80}\b(?:loose|open|slosh)", re.IGNORECASE)

_MOST_WORDS = 300
"""Characters of a line in which a name, a tempo or a meter is looked for (our choice: no screen shows more of one)."""
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
    """All of a text. `loose_x`: its key says that X on a hi-hat is a loose stroke, and no accent."""

    systems: list[TabSystem] = field(default_factory=list)
    words: dict[str, str] = field(default_factory=dict)
    loose_x: bool = False


def tab_text(text: str, source: str) -> TabText:
    """The systems of `text` in their order; raises `BadInput` for a tab line whose label or letters are unknown."""
    lines = text.expandtabs().splitlines()
    if len(lines) > _MOST_LINES:
        raise BadInput(source, "", f"{len(lines):,} lines; expected at most {_MOST_LINES:,}")
    loose_x = any(_LOOSE_X.search(line[:_MOST_WORDS]) for line in lines)
    found, waiting, system = TabText(loose_x=loose_x), TabSystem(), TabSystem()

    def close() -> None:
        nonlocal system, waiting
        if system.rows:
            found.systems.append(system)
            waiting = TabSystem()
        system = TabSystem()

    for number, line in enumerate(lines[(top := _heading(lines, found)) :], top + 1):
        if (row := _row(line, number, source)) is not None:
            if row.label in system.labels:
                close()
            if not system.rows:
                system = waiting
            system.rows.append(row)
            system.times = max(system.times, _times(line.rpartition("|")[2][:_MOST_WORDS]))
        elif _COUNT_LINE.match(line):
            (system if system.rows else waiting).count = line
        elif system.rows and _AGAIN.match(line):
            system.times = max(system.times, _times(_tidy(line)))
        else:
            close()
            is_alone = not "".join(lines[number : number + 1]).strip()
            if found.systems and is_alone and _AGAIN.match(line) and waiting == TabSystem():
                found.systems[-1].times = max(found.systems[-1].times, _times(_tidy(line)))
            _read_words(_tidy(line), found, waiting)
    close()
    return found


def is_tab(data: bytes) -> bool:
    """Whether a text holds tablature: two lines one below the other that begin with labels of drums."""
    text = data[: 1 << 16].decode("utf-8", "replace")
    runs = 0
    for line in text.splitlines():
        runs = runs + 1 if tab_line(line) else 0
        if runs == 2:
            return True
    return False


# --- a line -----------------------------------------------------------------------------------------------------------


def _row(line: str, number: int, source: str) -> TabRow | None:
    found = tab_line(line)
    if found is None:
        refuse_unknown_label(line, number, source)
        return None
    label = label_key(found.label)
    return TabRow(label, LABELS[label], tuple(bars_of(line, found)), number)


def _times(words: str) -> int:
    found = _TIMES.search(words)
    return min(max(int(found[1] or found[2] or 2), 1), 64) if found else 1


# --- words ------------------------------------------------------------------------------------------------------------


def _heading(lines: Sequence[str], found: TabText) -> int:
    """Read the title, and who it is by, where they stand alone at the top; how many lines that took.

    A line right above tablature is the name of a part, and so is one that is called as parts are.
    """
    top = next((i for i, line in enumerate(lines) if line.strip()), len(lines))
    below = lines[top + 1 : top + 2]
    if (
        not below
        or max(len(lines[top]), len(below[0])) > _MOST_WORDS
        or tab_line(below[0])
        or _COUNT_LINE.match(below[0])
    ):
        return 0
    line = _tidy(lines[top])
    title = _TITLE.match(line)
    if not title or _PART.match(line) or tab_line(lines[top]) or _says_time(line):
        return 0
    found.words["title"] = title[1]
    author = _BY.match(_tidy(below[0]))
    if author:
        found.words["author"] = author[1]
    return top + (2 if author else 1)


def _tidy(line: str) -> str:
    """Its words with one blank between: patterns then need not look through a million of them again and again."""
    return " ".join(line.split())


def _says_time(line: str) -> bool:
    return bool(_METER.search(line) or _TEMPO.search(line) or _COUNT_LINE.match(line))


def _read_words(line: str, found: TabText, waiting: TabSystem) -> None:
    """What a line of words says of the whole, or of the system that follows."""
    if not line.strip():
        return
    for key, pattern in _NAMED.items():
        if (said := pattern.match(line)) and key not in found.words:
            found.words[key] = " ".join(said[1].split())
            return
    line = line.rstrip()[:_MOST_WORDS]
    if (meter := _METER.search(line)) and int(meter[1]):
        waiting.meter = int(meter[1]), int(meter[2])
    if tempo := _TEMPO.search(line):
        bpm = float(tempo[1] or tempo[2])
        waiting.tempo_bpm = bpm if MIN_BPM <= bpm <= MAX_BPM else None
    named = _TIMES.sub("", line)
    if section := _IN_BRACKETS.match(line) or (None if meter or tempo or _KEY.match(line) else _SECTION.match(named)):
        waiting.section = " ".join(section[1].split()).removesuffix(" -")
        waiting.times = _times(line)

"""The words that people write round their tabs: titles, names of parts, tempo, meter, swing, how often it is played.

All patterns look through lines that `tidy` made short, so that none takes long.
"""

import re

from station.core.units import PPQ
from station.music.formats.words_of_swing import swing_in_words
from station.music.swing import MAX_RATIO, MIN_RATIO, Swing
from station.music.tempo import MAX_BPM, MIN_BPM

MOST_WORDS = 300
"""Characters of a line in which a name, a tempo or a meter is looked for (our choice: no screen shows more of one)."""

_NUMBER = r"([0-9]{2,4}(?:\.[0-9]{1,9})?)"
_TEMPO = re.compile(
    rf"(?:\b(?:tempo|bpm|speed)|♩|@)\s*[:=]?\s*{_NUMBER}"
    rf"|(?:tempo\s*[:=]?\s*)?\b(?:q|quarter(?: notes?)?|1/4)\s*=\s*{_NUMBER}(?:\s*bpm)?"
    rf"|{_NUMBER}\s*bpm",
    re.IGNORECASE,
)
SWUNG_CELLS = {"eighths": PPQ // 2, "sixteenths": PPQ // 4, "32nds": PPQ // 8}
_SWING_IN_NUMBERS = re.compile(
    rf"\bswing ([0-9]{{1,2}}(?:\.[0-9]{{1,9}})?) ?: ?1(?: of)? ({'|'.join(SWUNG_CELLS)})\b", re.IGNORECASE
)
_METER = re.compile(r"(?<![0-9/])([0-9]{1,2})\s*/\s*(1|2|4|8|16|32)(?![0-9/])")
_ABOUT_TIME = re.compile(
    r"\b(?:time|signature|meter|tempo|count|in|at|feel|swing|swung|straight|[0-9]+ths)\b", re.IGNORECASE
)
_TIMES = re.compile(
    r"(?:\b(?:repeat(?:ed|s)?|play(?:ed|s)?)(?: (?:this|it|all))?[ :]*)?"
    r"(?:[x×]\s*([0-9]{1,3})|([0-9]{1,3})\s*(?:[x×]|times)|(twice))(?![A-Za-z0-9])",
    re.IGNORECASE,
)
_MOST_TIMES = 64
_AGAIN = re.compile(r"[\s(\[]*(?:repeat|play|[x×]\s*[0-9]|[0-9]+\s*(?:[x×]|times)|twice)", re.IGNORECASE)
_ASKS_FOR_ORDER = re.compile(
    r"\brepeat|\bplay\b.*\bagain\b|\b(?:go|back)\b.* to\b"
    r"|\bd\.? ?[cs]\.(?:\s|$)|\bda capo\b|\bdal segno\b|\b(?:to|al) coda\b",
    re.IGNORECASE,
)
_SAME = re.compile(r"\bsame as\b|\bas above\b|\bsimile\b", re.IGNORECASE)
_IN_BRACKETS = re.compile(r"\s*\[(?=[^\]|]{0,39}[A-Za-z])([^\]|]{1,40})\]")
_RULES = " \t=*~#_-"
_PLAIN_NAME = re.compile(r"\s*([A-Za-z][A-Za-z0-9 '/-]{0,30}):?\s*(?:\([\s0-9]*\))?:?\s*$")
_KIND = (
    r"(?:intro|verse|(?:pre|post)?[ -]?chorus|refrain|bridge|solo|outro|ending|break|interlude|fill|groove|beat|"
    r"part|main|middle|coda|tag|hook|riff)"
)
"""What parts of songs are called."""
_COUNTED = r"(?:(?:[0-9]{1,2}(?:st|nd|rd|th)|first|second|third|last|final|main) )?"
_PART = re.compile(rf"\s*(?:{_COUNTED}{_KIND}\b|[a-h]\s*(?:$|[(:]))", re.IGNORECASE)
_NAME_AND_REMARK = re.compile(
    rf"\s*({_COUNTED}{_KIND}(?: (?:[0-9]{{1,2}}|[a-h]|i{{1,3}}|iv))?)\s*(?:$|[(\[:,]|[-–—] )", re.IGNORECASE
)
_SHORT_AND_NAME = re.compile(
    rf"\s*[A-Za-z][0-9]?\s*[:=)-]\s*({_COUNTED}{_KIND}(?: [0-9a-h]{{1,2}})?)\s*:?\s*$", re.IGNORECASE
)
"""A letter and the part that it stands for, "V: verse"."""
_KEY = re.compile(r"\s*(?:\S\s*[-–=:]\s|(?:key|legend)\b|(?:bar|measure)s? ?[0-9])", re.IGNORECASE)
"""A line of the key of letters, "f - flam", or the word above it, or numbers of bars: no name of a part."""
_TITLE = re.compile(r"([^|:=]{1,60})$")
_BY = re.compile(r"\s*(?:(?:tabbed|transcribed|written|arranged|played|drums) )?by:?\s+(.{1,60}?)\s*$", re.IGNORECASE)
_OF_A_NAME = re.compile(r"[A-Z0-9][\w'.!-]*|&|and|of|the")
_MOST_OF_A_NAME = 6
"""Words of a band's name (our choice: longer lines are sentences)."""


def tidy(line: str) -> str:
    """Its words with one blank between, and no more of them than anybody reads."""
    return " ".join(line[: 4 * MOST_WORDS].split())[:MOST_WORDS]


def title_in(line: str) -> str:
    """The title that a line at the top is, without rules round it and a tempo beside it; empty for other words."""
    tempo = _TEMPO.search(line)
    before = (line[: tempo.start()] if tempo else line).strip(_RULES + ",;").rstrip("([ ,;")
    words = before or (line[tempo.end() :] if tempo else "").lstrip(")] ").strip(_RULES + ",;")
    title = _TITLE.match(words)
    is_time_alone = says_time(line) and not _tells_more(words)
    return title[1] if title and not is_time_alone and not _PART.match(words) else ""


def _tells_more(words: str) -> bool:
    return any(c.isalpha() for c in _ABOUT_TIME.sub("", _METER.sub("", words)))


def author_in(line: str, is_alone: bool) -> str:
    """Who a line right below the title names, "by Ada" or, where the line is alone there, a band's name."""
    if said := _BY.match(line):
        return said[1]
    words = line.split()
    is_name = bool(words) and len(words) <= _MOST_OF_A_NAME and all(_OF_A_NAME.fullmatch(word) for word in words)
    return line if is_alone and is_name and not _PART.match(line) and not says_time(line) else ""


def part_name(line: str) -> str:
    """What a line calls the part of the song below it; empty where it names none."""
    if (says_again(line) and times_in(line) > 1) or _SAME.search(line):
        return ""
    if found := _IN_BRACKETS.match(line):
        return tidy(found[1])
    named = _TIMES.sub("", line).strip(_RULES)
    if found := _NAME_AND_REMARK.match(named) or _SHORT_AND_NAME.match(named):
        return found[1]
    if says_time(line) or _KEY.match(line) or _AGAIN.match(line) or _ASKS_FOR_ORDER.search(line):
        return ""
    plain = _PLAIN_NAME.match(named)
    return tidy(plain[1]).removesuffix(" -") if plain else ""


def tempo_in(line: str) -> float | None:
    """The beats a minute that a line says; None where it says none that anybody plays."""
    found = _TEMPO.search(line)
    bpm = float(next(filter(None, found.groups()))) if found else 0.0
    return bpm if MIN_BPM <= bpm <= MAX_BPM else None


def meter_in(line: str) -> tuple[int, int] | None:
    """The meter that a line says."""
    found = _METER.search(_TEMPO.sub("", line))
    return (int(found[1]), int(found[2])) if found and int(found[1]) else None


def swing_in(line: str) -> Swing | None:
    """The swing that a line, or what commas part of it, asks for."""
    if found := _SWING_IN_NUMBERS.search(line):
        return Swing(float(found[1]), SWUNG_CELLS[found[2].lower()]) if _is_played(float(found[1])) else None
    for words in re.split(r"[,;()|]|[-–—:] | [-–—]", line.lower()):
        if swing := swing_in_words(words.strip(_RULES + ".!")):
            return swing
    return None


def swing_in_numbers(swing: Swing) -> str:
    """The words from which `swing_in` reads just this swing; empty where there are none."""
    cells = next((cells for cells, ticks in SWUNG_CELLS.items() if ticks == swing.unit_ticks), "")
    words = f"Swing {swing.ratio:.6g}:1 of {cells}"
    return words if cells and swing.stands_in_words and swing_in(words) == swing else ""


def _is_played(ratio: float) -> bool:
    return MIN_RATIO <= ratio <= MAX_RATIO


def says_time(line: str) -> bool:
    """Whether it speaks of tempo or meter."""
    return bool(_METER.search(line) or _TEMPO.search(line))


def times_in(line: str) -> int:
    """How often a line says that its part is played, 1 to 64; 1 where it says nothing of it."""
    found = _TIMES.search(line)
    return min(max(int(found[1] or found[2] or 2), 1), _MOST_TIMES) if found else 1


def says_again(line: str) -> bool:
    """Whether it begins as a line does that repeats what stands above it."""
    return bool(_AGAIN.match(line))


def asks_for_order(line: str) -> bool:
    """Whether it speaks of what is played next, in words that are for a person."""
    return bool(_ASKS_FOR_ORDER.search(_TIMES.sub("", line)) or _SAME.search(line))

"""A GrooveScribe link taken apart into its lines of letters, and put together.

`?TimeSig=4/4&Div=16&Tempo=90&Swing=20&Measures=2&Title=…&H=|x-x-|…&S=…&K=…&T1=…&T4=…&Stickings=|R-L-|…`: keys in any
case, encoded as URLs are or not; `|:!()[]` and spaces count for nothing. `Div` is how many cells a whole note has. A
line that is at least twice as long or as short as the bars is thinned or spread, and H, S and K that are not there are
filled, as GrooveScribe does. What it would read otherwise than it stands is told in `lost`.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from urllib.parse import quote, unquote

from station.core.disk.utf8 import one_line
from station.core.errors import BadInput
from station.core.units import PPQ
from station.music.formats.groovescribe.groove_letters import LETTERS
from station.music.tempo import MeterChange

DIVISIONS = (4, 8, 12, 16, 24, 32, 48)
"""Those that GrooveScribe's page offers."""
MOST_BARS = 10
DEFAULT_TEMPO, LEAST_TEMPO, MOST_TEMPO = 80, 20, 400
MOST_SWING = 50
"""Percent: GrooveScribe's slider ends there, and a link that says more is played so."""
STICKINGS = "STICKINGS"
WEB_PAGE = "https://www.mikeslessons.com/gscribe"
"""Where GrooveScribe lives: a written link opens there as it stands."""

_LINES = (*LETTERS, STICKINGS)
_OTHER_NAMES = {"HH": "H", "B": "K"}
_SETTINGS = ("TIMESIG", "DIV", "TEMPO", "MEASURES", "SWING", "TITLE", "AUTHOR", "COMMENTS", "METRONOMEFREQ")
_WHOLE_NOTE = 4 * PPQ
MOST_BEATS, UNITS = 32, (2, 4, 8, 16)
_MOST_DIVISION = 96
"""Finer than any that GrooveScribe offers, twice (our choice)."""
_IGNORED = re.compile(r"[|:!()\[\]\s]")
_LINK = re.compile(r"https?://\S[^\r\n]*|\??[A-Za-z0-9_]{1,20}=\S.*")
_MOST_LINK = 1 << 16
"""Characters: ten bars of 48 cells and nine lines are 5,000 (our choice)."""


@dataclass(frozen=True, slots=True)
class Groove:
    """A groove as its link says it: letters `lines[line][cell]`, `cells_per_bar` of them a bar, "-" where nothing is.

    `swing` is in percent: the first of two cells is so much longer, the second so much shorter. `stickings` has a
    letter a cell too, and is empty where there are none.
    """

    meter: MeterChange = field(default_factory=lambda: MeterChange(0, 4, 4))
    division: int = 16
    bars: int = 1
    tempo: int = DEFAULT_TEMPO
    swing: int = 0
    title: str = ""
    author: str = ""
    comments: str = ""
    lines: Mapping[str, str] = field(default_factory=dict)
    stickings: str = ""
    lost: tuple[str, ...] = ()

    @property
    def cells_per_bar(self) -> int:
        """How many letters a bar of a line has."""
        return self.meter.beats * self.division // self.meter.unit

    @property
    def cell_ticks(self) -> int:
        """Length of a cell."""
        return _WHOLE_NOTE // self.division

    @property
    def swings(self) -> bool:
        """Whether GrooveScribe swings such cells: triplets and quarters it does not."""
        return self.swing > 0 and self.division % 3 != 0 and self.division > 4


def is_groove_url(text: str) -> bool:
    """Whether `text` is a link with a groove in it, or the query of one."""
    if len(text) > _MOST_LINK or not _LINK.fullmatch(text.strip()):
        return False
    fields = _fields(text.strip())
    has_music = not fields.keys().isdisjoint((*LETTERS, "TIMESIG", "DIV"))
    return has_music and len(fields.keys() & {*_SETTINGS, *_LINES}) >= 2


def find_groove_url(text: str) -> str:
    """The first groove's link among the lines of `text` (a Windows shortcut's `URL=…` too), "" where there is none."""
    for line in text[: 4 * _MOST_LINK].splitlines():
        link = re.sub(r"^\s*URL=(?=https?:)", "", line, flags=re.IGNORECASE).strip()
        if is_groove_url(link):
            return link
    return ""


def parse_groove(text: str, source: str) -> Groove:
    """The groove in a link or query; raises `BadInput` of `source` with the key at fault."""
    if not is_groove_url(text):
        raise BadInput(source, "", "expected the link of a groove, such as ?TimeSig=4/4&Div=16&H=x-x-…&S=…&K=…")
    fields, lost = _fields(text.strip()), list[str]()
    meter = _meter(fields.get("TIMESIG", "4/4"), lost)
    division = _division(fields.get("DIV", "16"), meter, source)
    groove = Groove(
        meter=meter,
        division=division,
        bars=_number(fields, "MEASURES", 1, MOST_BARS, 1, lost),
        tempo=_number(fields, "TEMPO", LEAST_TEMPO, MOST_TEMPO, DEFAULT_TEMPO, lost),
        swing=min(_number(fields, "SWING", 0, 100, 0, lost), MOST_SWING),
        title=_words(fields.get("TITLE", "")),
        author=_words(fields.get("AUTHOR", "")),
        comments=_words(fields.get("COMMENTS", "")),
    )
    lines = {name: _line(fields.get(name, ""), groove) or _filled(name, groove) for name in LETTERS}
    stickings = _line(fields.get(STICKINGS, ""), groove)
    return _with_lines(groove, lines, stickings, tuple(lost))


def groove_url(groove: Groove) -> str:
    """The link that opens `groove` in GrooveScribe."""
    said = {
        "TimeSig": f"{groove.meter.beats}/{groove.meter.unit}",
        "Div": str(groove.division),
        **{
            name: quote(words, safe="")
            for name, words in (("Title", groove.title), ("Author", groove.author), ("Comments", groove.comments))
            if words
        },
        "Tempo": str(groove.tempo),
        **({"Swing": str(groove.swing)} if groove.swing else {}),
        "Measures": str(groove.bars),
        **{name: _barred(letters, groove) for name, letters in groove.lines.items()},
        **({"Stickings": _barred(groove.stickings, groove)} if groove.stickings else {}),
    }
    return f"{WEB_PAGE}?" + "&".join(f"{key}={value}" for key, value in said.items())


def _barred(letters: str, groove: Groove) -> str:
    size = groove.cells_per_bar
    return "|" + "".join(f"{letters[i : i + size]}|" for i in range(0, len(letters), size))


# --- keys -------------------------------------------------------------------------------------------------------------


def _fields(link: str) -> dict[str, str]:
    """The values by their keys in capitals, not decoded yet; of two of one key the first counts."""
    _, mark, query = link.partition("?")
    query = (query if mark else link).partition("#")[0].replace("&amp;", "&")
    if "=" not in query and "%3d" in query.lower():  # the whole query encoded once more, as some pages share it
        query = unquote(query, errors="replace")
    pairs = [part.partition("=") for part in query.split("&")]
    fields: dict[str, str] = {}
    for key, _, value in pairs:
        name = unquote(key, errors="replace").strip().upper()
        fields.setdefault(_OTHER_NAMES.get(name, name), value)
    return fields


def _words(value: str) -> str:
    """A title or name, in one line."""
    return one_line(unquote(value.replace("+", " "), errors="replace"))


def _whole(value: str) -> int | None:
    found = re.match(r"\s*([+-]?[0-9]{1,9})", unquote(value, errors="replace"))
    return int(found[1]) if found else None


def _number(fields: Mapping[str, str], key: str, least: int, most: int, default: int, lost: list[str]) -> int:
    """The whole number that `key` says; one out of range is what GrooveScribe makes of it, and told."""
    if key not in fields:
        return default
    number = _whole(fields[key])
    if number is not None and least <= number <= most:
        return number
    used = MOST_BARS if key == "MEASURES" and number is not None and number > most else default
    lost.append(f"{key.capitalize()}={_shown(fields[key])} is not from {least} to {most}; read as {used}")
    return used


def _meter(value: str, lost: list[str]) -> MeterChange:
    found = re.fullmatch(r"\s*([0-9]{1,3})\s*/\s*([0-9]{1,3})\s*", unquote(value, errors="replace"))
    beats, unit = (int(found[1]), int(found[2])) if found else (0, 0)
    if not 1 <= beats <= MOST_BEATS or unit not in UNITS:
        used = (beats if 1 <= beats <= MOST_BEATS else 4, unit if unit in UNITS else 4)
        lost.append(f"TimeSig={_shown(value)} is no meter of GrooveScribe; read as {used[0]}/{used[1]}")
        beats, unit = used
    return MeterChange(0, beats, unit)


def _division(value: str, meter: MeterChange, source: str) -> int:
    division = _whole(value)
    if division is None or not 1 <= division <= _MOST_DIVISION or _WHOLE_NOTE % division:
        known = ", ".join(map(str, DIVISIONS))
        raise BadInput(source, "Div", f"expected how many cells a whole note has ({known}), found {_shown(value)}")
    if meter.beats * division % meter.unit:
        raise BadInput(source, "Div", f"a bar of {meter} is no whole number of cells of 1/{division}")
    return division


def _shown(value: str) -> str:
    return repr(unquote(value, errors="replace")[:30])


# --- lines ------------------------------------------------------------------------------------------------------------


def _line(value: str, groove: Groove) -> str:
    """The letters of a line, one a cell of all bars; "" where the link has no such line."""
    letters = _IGNORED.sub("", unquote(value, errors="replace"))
    size = groove.cells_per_bar * groove.bars
    if not letters:
        return ""
    if len(letters) >= 2 * size:
        letters = letters[:: -(-len(letters) // size)]
    elif 2 * len(letters) <= size:
        letters = "".join(letter + "-" * (-(-size // len(letters)) - 1) for letter in letters)
    return letters[:size].ljust(size, "-")


def _filled(name: str, groove: Groove) -> str:
    """What GrooveScribe shows where a link has no H, S or K: cymbals throughout, kick and snare in turn."""
    beat = Fraction(groove.cells_per_bar, groove.meter.beats)
    odd = {0: "o", 1: "-"} if name == "K" else {0: "-", 1: "O"}
    if name == "H":
        bar = ("-" if groove.cells_per_bar == 48 else "x") * groove.cells_per_bar
    elif name in ("S", "K"):
        bar = "".join("-" if i % beat else odd[i // beat % 2] for i in range(groove.cells_per_bar))
    else:
        return ""
    return bar * groove.bars


def _with_lines(groove: Groove, lines: Mapping[str, str], stickings: str, lost: tuple[str, ...]) -> Groove:
    return Groove(
        *(groove.meter, groove.division, groove.bars, groove.tempo, groove.swing),
        *(groove.title, groove.author, groove.comments),
        lines={name: letters for name, letters in lines.items() if letters},
        stickings=stickings,
        lost=lost,
    )

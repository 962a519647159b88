"""The forty international drum rudiments as they are published: strokes, rhythm, accents, and who says so.

Numbers, names and order are those of the Percussive Arts Society's chart of 1984. `strokes` spells one round that the
right hand leads: capitals are main strokes, small letters the grace strokes before them, `>` follows an accent.
`rhythm` gives each main stroke's time until the next one as a note value: `16` a sixteenth, `8t` an eighth of a
triplet, `8.` a dotted eighth, `6x16` six sixteenths; rests after a stroke count as its time. Rolls that the chart
abbreviates with slashes are written out. The lessons that ship are files of the same names; `docs/rudiments.md` sets
each beside its row.
"""

import re
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from types import MappingProxyType

from station.core.counts import is_count
from station.core.did_you_mean import nearest
from station.core.errors import BadInput

ROLLS, DIDDLES, FLAMS, DRAGS = "rolls", "diddles", "flams", "drags"

LEVEL_ENDINGS = ("", "-medium", "-fast")
"""What a rudiment's three lessons add to its name."""

SOURCES = MappingProxyType(
    {
        "P": "the PAS chart of 1984, from notes proofed against it",
        "B": "Backwerd Rimshot, Rudiment Builder (github.com/backwerdrimshot/Rudiment-Builder), `rudiment-data.js`: "
        "proofed against the chart of 1984 on 25 August 2026 and against the society's engravings of single rudiments "
        "on 3 September 2026",
        "S": "SOUSA (github.com/zakkeown/SOUSA), definitions of the forty rudiments",
        "M": "B. Bachman, Top 10 rudiments, parts 8 and 9, Modern Drummer",
        "H": "Hackney Wick Drum Studio, lessons on the five and seven stroke roll",
        "D": "Free Drum Lessons, Drum Rudiment System and 26 Drum Rudiments, on the six, ten and fifteen stroke roll",
        "Z": "Skillz Drum Lessons, 40 essential rudiments, 11",
    }
)
"""Letter of a source -> what it is."""


@dataclass(frozen=True, slots=True)
class ChartStroke:
    """One main stroke: its hand `R` or `L`, grace strokes before it (0–2), and quarter notes until the next stroke."""

    hand: str
    graces: int
    accented: bool
    quarters: Fraction


@dataclass(frozen=True, slots=True)
class Rudiment:
    """One row of the chart; `sources` are letters of `SOURCES`, `note` what they do not agree on or leave open."""

    number: int
    title: str
    family: str
    strokes: str
    rhythm: str
    sources: str = "PB"
    note: str = ""

    @property
    def name(self) -> str:
        """The name of its first lesson: `flam-tap`."""
        return _name_of(self.title)

    @property
    def lessons(self) -> tuple[str, ...]:
        """The names of its lessons from slow to fast."""
        return tuple(self.name + ending for ending in LEVEL_ENDINGS)

    @property
    def chart(self) -> tuple[ChartStroke, ...]:
        """One round, led by the right hand."""
        written, values = _STROKE.findall(self.strokes), _values(self.rhythm)
        assert len(written) == len(values), self.title
        return tuple(
            ChartStroke(hand, len(graces), accent == ">", quarters)
            for (graces, hand, accent), quarters in zip(written, values, strict=True)
        )


_STROKE = re.compile(r"([rl]{0,2})([RL])(>?)")
_VALUE = re.compile(r"(?:(\d+)x)?(\d+)(t|\.)?")
_LENGTHENED = MappingProxyType({"": Fraction(1), "t": Fraction(2, 3), ".": Fraction(3, 2)})


def _values(rhythm: str) -> list[Fraction]:
    """Note values such as `6x16t 4` in quarter notes, one a stroke."""
    found = [_VALUE.fullmatch(word) for word in rhythm.split()]
    return [value for m in found if m for value in [Fraction(4, int(m[2])) * _LENGTHENED[m[3] or ""]] * int(m[1] or 1)]


_ODD = "A roll of an odd number of doubles begins on the beat and ends off it; as a pickup to the beat it is as common."
_FLAM = "The accent is B's and S's; our notes of the chart had it from memory only."

RUDIMENTS: tuple[Rudiment, ...] = (
    Rudiment(1, "Single Stroke Roll", ROLLS, "R L R L R L R L", "8x32"),
    Rudiment(
        2,
        "Single Stroke Four",
        ROLLS,
        "R L R L",
        "3x16t 8",
        note="P names an eighth-note triplet: the same rhythm, half as fast.",
    ),
    Rudiment(3, "Single Stroke Seven", ROLLS, "R L R L R L R", "6x16t 4"),
    Rudiment(
        4,
        "Multiple Bounce Roll",
        ROLLS,
        "R L R L",
        "4x8",
        note="The chart prints one sustained buzzed note; B and we write the hands' strokes.",
    ),
    Rudiment(5, "Triple Stroke Roll", ROLLS, "RRR LLL", "6x8t"),
    Rudiment(6, "Double Stroke Open Roll", ROLLS, "RR LL", "4x16"),
    Rudiment(7, "Five Stroke Roll", ROLLS, "RR LL R>", "4x16 4", "PBH"),
    Rudiment(
        8,
        "Six Stroke Roll",
        ROLLS,
        "R> LL RR L>",
        "8 4x16 8",
        "PBD",
        "P and D: the accented strokes last as long as a double; B writes six even strokes.",
    ),
    Rudiment(9, "Seven Stroke Roll", ROLLS, "RR LL RR L>", "6x16 8", "PBSH", _ODD),
    Rudiment(10, "Nine Stroke Roll", ROLLS, "RR LL RR LL R>", "8x16 4"),
    Rudiment(
        11,
        "Ten Stroke Roll",
        ROLLS,
        "RR LL RR LL R> L>",
        "8x32 16 8.",
        "PZD",
        "Z and D: the taps are half as fast as the roll; B writes them as fast as the roll, S puts an accent first.",
    ),
    Rudiment(12, "Eleven Stroke Roll", ROLLS, "RR LL RR LL RR L>", "10x16 8", "PB", _ODD),
    Rudiment(13, "Thirteen Stroke Roll", ROLLS, "RR LL RR LL RR LL R>", "12x16 4", "PB"),
    Rudiment(14, "Fifteen Stroke Roll", ROLLS, "RR LL RR LL RR LL RR L>", "14x16 8", "PBD", _ODD),
    Rudiment(15, "Seventeen Stroke Roll", ROLLS, "RR LL RR LL RR LL RR LL R>", "16x16 4", "PB"),
    Rudiment(16, "Single Paradiddle", DIDDLES, "R> L RR", "4x16"),
    Rudiment(17, "Double Paradiddle", DIDDLES, "R> L R L RR", "6x16t"),
    Rudiment(18, "Triple Paradiddle", DIDDLES, "R> L R L R L RR", "8x16"),
    Rudiment(
        19,
        "Paradiddle-diddle",
        DIDDLES,
        "R> L RR LL",
        "6x16t",
        note="P's name is Single Paradiddle-diddle; the short one is as common.",
    ),
    Rudiment(20, "Flam", FLAMS, "lR rL", "2x4"),
    Rudiment(21, "Flam Accent", FLAMS, "lR> L R", "3x8t", "PBS", _FLAM),
    Rudiment(22, "Flam Tap", FLAMS, "lR> R", "2x8", "PBSM", _FLAM),
    Rudiment(
        23,
        "Flamacue",
        FLAMS,
        "lR L> R L lR",
        "4x16 4",
        note="S accents the first and the last stroke.",
    ),
    Rudiment(24, "Flam Paradiddle", FLAMS, "lR> L RR", "4x16", "PBS", _FLAM),
    Rudiment(25, "Single Flammed Mill", FLAMS, "lR> R L R", "4x16"),
    Rudiment(26, "Flam Paradiddle-diddle", FLAMS, "lR> L RR LL", "6x16t", "PBS", _FLAM),
    Rudiment(27, "Pataflafla", FLAMS, "lR> L R rL>", "4x16"),
    Rudiment(28, "Swiss Army Triplet", FLAMS, "lR> R L", "3x8t"),
    Rudiment(29, "Inverted Flam Tap", FLAMS, "lR> L", "2x8", "PBM"),
    Rudiment(30, "Flam Drag", FLAMS, "lR> LL R", "8t 2x16t 8t"),
    Rudiment(31, "Drag", DRAGS, "llR rrL", "2x4"),
    Rudiment(32, "Single Drag Tap", DRAGS, "llR L>", "2x8"),
    Rudiment(33, "Double Drag Tap", DRAGS, "llR llR L>", "3x8t"),
    Rudiment(34, "Lesson 25", DRAGS, "llR L R>", "2x16 8"),
    Rudiment(35, "Single Dragadiddle", DRAGS, "R>R L RR", "2x32 3x16"),
    Rudiment(36, "Drag Paradiddle #1", DRAGS, "R> llR L RR", "8 4x16"),
    Rudiment(37, "Drag Paradiddle #2", DRAGS, "R> llR llR L RR", "8 8 4x16"),
    Rudiment(
        38,
        "Single Ratamacue",
        DRAGS,
        "llR L R L>",
        "3x16t 8",
    ),
    Rudiment(39, "Double Ratamacue", DRAGS, "llR llR L R L>", "8 3x16t 8"),
    Rudiment(40, "Triple Ratamacue", DRAGS, "llR llR llR L R L>", "8 8 3x16t 8"),
)


def _name_of(title: str) -> str:
    """A title as a lesson's name."""
    return title.strip().lower().replace(" ", "-").replace("#", "")


@cache
def _by_name() -> dict[str, Rudiment]:
    return {r.name: r for r in RUDIMENTS}


def find_rudiment(name_or_number: str) -> Rudiment:
    """The rudiment of that name (`flam-tap`) or PAS number; raises `BadInput` with the nearest name."""
    if is_count(name_or_number) and 1 <= int(name_or_number) <= len(RUDIMENTS):
        return RUDIMENTS[int(name_or_number) - 1]
    name = _name_of(name_or_number)
    if name not in _by_name():
        raise BadInput(name_or_number, "", f"no such rudiment{nearest(name, _by_name())}")
    return _by_name()[name]

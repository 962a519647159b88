"""The families by name, and the text of a lesson of one.

The same family, level, seed and bars give the same text, on any machine: numbers come from `random.Random` seeded with
words, whose sequence Python keeps.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from random import Random
from types import MappingProxyType

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.drills.families.coordination import linear, ostinato
from station.drills.families.lesson_page import Page, level_word
from station.drills.families.rhythms import polyrhythms, reading, syncopation
from station.drills.families.stickings import accents, paradiddles, permutations
from station.drills.lesson import LEVELS

DEFAULT_LEVEL, DEFAULT_BARS = 2, 4
MAX_BARS = 32
"""More is a piece and no drill (our choice)."""


@dataclass(frozen=True, slots=True)
class Family:
    """`title` in a few words; `make` a page of a level 1–5 and a number of bars from a source of random numbers."""

    title: str
    make: Callable[[int, Random, int], Page]


FAMILIES: Mapping[str, Family] = MappingProxyType(
    {
        "permutations": Family("Sticking permutations", permutations),
        "paradiddles": Family("Paradiddles turned", paradiddles),
        "accents": Family("Accents that walk", accents),
        "reading": Family("Rhythms to read", reading),
        "syncopation": Family("Syncopation", syncopation),
        "linear": Family("Linear patterns", linear),
        "ostinato": Family("Over an ostinato", ostinato),
        "polyrhythms": Family("Polyrhythm", polyrhythms),
    }
)


def lesson_text(family: str, level: int = DEFAULT_LEVEL, seed: int = 1, bars: int = DEFAULT_BARS) -> str:
    """The text of the lesson of `family` that these numbers make; raises `BadInput` where there is none."""
    if family not in FAMILIES:
        near = did_you_mean(family, FAMILIES) or f"; there are {', '.join(FAMILIES)}"
        raise BadInput(family, "", f"no such family of lessons{near}")
    if level not in LEVELS:
        raise BadInput("level", "", f"expected {min(LEVELS)} to {max(LEVELS)}, found {level}")
    if not 1 <= bars <= MAX_BARS:
        raise BadInput("bars", "", f"expected 1 to {MAX_BARS}, found {bars}")
    one = FAMILIES[family]
    page = one.make(level, Random(f"{family} {level} {seed} {bars}"), bars)
    what = f"{one.title}: {page.title}" if page.title else one.title
    made = f"# Made by `station lesson new {family} --level {level} --seed {seed} --bars {bars}`.\n"
    return made + replace(page, title=f"{what} ({level_word(level)}, no. {seed})").text

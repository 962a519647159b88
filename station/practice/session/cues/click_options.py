"""The click as a user asks for it: one line of words, the same in the settings and on the command line.

    CLICK = WORD, WORD, …        WORD = KEY=VALUE | count

Source of the keys: `station.practice.session.cues.click_pattern.ClickPattern`, whose fields they are.
"""

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from types import MappingProxyType
from typing import TypeVar

from station.core.counts import is_count
from station.core.errors import BadInput
from station.music.swing import MAX_RATIO, MIN_RATIO, Swing
from station.practice.session.cues.click_pattern import (
    MAX_SUBDIVISIONS,
    PLAIN,
    ClickBeats,
    ClickLevels,
    ClickPattern,
    Displacement,
)
from station.practice.session.cues.quiet_bars import EXPECTED as EXPECTED_GAP
from station.practice.session.cues.quiet_bars import gap_of

T = TypeVar("T")

MAX_VELOCITY = 127
MAX_ACCENT = 32
"""The last beat that may be accented (our choice: no meter here is longer)."""
_BEATS: Mapping[str, ClickBeats] = MappingProxyType(
    {"all": ClickBeats.ALL, "2and4": ClickBeats.BACKBEAT, "bar": ClickBeats.BAR}
)
_PLACES: Mapping[str, Displacement] = MappingProxyType(
    {"beat": Displacement.NONE, "e": Displacement.E, "and": Displacement.AND, "a": Displacement.A}
)
CLICK_HELP = (
    "what clicks, such as parts=2,swing=2 or on=2and4,count: on=all|2and4|bar, parts=1…8 clicks a beat, "
    "swing=1…3.5, place=beat|e|and|a, accents=1+3 (0: none), off=2+4, levels=110/90/70, "
    "gap=4/1|random|random:30%, count (a voice counts)"
)


def parse_click(text: str, source: str = "click") -> ClickPattern:
    """The pattern that `text` asks for, `PLAIN` for an empty one; raises `BadInput` that names `source` and word."""
    pattern = PLAIN
    for word in filter(None, (part.strip() for part in text.split(","))):
        key, _, value = (part.strip() for part in word.partition("="))
        if key not in _KEYS:
            raise BadInput(source, word, f"no such word; there are {', '.join(_KEYS)}")
        change = _KEYS[key](pattern, value)
        if change is None:
            raise BadInput(source, word, f"expected {_EXPECTED[key]}")
        pattern = change
    return pattern


def click_text(pattern: ClickPattern) -> str:
    """What `parse_click` reads as `pattern`; only what differs from `PLAIN` is said."""
    levels, plain = pattern.levels, PLAIN
    words = (
        (pattern.beats is not plain.beats, f"on={_word_of(_BEATS, pattern.beats)}"),
        (pattern.subdivisions != plain.subdivisions, f"parts={pattern.subdivisions}"),
        (pattern.swing != plain.swing, f"swing={pattern.swing.ratio:g}"),
        (pattern.displacement is not plain.displacement, f"place={_word_of(_PLACES, pattern.displacement)}"),
        (pattern.accents != plain.accents, f"accents={_beats_text(pattern.accents) or 0}"),
        (bool(pattern.off), f"off={_beats_text(pattern.off)}"),
        (levels != plain.levels, f"levels={levels.accent}/{levels.beat}/{levels.subdivision}"),
        (pattern.gap is not None, f"gap={pattern.gap}"),
        (pattern.counts, "count"),
    )
    return ",".join(word for is_said, word in words if is_said)


def _beats_text(beats: Iterable[int]) -> str:
    return "+".join(str(beat + 1) for beat in beats)


def _word_of(words: Mapping[str, T], meant: T) -> str:
    return next(word for word, value in words.items() if value == meant)


Change = Callable[[ClickPattern, str], ClickPattern | None]
"""The pattern with what a word says; None for a value that cannot be."""


def _on(pattern: ClickPattern, value: str) -> ClickPattern | None:
    return replace(pattern, beats=_BEATS[value]) if value in _BEATS else None


def _parts(pattern: ClickPattern, value: str) -> ClickPattern | None:
    number = _number(value, MAX_SUBDIVISIONS)
    return replace(pattern, subdivisions=number) if number else None


def _swing(pattern: ClickPattern, value: str) -> ClickPattern | None:
    try:
        ratio = float(value)
    except ValueError:
        return None
    return replace(pattern, swing=Swing(ratio)) if MIN_RATIO <= ratio <= MAX_RATIO else None


def _place(pattern: ClickPattern, value: str) -> ClickPattern | None:
    return replace(pattern, displacement=_PLACES[value]) if value in _PLACES else None


def _accents(pattern: ClickPattern, value: str) -> ClickPattern | None:
    beats = [_number(part, MAX_ACCENT) for part in value.split("+")]
    if beats == [0]:
        return replace(pattern, accents=())
    return replace(pattern, accents=tuple(beat - 1 for beat in beats if beat)) if all(beats) else None


def _off(pattern: ClickPattern, value: str) -> ClickPattern | None:
    beats = [_number(part, MAX_ACCENT) for part in value.split("+")]
    return replace(pattern, off=tuple(beat - 1 for beat in beats if beat)) if all(beats) else None


def _levels(pattern: ClickPattern, value: str) -> ClickPattern | None:
    levels = [_number(part, MAX_VELOCITY) for part in value.split("/")]
    if len(levels) != 3:
        return None
    accent, beat, subdivision = levels
    if accent is None or beat is None or subdivision is None:
        return None
    return replace(pattern, levels=ClickLevels(accent, beat, subdivision))


def _gap(pattern: ClickPattern, value: str) -> ClickPattern | None:
    with suppress(BadInput):
        return replace(pattern, gap=gap_of(value))
    return None


def _count(pattern: ClickPattern, value: str) -> ClickPattern | None:
    return replace(pattern, counts=True) if not value else None


def _number(text: str, most: int) -> int | None:
    """A whole number from 0 to `most`, None for anything else."""
    return int(text) if text.isascii() and is_count(text) and int(text) <= most else None


_KEYS: Mapping[str, Change] = MappingProxyType(
    {
        "on": _on,
        "parts": _parts,
        "swing": _swing,
        "place": _place,
        "accents": _accents,
        "off": _off,
        "levels": _levels,
        "gap": _gap,
        "count": _count,
    }
)
_EXPECTED: Mapping[str, str] = MappingProxyType(
    {
        "on": f"one of {', '.join(_BEATS)}",
        "parts": f"1 to {MAX_SUBDIVISIONS}",
        "swing": f"{MIN_RATIO:g} to {MAX_RATIO:g}",
        "place": f"one of {', '.join(_PLACES)}",
        "accents": f"beats from 1 to {MAX_ACCENT} such as 1+3, or 0 for none",
        "off": f"beats from 1 to {MAX_ACCENT} such as 2+4",
        "levels": f"accent/beat/subdivision, each 0 to {MAX_VELOCITY}",
        "gap": EXPECTED_GAP,
        "count": "count alone",
    }
)

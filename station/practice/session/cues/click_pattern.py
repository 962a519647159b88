"""The click as a pattern over beats: what sounds where, as cues over a tempo map.

Pure. A pattern knows bars, beats and their parts; the tempo map says when they are. A beat is one of the meter's unit
(in 6/8 an eighth). Where beats stand in groups (6/8, 7/8 as 3+2+2) each group's first has a middle accent; where the
backbeat or one click a bar is asked for, beats are the pulses that a drummer feels. It stands here, above both the
music and the engine's cues, for the sound itself knows no bars.

A counted word sounds `SPOKEN_LEAD_NS` before its beat, so that its vowel falls on the beat.
"""

from dataclasses import dataclass, field, replace
from enum import Enum, IntEnum
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.engine.messages import CUE_DTYPE, Bus, ClickVoice
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoMap
from station.practice.session.cues.quiet_bars import QuietBars
from station.sound.buses import PART_LABELS, SPOKEN_LEAD_S, word_of_beat

MAX_SUBDIVISIONS = 8
SPOKEN_LEAD_NS = round(SPOKEN_LEAD_S * NS_PER_S)
_SPOKEN = range(ClickVoice.ONE, max(ClickVoice) + 1)


class ClickBeats(Enum):
    """Which beats of a bar click."""

    ALL = "all"
    BACKBEAT = "2 and 4"
    BAR = "one a bar"


class Displacement(IntEnum):
    """How many quarters of a beat after the beat the click falls: on it, on "e", on "and", on "a"."""

    NONE = 0
    E = 1
    AND = 2
    A = 3


@dataclass(frozen=True, slots=True)
class ClickLevels:
    """Velocities 0 (no cue at all) … 127 of the clicks by their weight."""

    accent: int = 110
    beat: int = 90
    subdivision: int = 70


@dataclass(frozen=True, slots=True)
class ClickPattern:
    """What clicks in a bar.

    `subdivisions` clicks a beat, 1 … `MAX_SUBDIVISIONS`, their offbeats moved by `swing`; `accents` beats of the bar
    from 0; a `displacement` moves the beats' clicks and leaves the subdivisions out; `counts` speaks instead.
    The clicks of the beats `off` (from 0) are left out, what stands between beats is not.
    """

    beats: ClickBeats = ClickBeats.ALL
    subdivisions: int = 1
    accents: tuple[int, ...] = (0,)
    swing: Swing = field(default_factory=Swing)
    displacement: Displacement = Displacement.NONE
    gap: QuietBars | None = None
    counts: bool = False
    levels: ClickLevels = ClickLevels()
    off: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        assert 1 <= self.subdivisions <= MAX_SUBDIVISIONS, "so many clicks make a beat"


PLAIN = ClickPattern()
"""Every beat, the bar's first accented."""
SILENT = ClickPattern(levels=ClickLevels(0, 0, 0))
"""No click, where something else keeps the time."""


class _Click(NamedTuple):
    """A click in a bar: its tick from the bar's start, its voice and velocity."""

    tick: int
    voice: ClickVoice
    velocity: int


def click_cues(tempo_map: TempoMap, end_tick: int, pattern: ClickPattern = PLAIN) -> NDArray[np.void]:
    """The clicks of `pattern` over [0, `end_tick`), cues (n,) of `CUE_DTYPE` in order of time."""
    ticks: list[int] = []
    clicks: list[_Click] = []
    bar = 0
    while (start := tempo_map.bar_start(bar)) < end_tick:
        if pattern.gap is None or not pattern.gap.is_quiet(bar):
            until = min(tempo_map.bar_start(bar + 1), end_tick) - start
            inside = [click for click in bar_clicks(tempo_map.meter_at(start), pattern) if click.tick < until]
            ticks += [start + click.tick for click in inside]
            clicks += inside
        bar += 1
    cues = np.zeros(len(clicks), CUE_DTYPE)
    cues["at_ns"] = tempo_map.ns_at(np.array(ticks, np.int64))
    cues["bus"] = Bus.CLICK
    cues["piece"] = [click.voice for click in clicks]
    cues["velocity"] = [click.velocity for click in clicks]
    cues["openness"] = np.nan
    cues["at_ns"] -= leads_ns(cues)
    return cues[np.argsort(cues["at_ns"], kind="stable")]


def leads_ns(cues: NDArray[np.void]) -> NDArray[np.int64]:
    """How long before its beat each cue sounds, shape (n,)."""
    spoken = (cues["bus"] == Bus.CLICK) & np.isin(cues["piece"], _SPOKEN)
    return np.where(spoken, SPOKEN_LEAD_NS, 0)


def silences(tempo_map: TempoMap, end_tick: int, gap: QuietBars | None) -> tuple[tuple[int, int], ...]:
    """From when until when in ns the click of `gap` is silent over [0, `end_tick`) and comes back, in order."""
    found: list[tuple[int, int]] = []
    first = bar = 0
    while gap is not None and (start := tempo_map.bar_start(bar)) < end_tick:
        if not gap.is_quiet(bar):
            if first < bar:
                found.append((int(tempo_map.ns_at(tempo_map.bar_start(first))), int(tempo_map.ns_at(start))))
            first = bar + 1
        bar += 1
    return tuple(found)


@lru_cache(maxsize=64)
def bar_clicks(meter: MeterChange, pattern: ClickPattern) -> tuple[_Click, ...]:
    """The clicks of one whole bar of `meter`; silent ones are left out."""
    clicks = [
        click
        for index, beat in enumerate(_click_beats(meter, pattern.beats))
        if _sounds(index, pattern.beats)
        for click in _beat_clicks(index, beat, pattern)[index in pattern.off :]
    ]
    moved = (click._replace(tick=pattern.swing.swung(click.tick, meter)) for click in clicks)
    return tuple(click for click in moved if click.velocity > 0)


class _Beat(NamedTuple):
    """A beat that may click: its tick from the bar's start, its length, and whether a group of beats begins there."""

    tick: int
    ticks: int
    begins_group: bool


def _click_beats(meter: MeterChange, beats: ClickBeats) -> list[_Beat]:
    """The beats of a bar of `meter`: all of them, or its pulses where only some of those click."""
    if beats is not ClickBeats.ALL:
        return [_Beat(start, end - start, begins_group=False) for start, end in meter.pulses]
    starts = meter.group_starts if max(meter.felt_groups) > 1 else ()
    return [_Beat(i * meter.beat_ticks, meter.beat_ticks, i in starts) for i in range(meter.beats)]


def _sounds(index: int, beats: ClickBeats) -> bool:
    if beats is ClickBeats.BAR:
        return index == 0
    return beats is ClickBeats.ALL or index % 2 == 1


def _beat_clicks(index: int, beat: _Beat, pattern: ClickPattern) -> list[_Click]:
    """The clicks of `beat`, the bar's `index`-th, straight."""
    tick, pulse = beat.tick, beat.ticks
    if pattern.displacement is not Displacement.NONE:
        voice = PART_LABELS[4][pattern.displacement - 1] if pattern.counts else ClickVoice.BEAT
        return [_Click(tick + pattern.displacement * pulse // 4, voice, pattern.levels.beat)]
    plain, velocity = _weight(index, beat, pattern)
    voice = word_of_beat(index, plain) if pattern.counts else plain
    first = _Click(tick, voice, velocity)
    words = PART_LABELS.get(pattern.subdivisions, ()) if pattern.counts else ()
    others = words or (ClickVoice.SUBDIVISION,) * (pattern.subdivisions - 1)
    return [
        first,
        *(
            _Click(tick + (part + 1) * pulse // pattern.subdivisions, voice, pattern.levels.subdivision)
            for part, voice in enumerate(others)
        ),
    ]


def _weight(index: int, beat: _Beat, pattern: ClickPattern) -> tuple[ClickVoice, int]:
    """The voice and the velocity of a beat: an accent, a middle accent where a group begins, or neither."""
    levels = pattern.levels
    if index in pattern.accents:
        return ClickVoice.ACCENT, levels.accent
    if pattern.accents and beat.begins_group:  # who asks for no accents gets none
        return ClickVoice.ACCENT, (levels.accent + levels.beat) // 2
    return ClickVoice.BEAT, levels.beat


def counting(pattern: ClickPattern) -> ClickPattern:
    """How the count-in of a session with `pattern` goes: every beat, by the same voice and at the same levels."""
    return ClickPattern(accents=pattern.accents, counts=pattern.counts, levels=pattern.levels)


def count_in(section: TempoMap, bars: int, pickup_ticks: int = 0) -> tuple[TempoMap, int]:
    """The tempo map and the length in ticks of `bars` empty bars before `section`.

    Where the section begins with a pickup of `pickup_ticks`, the last bar ends where the pickup starts: the count goes
    "one two three four, one two three" and the pickup falls on four.
    """
    meter = section.meter_at(pickup_ticks)
    before = TempoMap.build([section.tempos[0]], [replace(meter, tick=0)])
    return before, bars * meter.bar_ticks - pickup_ticks

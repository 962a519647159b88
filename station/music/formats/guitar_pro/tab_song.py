"""A Guitar Pro song's drum track as it is written: bars, beats and notes, before repeats and strokes.

Conventions: places and lengths are ticks of the station (`PPQ` a quarter note) from the bar's start; a bar's own tempo
stands first in its `tempos`. Numbers of notes are Guitar Pro's percussion numbers (`tab_kit`).
"""

from dataclasses import dataclass, field

from station.core.pieces import Dynamic
from station.music.formats.playing_order import BarSigns
from station.music.swing import Swing
from station.music.tempo import MeterChange

MOST_TAB_BEATS, MOST_TAB_NOTES = 50_000, 60_000
"""Beats and notes of all tracks together, about 20 µs each to read (our choice: 400 bars of ten tracks)."""
MOST_TAB_STROKES = 40_000
"""Strokes as they are played (our choice: an hour of 11 a second)."""
MOST_METER_BEATS = 64
SLOWEST_TAB_BPM, FASTEST_TAB_BPM = 1.0, 2000.0
"""What a file may say (our choice: Guitar Pro offers 30 to 600)."""


@dataclass(frozen=True, slots=True)
class TabNote:
    """One note: a stroke, or what goes on from one (`is_tied`).

    `graces` are the numbers of its grace notes, the first first; `tremolo_ticks` is how long each stroke of a roll
    takes, 0 where there is none; `velocity` is before any mark.
    """

    number: int
    velocity: int
    dynamic: Dynamic = Dynamic.NORMAL
    graces: tuple[int, ...] = ()
    tremolo_ticks: int = 0
    is_tied: bool = False


@dataclass(frozen=True, slots=True)
class TabBeat:
    """Notes that begin together at `tick` of the bar and last `length_ticks`; rests have no beat."""

    tick: int
    length_ticks: int
    notes: tuple[TabNote, ...]
    is_tuplet: bool = False


@dataclass(frozen=True, slots=True)
class TabBar:
    """A written bar; `meter.tick` says nothing here.

    `tempos` are (tick, µs a quarter) of the bar, the first at 0; `section` the marker that stands at it. Of `signs` the
    `endings` are those that begin here: `playing_order` wants them on every bar that they are over.
    """

    meter: MeterChange
    beats: tuple[TabBeat, ...] = ()
    tempos: tuple[tuple[int, int], ...] = ()
    signs: BarSigns = field(default_factory=BarSigns)
    feel: Swing = field(default_factory=Swing)
    section: str = ""


@dataclass(frozen=True, slots=True)
class TabSong:
    """The drum track of a song and what stands beside it; `lost` as a `DrumPart` has it."""

    title: str
    author: str
    about: str
    bars: tuple[TabBar, ...]
    lost: tuple[str, ...] = ()

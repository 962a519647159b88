"""What a bar of a MusicXML part holds once it is read: times in ticks from the bar's start, as exact fractions."""

import re
from collections import Counter
from dataclasses import dataclass, field
from fractions import Fraction

from station.core.note_map import NoteMeaning
from station.core.pieces import Dynamic, Limb
from station.core.units import PPQ
from station.music.formats.playing_order import BarSigns
from station.music.swing import Swing
from station.music.tempo import MeterChange

NUMBER = re.compile(r"\s*([+-]?\d{1,9}(?:\.\d{1,12})?)\s*")
"""A decimal number as the file writes it, no longer than any that music needs (our choice)."""
STOP = "stop"
"""Among loudness signs: here a hairpin ends."""
_FINEST_METER = 64
"""A bar of another length than its meter's gets a meter in these units at the finest (our choice)."""


@dataclass(slots=True)
class WrittenNote:
    """A note as it is written; `length` to where its written value ends.

    `velocity` is None where nothing says it but the marks; `is_tied` it goes on from a note before; `stroke_ticks`
    how far apart the strokes of a measured tremolo are, 0 for none.
    """

    start: Fraction
    length: Fraction
    strike: NoteMeaning
    voice: str = ""
    midi_note: int = 0
    velocity: int | None = None
    usual_velocity: int = 80
    dynamic: Dynamic = Dynamic.NORMAL
    limb: Limb = Limb.UNKNOWN
    is_tied: bool = False
    in_tuplet: bool = False
    stroke_ticks: Fraction = Fraction(0)
    is_buzz: bool = False
    is_choked: bool = False
    graces: list["WrittenNote"] = field(default_factory=list)


@dataclass(slots=True)
class WrittenBar:
    """One bar; `name` is its number in the file.

    `length` is 0 where nothing stands in it. `tempos` (where, µs a quarter), `loudness` (where, a sign or `STOP`) and
    `swings` (where, the swing from there on) are in the order of the file. `meter` at tick 0, None where none is
    written; `beat_ticks` the beat of its metronome mark, 0 for none; `section` the name of its rehearsal mark;
    `letters` (where, whose) R and L as words over the staff.
    """

    name: str
    length: Fraction = Fraction(0)
    notes: list[WrittenNote] = field(default_factory=list)
    tempos: list[tuple[Fraction, int]] = field(default_factory=list)
    loudness: list[tuple[Fraction, str]] = field(default_factory=list)
    swings: list[tuple[Fraction, Swing]] = field(default_factory=list)
    meter: MeterChange | None = None
    beat_ticks: int = 0
    section: str = ""
    letters: list[tuple[Fraction, Limb]] = field(default_factory=list)
    ends_section: bool = False
    signs: BarSigns = field(default_factory=BarSigns)


class LostMarks:
    """Counts what is not read, to be said in a line each."""

    def __init__(self) -> None:
        self._counts: Counter[str] = Counter()
        self._first: dict[str, str] = {}

    def add(self, what: str, bar: str) -> None:
        """One more of `what`, a plural such as "staccato marks", in the bar of this name."""
        self._counts[what] += 1
        self._first.setdefault(what, bar)

    def lines(self) -> tuple[str, ...]:
        """What is lost, in the order in which it was met."""
        return tuple(f"{what}: {self._counts[what]}, the first in bar {bar}" for what, bar in self._first.items())


def short_meter(length: int, usual: MeterChange) -> MeterChange:
    """A meter whose bar is `length` ticks long, in the usual unit if that can be; else the usual, cut short."""
    unit = usual.unit
    while unit <= _FINEST_METER:
        beats, rest = divmod(length, 4 * PPQ // unit)
        if beats and not rest:
            return MeterChange(0, beats, unit)
        unit *= 2
    return usual

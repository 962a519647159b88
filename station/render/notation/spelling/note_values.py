"""The written values of one voice of a bar: notes, rests, tuplets, and the groups that beams hold together.

Ticks count from the bar's start. A value's time is its own length times the ratio of the tuplet that it stands in.
"""

from dataclasses import dataclass
from fractions import Fraction

from station.core.units import PPQ


@dataclass(frozen=True, slots=True)
class Value:
    """A note value: 1/`base` note with `dots`."""

    base: int
    dots: int = 0

    @property
    def beams(self) -> int:
        """How many beams or flags it has."""
        return max(self.base.bit_length() - 3, 0)

    @property
    def ticks(self) -> Fraction:
        """Its length outside any tuplet."""
        return Fraction(4 * PPQ, self.base) * (2 - Fraction(1, 2**self.dots))


@dataclass(frozen=True, slots=True)
class Stroke:
    """What one voice strikes at `tick`, 0 or later.

    `until` is where a roll ends (None for a stroke, which lasts as long as reads best). `is_held`: struck in a bar
    before, it sounds on. `is_measured`: a diddle or an open roll, written as one note with a slash on its stem.
    """

    tick: int
    until: int | None = None
    is_accented: bool = False
    is_held: bool = False
    is_measured: bool = False


@dataclass(frozen=True, slots=True)
class TimedValue:
    """A stroke or a rest of `value` at `tick`; strokes keep the tick that they were given.

    `is_tied`: no stroke, but how the one before it goes on. `slashes`: how many cross its stem, beside its own beams
    or flags. `source` is the index of the stroke that it writes, −1 for a rest.
    """

    tick: int
    value: Value
    is_tied: bool = False
    slashes: int = 0
    source: int = -1


@dataclass(frozen=True, slots=True)
class Tuplet:
    """From `start` to `end`, `number` notes stand in the time of `of` notes of the same kind."""

    number: int
    of: int
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class BeatGroup:
    """What stands under one beam at most, from `start` to `end`: a beat, or several that one value or tuplet spans."""

    start: int
    end: int
    strokes: tuple[TimedValue, ...]
    rests: tuple[TimedValue, ...]
    tuplets: tuple[Tuplet, ...] = ()

    @property
    def values(self) -> tuple[TimedValue, ...]:
        """Strokes and rests in their order."""
        return tuple(sorted((*self.strokes, *self.rests), key=lambda value: value.tick))

    def time_of(self, value: TimedValue) -> Fraction:
        """How many ticks one of its values takes, tuplets and all."""
        ticks = value.value.ticks
        for tuplet in self.tuplets:
            if tuplet.start <= value.tick < tuplet.end:
                ticks *= Fraction(tuplet.of, tuplet.number)
        return ticks

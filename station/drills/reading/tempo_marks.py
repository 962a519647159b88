"""Tempo that changes within a grid: accelerando, ritardando, and a new tempo at a bar.

A change is heard as steps, one at every quarter of the beat that the tempo counts: each step is the tempo at its start
on a line that is even in score time. Ticks are those of the music as it is played; tempi are quarter notes a minute.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from station.music.tempo import TempoChange

STEPS_A_BEAT = 4
"""At 60 bpm a step lasts a quarter of a second, and a player follows no finer (our choice)."""


@dataclass(frozen=True, slots=True)
class Ramp:
    """A tempo that is `from_bpm` at tick `start` and would be `to_bpm` at tick `end`; the same where both agree."""

    start: int
    end: int
    from_bpm: float
    to_bpm: float

    def bpm_at(self, tick: int) -> float:
        """Quarter notes a minute at `tick`, which lies in the ramp."""
        if tick == self.start or self.from_bpm == self.to_bpm:
            return self.from_bpm
        return self.from_bpm + (self.to_bpm - self.from_bpm) * (tick - self.start) / (self.end - self.start)

    def steps(self, start: int, end: int, beat_ticks: int) -> Iterator[TempoChange]:
        """The tempo over [start, end), a part of the ramp: at its start, then at every quarter of a beat."""
        if start >= end:
            return
        yield TempoChange.from_bpm(start, self.bpm_at(start))
        if self.from_bpm != self.to_bpm:
            step = beat_ticks // STEPS_A_BEAT
            first = start + step - (start - self.start) % step
            yield from (TempoChange.from_bpm(tick, self.bpm_at(tick)) for tick in range(first, end, step))


@dataclass(frozen=True, slots=True)
class TempoMark:
    """What is written at `tick`: a tempo from there on, one that is reached in the end, or both."""

    tick: int
    tempo_bpm: float | None = None
    tempo_to_bpm: float | None = None


def marked_tempos(
    ramp: Ramp, marks: Sequence[TempoMark], start: int, end: int, beat_ticks: int
) -> Iterator[TempoChange]:
    """The tempo over [start, end), a part of `ramp`; `marks`, in order, take its place, each up to the next."""
    since = start
    for i, mark in enumerate(marks):
        yield from ramp.steps(since, mark.tick, beat_ticks)
        bpm = ramp.bpm_at(mark.tick) if mark.tempo_bpm is None else mark.tempo_bpm
        until = marks[i + 1].tick if marks[i + 1 :] else end
        ramp = Ramp(mark.tick, until, bpm, bpm if mark.tempo_to_bpm is None else mark.tempo_to_bpm)
        since = mark.tick
    yield from ramp.steps(since, end, beat_ticks)

"""Tempo changes as people write them: a new tempo, or accelerando and ritardando where many small steps go one way."""

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from station.core.units import PPQ
from station.music.tempo import TempoChange, TempoMap

_FEWEST_STEPS = 3
"""So many steps one way are a ramp; our choice: two may be two tempi."""
_MOST_GAP = PPQ
"""Steps of a ramp are no farther apart than a quarter note (our choice; lessons step four times a beat)."""
_EVEN = 1.6
"""A step so many times as large as the one before is none of the ramp's (our choice: even ramps differ by rounding)."""

_WAVERING = 0.05
"""A tempo that holds, or a ramp that lasts, for less than a bar and is so near to what was written before is no new one
(our choice: twice the 2.5 % that listeners notice, Friberg & Sundberg 1995)."""


@dataclass(frozen=True, slots=True)
class TempoWord:
    """From `tick` on: `tempo_bpm` quarter notes a minute at once, or evenly by the tick `until`, `way` 1 faster, −1."""

    tick: int
    tempo_bpm: float
    until: int | None = None
    way: int = 0


def tempo_words(tempo_map: TempoMap) -> list[TempoWord]:
    """What is to be written of the changes after tick 0, in order."""
    return [word for run in _runs(tempo_map.tempos) for word in _words(run, tempo_map)]


def read_tempo_words(tempo_map: TempoMap) -> list[TempoWord]:
    """Those that somebody reads who plays from a staff: how a played tempo wavers is left out."""
    if tempo_map.is_played:
        return []
    changes = [change.tick for change in tempo_map.tempos]
    found, holds = list[TempoWord](), tempo_map.tempos[0].tempo_bpm
    for word in tempo_words(tempo_map):
        after = bisect_right(changes, word.tick)
        until = word.until or (changes[after] if after < len(changes) else None)
        is_short = until is not None and until - word.tick < tempo_map.meter_at(word.tick).bar_ticks
        if not is_short or abs(word.tempo_bpm / holds - 1) >= _WAVERING:
            found.append(word)
            holds = word.tempo_bpm
    return found


def _runs(changes: Sequence[TempoChange]) -> Iterator[list[TempoChange]]:
    """The changes in runs that go one way in even steps; each begins with the tempo before it."""
    run = [changes[0]]
    for before, after in pairwise(changes):
        if len(run) > 1 and not _goes_on(run, after):
            yield run
            run = [before]
        run.append(after)
    if len(run) > 1:
        yield run


def _goes_on(run: Sequence[TempoChange], after: TempoChange) -> bool:
    step, last = run[-1].tempo_bpm - run[-2].tempo_bpm, after.tempo_bpm - run[-1].tempo_bpm
    return step * last > 0 and abs(last) <= _EVEN * abs(step) and after.tick - run[-1].tick <= _MOST_GAP


def _words(run: Sequence[TempoChange], tempo_map: TempoMap) -> Iterator[TempoWord]:
    if len(run) <= _FEWEST_STEPS:
        yield from (TempoWord(change.tick, change.tempo_bpm) for change in run[1:])
        return
    last, gap = run[-1], run[-1].tick - run[-2].tick
    has_arrived = tempo_map.position_at(last.tick).beat == tempo_map.position_at(last.tick).tick == 0
    target = (
        last.tempo_bpm if has_arrived else 2 * last.tempo_bpm - run[-2].tempo_bpm
    )  # one that ends the music stops a step short
    until = last.tick if has_arrived else last.tick + gap
    yield TempoWord(run[1].tick - gap, target, until, 1 if target > run[0].tempo_bpm else -1)

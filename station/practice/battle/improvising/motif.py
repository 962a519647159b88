"""A bar that was heard, taken up: as it was, or displaced, on other drums, augmented, thinned.

These are the ways in which teachers have trading students answer (imitate, then change one thing); what is taken up is
the bar that says most: many strokes, few of them in the bars beside it.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from enum import Enum
from types import MappingProxyType

import numpy as np
from numpy.random import Generator

from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.strokes_on_grid import GRID, GridStroke, beats_with, grid_strokes

_TIME = frozenset({Instrument.CLOSED_HIHAT, Instrument.OPEN_HIHAT, Instrument.RIDE})


class Turning(Enum):
    """How a motif is taken up."""

    LITERAL = "as it was"
    DISPLACED = "displaced"
    ORCHESTRATED = "on other drums"
    AUGMENTED = "augmented"
    THINNED = "thinned"


def motif_of(heard: Beats, rng: Generator) -> Beats | None:
    """The bar of `heard` that says most, chance deciding among the best two; None where nothing was played."""
    bars = [heard.of_bars(bar, bar + 1) for bar in range(heard.bars)]
    played = [bar for bar in bars if bar.struck.any()]
    if not played:
        return None
    talk = [_said(bar, played) for bar in played]
    best = np.argsort(talk)[::-1][:2]
    return played[int(best[int(rng.integers(len(best)))])]


def _said(bar: Beats, bars: Sequence[Beats]) -> float:
    """Strokes that are no timekeeping, the more the fewer other bars have them at the same place."""
    others = [one for one in bars if one is not bar]
    mine = _spots(bar)
    shared = np.mean([len(mine & _spots(one)) for one in others]) if others else 0.0
    return len(mine) - float(shared)


def _spots(bar: Beats) -> set[tuple[int, int]]:
    return {(s.at, int(s.instrument)) for s in grid_strokes(bar) if s.instrument not in _TIME}


def turned(motif: Beats, turning: Turning, rng: Generator) -> Beats:
    """A bar that takes up `motif`, a bar, in that way."""
    strokes = _TURNINGS[turning](grid_strokes(motif), len(motif) * GRID, rng)
    usual = int(np.bincount(motif.division).argmax())
    return beats_with(strokes, len(motif), motif.beats_a_bar, usual)


def _literal(strokes: list[GridStroke], length: int, rng: Generator) -> list[GridStroke]:
    return strokes


def _displaced(strokes: list[GridStroke], length: int, rng: Generator) -> list[GridStroke]:
    """Half a beat or a beat later, what falls off the end coming first; timekeeping stays."""
    by = int(rng.choice((GRID // 2, GRID)))
    if any(stroke.at % (GRID // 2) and stroke.at % (GRID // 3) == 0 for stroke in strokes):
        by = GRID  # triplets have no half
    return [s if s.instrument in _TIME else replace(s, at=(s.at + by) % length) for s in strokes]


_OTHER_DRUMS: tuple[Mapping[Instrument, Instrument], ...] = (
    {Instrument.SNARE: Instrument.HIGH_TOM, Instrument.HIGH_TOM: Instrument.FLOOR_TOM},
    {
        Instrument.SNARE: Instrument.FLOOR_TOM,
        Instrument.HIGH_TOM: Instrument.SNARE,
        Instrument.MID_TOM: Instrument.SNARE,
    },
    {
        Instrument.CLOSED_HIHAT: Instrument.RIDE,
        Instrument.OPEN_HIHAT: Instrument.CRASH,
        Instrument.RIDE: Instrument.CLOSED_HIHAT,
    },
    {Instrument.CLOSED_HIHAT: Instrument.FLOOR_TOM, Instrument.RIDE: Instrument.FLOOR_TOM},
)
"""What goes where: hands to the toms, back from them, time to the other cymbal, time to the floor tom."""


def _orchestrated(strokes: list[GridStroke], length: int, rng: Generator) -> list[GridStroke]:
    used = {stroke.instrument for stroke in strokes}
    fitting = [drums for drums in _OTHER_DRUMS if used & set(drums)]
    if not fitting:
        return strokes
    drums = fitting[int(rng.integers(len(fitting)))]
    return [replace(s, instrument=drums.get(s.instrument, s.instrument)) for s in strokes]


def _augmented(strokes: list[GridStroke], length: int, rng: Generator) -> list[GridStroke]:
    """The first half of the bar over the whole of it; timekeeping goes on as it was."""
    time = [s for s in strokes if s.instrument in _TIME]
    return time + [replace(s, at=2 * s.at) for s in strokes if s.instrument not in _TIME and 2 * s.at < length]


_KEPT: Mapping[bool, float] = MappingProxyType({True: 0.9, False: 0.35})
"""How many strokes a thinned motif keeps, by whether they stand on a beat (our choice)."""


def _thinned(strokes: list[GridStroke], length: int, rng: Generator) -> list[GridStroke]:
    return [s for s in strokes if rng.random() < _KEPT[s.at % GRID == 0]]


_Way = Callable[[list[GridStroke], int, Generator], list[GridStroke]]
_TURNINGS: Mapping[Turning, _Way] = MappingProxyType(
    {
        Turning.LITERAL: _literal,
        Turning.DISPLACED: _displaced,
        Turning.ORCHESTRATED: _orchestrated,
        Turning.AUGMENTED: _augmented,
        Turning.THINNED: _thinned,
    }
)

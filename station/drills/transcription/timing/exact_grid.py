"""Scores that lie on a grid already, as editors write them: their own cells, and the swing in which those are simple.

Nothing is guessed here: a stroke is on a cell or it is not. A swing is one whose ratio the offbeats themselves have,
and which explains the strokes with words that cost less than straight ones (`rhythm_words`).
"""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.drills.grid.grid_writer import PLAIN_CELLS, TUPLET_CELLS
from station.drills.transcription.timing.beat_spans import BeatSpans, Floats, Ints
from station.drills.transcription.timing.divisions import cell_places
from station.drills.transcription.timing.meant import Meant
from station.drills.transcription.timing.take_feel import Feel, Take, prior_cost
from station.music.swing import MAX_RATIO, STRAIGHT, TRIPLETS, Swing

TOLERANCE_TICKS = PPQ // 960
"""Half a tick of a file that counts 480 a quarter, as most programs write; a septuplet falls between its ticks."""
_CELLS = (*PLAIN_CELLS, *(n for n in TUPLET_CELLS if n not in PLAIN_CELLS))
"""Cells that the lesson's grid can write, the simplest first."""
_SURE_S = 0.001
"""A spread at which one tick beside a cell is no cell."""
_MIN_SWUNG = 3
"""So many offbeats must agree on a ratio (our choice)."""
_UNITS = (PPQ // 2, PPQ // 4)


def exact_meant(take: Take, ticks: Ints) -> Meant | None:
    """What strokes at `ticks` (shape (n,), those of the take) are meant as, if a grid holds them all; else None."""
    spans = take.spans
    span = np.searchsorted(spans.starts, ticks, side="right") - 1
    within = ticks - spans.starts[span]
    straight = _cells(spans, span, within, Swing())
    if straight is None:
        return None
    rivals = [(Swing(), straight)]
    for swing in _swings_heard(spans, span, within):
        cells = _cells(spans, span, within, swing)
        if cells is not None:
            rivals.append((swing, cells))
    swing, cells = min(rivals, key=lambda rival: _cost(take, rival[0]))
    cell = np.zeros(len(span), np.int64)
    for i, (s, at) in enumerate(zip(span.tolist(), within.tolist(), strict=True)):
        cell[i] = np.argmin(np.abs(_places(int(cells[s]), int(spans.lengths[s]), swing) - at))
    return Meant(span, cell, cells, swing)


def _cost(take: Take, swing: Swing) -> float:
    feel = Feel(0.0, _SURE_S, swing)
    return take.read(feel).cost + prior_cost(feel)


def _places(cells: int, length: int, swing: Swing) -> Floats:
    places: Floats = cell_places(cells, length, swing) * length
    return places


def _cells(spans: BeatSpans, span: Ints, within: Ints, swing: Swing) -> Ints | None:
    """Into how many cells each span (s,) must be cut for its strokes, 1 where none is; None if a span cannot be cut."""
    found = np.ones(len(spans), np.int64)
    for s, group in _by_span(span):
        length = int(spans.lengths[s])
        fits = (n for n in _CELLS if _holds(_places(n, length, swing), within[group]))
        if (cells := next(fits, None)) is None:
            return None
        found[s] = cells
    return found


def _by_span(span: Ints) -> Iterator[tuple[int, NDArray[np.int64]]]:
    """Each span that has strokes, and their indices."""
    order = np.argsort(span, kind="stable")
    known, starts, counts = np.unique(span[order], return_index=True, return_counts=True)
    yield from ((s, order[a : a + n]) for s, a, n in zip(known.tolist(), starts, counts, strict=True))


def _holds(places: Floats, within: Ints) -> bool:
    return bool(np.all(np.min(np.abs(places[:, None] - within), axis=0) <= TOLERANCE_TICKS))


def _swings_heard(spans: BeatSpans, span: Ints, within: Ints) -> Sequence[Swing]:
    """The swings whose ratio several offbeats have, in quarters."""
    quarters = within[(spans.lengths[span] == PPQ) & ~spans.is_ternary[span]]
    found: list[Swing] = []
    for unit in _UNITS:
        inside = quarters % (2 * unit)
        places, counts = np.unique(inside[inside > unit + TOLERANCE_TICKS], return_counts=True)
        shares = places[counts >= _MIN_SWUNG] / (2 * unit)
        ratios = {round(float(share / (1 - share)), 2) for share in shares}
        found += [Swing(r, unit) for r in sorted(ratios) if STRAIGHT < r <= MAX_RATIO and r != TRIPLETS]
    return found

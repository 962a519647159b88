"""Scores that lie on a grid already, as editors write them: their own cells, and the swing in which those are simple.

Nothing is guessed here: a stroke is on a cell or it is not. A swing is one whose ratio the offbeats themselves have,
and which explains the strokes with words that cost less than straight ones (`rhythm_words`).
"""

from collections.abc import Sequence

import numpy as np

from station.core.units import PPQ
from station.drills.grid.skeletons import PLAIN_CELLS, TUPLET_CELLS
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
    return Meant(span, _nearest(spans, span, within, cells, swing), cells, swing)


def _cost(take: Take, swing: Swing) -> float:
    feel = Feel(0.0, _SURE_S, swing)
    return take.read(feel).cost + prior_cost(feel)


def _cells(spans: BeatSpans, span: Ints, within: Ints, swing: Swing) -> Ints | None:
    """Into how many cells each span (s,) must be cut for its strokes, 1 where none is; None if a span cannot be cut."""
    found = np.ones(len(spans), np.int64)
    found[span] = 0
    lengths = spans.lengths[span]
    for cells in _CELLS:
        off = np.ones(len(span), np.bool_)
        left = np.flatnonzero(found[span] == 0)
        for length in np.unique(lengths[left]).tolist():
            here = left[lengths[left] == length]
            off[here] = np.min(_farness(cells, length, swing, within[here]), axis=0) > TOLERANCE_TICKS
        fits = np.bincount(span, off, len(spans)) == 0
        found[(found == 0) & fits] = cells
    return None if (found[span] == 0).any() else found


def _nearest(spans: BeatSpans, span: Ints, within: Ints, cells: Ints, swing: Swing) -> Ints:
    """The cell of its span (n,) that each stroke is nearest to."""
    found = np.zeros(len(span), np.int64)
    kinds = np.stack([cells[span], spans.lengths[span]])
    for count, length in np.unique(kinds, axis=1).T.tolist():
        here = np.flatnonzero((kinds[0] == count) & (kinds[1] == length))
        found[here] = np.argmin(_farness(count, length, swing, within[here]), axis=0)
    return found


def _farness(cells: int, length: int, swing: Swing, within: Ints) -> Floats:
    """How far each stroke (n,) of spans of one length is from each of their cells (cells + 1, n), in ticks."""
    far: Floats = np.abs(cell_places(cells, length, swing)[:, None] * length - within)
    return far


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

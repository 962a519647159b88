"""How well strokes lie on the cells of their beats: the likelihood behind every choice of this package.

A stroke is meant on a cell and falls about it with a Gaussian error; beyond three standard deviations the cost grows
straight, for a slip is more common than a Gaussian has it (Huber 1964). Two strokes of one piece need two cells.
Everything works on all strokes of a piece at once; costs are negative natural logarithms.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from station.drills.transcription.timing.beat_spans import BeatSpans, Floats, Ints

SLIP = 3.0
"""Standard deviations from which an error counts as a slip."""
COLLISION = 10.0
"""Cost of two strokes of a piece in one cell: never where another cell is in reach (our choice)."""
_ROUNDS = 3
"""How often strokes that meet in a cell are parted; each round parts those that the last one brought together."""


@dataclass(frozen=True, eq=False)
class Strokes:
    """The strokes of a take (shape (n,), in order of time) in their spans.

    `span` is each one's span and `place` where in it, 0 to 1; `length_s` that span's length; `piece` what is struck;
    `spread_s` the standard deviation of the errors.
    """

    spans: BeatSpans
    span: Ints
    place: Floats
    piece: Ints
    spread_s: float

    @property
    def length_s(self) -> Floats:
        """The length of each stroke's span in seconds."""
        return self.spans.lengths_s[self.span]

    @cached_property
    def by_piece(self) -> Ints:
        """The order of the strokes by piece, then time."""
        return np.lexsort((np.arange(len(self.piece)), self.piece))

    def error_cost(self, places: Floats) -> Floats:
        """What it costs each stroke that it was meant at `places` of its span."""
        z = np.abs(self.place - places) * self.length_s / self.spread_s
        return np.where(z <= SLIP, z * z / 2, SLIP * (z - SLIP / 2))

    def of(self, chosen: Ints) -> "Strokes":
        """The strokes with the indices `chosen`."""
        return Strokes(self.spans, self.span[chosen], self.place[chosen], self.piece[chosen], self.spread_s)

    def sums(self, costs: Floats) -> Floats:
        """The sum of the strokes' `costs` in each span."""
        total: Floats = np.bincount(self.span, costs, len(self.spans)).astype(np.float64)
        return total


def strokes_at(times_s: Floats, piece: Ints, spans: BeatSpans, spread_s: float) -> Strokes:
    """Strokes that fall at `times_s`, in any order that is one of time."""
    span, place = spans.places(times_s)
    return Strokes(spans, span, place, piece, spread_s)


def nearest_cells(strokes: Strokes, places: Floats) -> Ints:
    """Index of the place that each stroke is nearest to; strokes of a piece that meet there are parted if they can."""
    middles = (places[1:] + places[:-1]) / 2
    cell = np.searchsorted(middles, strokes.place).astype(np.int64)
    for _ in range(_ROUNDS):
        meet = colliding(strokes, cell)
        if not len(meet):
            break
        cell = _parted(strokes, places, cell, meet)
    return cell


def colliding(strokes: Strokes, cell: Ints) -> Ints:
    """Where in `by_piece` a stroke has the cell of the one before it."""
    order = strokes.by_piece
    piece, span, at = strokes.piece[order], strokes.span[order], cell[order]
    same = (piece[1:] == piece[:-1]) & (span[1:] == span[:-1]) & (at[1:] == at[:-1])
    return np.nonzero(same)[0] + 1


def _parted(strokes: Strokes, places: Floats, cell: Ints, meet: Ints) -> Ints:
    """The cells after each second stroke went a cell on, or the first a cell back, whichever costs less."""
    first, second = strokes.by_piece[meet - 1], strokes.by_piece[meet]
    back, on = np.maximum(cell[first] - 1, 0), np.minimum(cell[second] + 1, len(places) - 1)
    cost_back = _change(strokes, places, first, cell[first], back)
    cost_on = _change(strokes, places, second, cell[second], on)
    goes_on = cost_on <= cost_back
    moved = cell.copy()
    moved[second[goes_on]] = on[goes_on]
    moved[first[~goes_on]] = back[~goes_on]
    return moved


def _change(strokes: Strokes, places: Floats, which: Ints, now: Ints, then: Ints) -> Floats:
    """What it costs the strokes `which` to go from cell `now` to `then`; without end where that is the same."""
    some = Strokes(strokes.spans, strokes.span[which], strokes.place[which], strokes.piece[which], strokes.spread_s)
    cost = some.error_cost(places[then]) - some.error_cost(places[now])
    return np.where(now == then, np.inf, cost)


def collision_cost(strokes: Strokes, cell: Ints) -> Floats:
    """What strokes that share a piece and a cell cost each span."""
    meet = strokes.by_piece[colliding(strokes, cell)]
    return np.bincount(strokes.span[meet], minlength=len(strokes.spans)).astype(np.float64) * COLLISION

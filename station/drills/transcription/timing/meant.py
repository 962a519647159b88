"""Where strokes are meant: the common answer of what was played and of what an editor wrote."""

from dataclasses import dataclass, field, replace

import numpy as np

from station.drills.transcription.timing.beat_spans import BeatSpans, Floats, Ints
from station.drills.transcription.timing.divisions import cell_places
from station.drills.transcription.timing.rhythm_words import played_places
from station.music.swing import Swing

_SAME = 1e-6
"""Share of a beat within which two places are one; ticks are coarser."""
_CELLS = (1, 2, 3, 4, 6, 8, 12)
_CELLS_OF_SIXTEENTHS = (1, 2, 4, 3, 6, 8, 12)
"""Cells a beat under a swing of eighths, and of sixteenths, whose four come before three."""


@dataclass(frozen=True, eq=False)
class Meant:
    """Strokes (shape (n,)) on `cell` of their `span`, which is cut into `cells` (s,), under `swing`.

    `lean_s` is how late they were played as a whole, `spread_s` the standard deviation about that.
    """

    span: Ints
    cell: Ints
    cells: Ints
    swing: Swing = field(default_factory=Swing)
    lean_s: float = 0.0
    spread_s: float = 0.0

    def places(self, spans: BeatSpans) -> Floats:
        """Where in its span, 0 to 1, each stroke is played."""
        return played_places(spans, self.span, self.cell, self.cells[self.span], self.swing)

    def ticks(self, spans: BeatSpans) -> Ints:
        """The tick at which each stroke is played, swing and all."""
        return spans.starts[self.span] + np.rint(self.places(spans) * spans.lengths[self.span]).astype(np.int64)

    def straight_ticks(self, spans: BeatSpans) -> Ints:
        """The tick at which notation writes each stroke."""
        share = self.cell / self.cells[self.span]
        return spans.starts[self.span] + np.rint(share * spans.lengths[self.span]).astype(np.int64)


def recut(meant: Meant, spans: BeatSpans, swing: Swing) -> Meant:
    """The same strokes at the same places, each beat in the simplest cells that hold them under another `swing`."""
    if swing == meant.swing:
        return meant
    cell, cells = meant.cell.copy(), meant.cells.copy()
    places = meant.places(spans)
    order = _CELLS if swing.unit_ticks >= Swing().unit_ticks else _CELLS_OF_SIXTEENTHS
    for span in np.unique(meant.span).tolist():
        group = np.nonzero(meant.span == span)[0]
        for count in (*order, int(meant.cells[span])):
            far = np.abs(cell_places(count, int(spans.lengths[span]), swing)[:, None] - places[group])
            if far.min(axis=0).max() < _SAME:
                cell[group], cells[span] = np.argmin(far, axis=0), count
                break
    return replace(meant, cell=cell, cells=cells, swing=swing)

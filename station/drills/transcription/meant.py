"""Where strokes are meant: the common answer of what was played and of what an editor wrote."""

from dataclasses import dataclass, field

import numpy as np

from station.drills.transcription.beat_spans import BeatSpans, Floats, Ints
from station.drills.transcription.rhythm_words import played_places
from station.music.swing import Swing


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

"""Phrases of four bars as drummers struck them: whose touch the drummer borrows, one phrase's at a time.

A stroke's velocity and lateness hang together with all others of its phrase, in ways that no table of shares has told.
So phrases are kept whole (`tools.human_playing` writes them), and the touch of one is lent to other notes
(`borrowed_touch`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.played_beats import Beats
from station.practice.battle.improvising.stroke_place import FINEST, struck_cells

HUMAN_PHRASES = Path(__file__).parents[1] / "data" / "human_phrases.npz"
"""Read from the Groove MIDI Dataset (Gillick et al. 2019, CC BY 4.0)."""
PHRASE_BARS = 4
LEAST_STROKES = 30
"""Phrases with fewer tell little of a touch (our choice)."""
MOST_LATE_MS = 127
"""What a signed byte holds; half a sixteenth is less from 60 beats a minute on."""


@dataclass(frozen=True, eq=False)
class HumanPhrases:
    """`beats_a_bar` and `tempo` (beats a minute) of each phrase (p,); its strokes are those from `first` (p + 1,) on.

    Of each stroke (n,) `at` in 24ths of a beat from the phrase's start, `instrument`, `velocity`, `late_ms`.
    """

    beats_a_bar: NDArray[np.uint8]
    tempo: NDArray[np.int16]
    first: NDArray[np.int32]
    at: NDArray[np.int16]
    instrument: NDArray[np.int8]
    velocity: NDArray[np.uint8]
    late_ms: NDArray[np.int8]

    @classmethod
    def of(cls, takes: Sequence[tuple[float, Beats]]) -> "HumanPhrases":
        """The phrases of takes, each with its tempo in beats a minute."""
        phrases = [(tempo, phrase) for tempo, take in takes for phrase in phrases_of(take)]
        struck = [struck_cells(phrase) for _, phrase in phrases]
        late = np.concatenate([phrase.late_ms[phrase.struck] for _, phrase in phrases])
        return cls(
            beats_a_bar=np.array([phrase.beats_a_bar for _, phrase in phrases], np.uint8),
            tempo=np.array([round(tempo) for tempo, _ in phrases], np.int16),
            first=np.cumsum([0, *map(len, struck)]).astype(np.int32),
            at=np.concatenate([ticks_of(p, s) for (_, p), s in zip(phrases, struck, strict=True)]).astype(np.int16),
            instrument=np.concatenate([rows[:, 2] for rows in struck]).astype(np.int8),
            velocity=np.concatenate([phrase.velocity[phrase.struck] for _, phrase in phrases]),
            late_ms=np.clip(np.rint(late), -MOST_LATE_MS, MOST_LATE_MS).astype(np.int8),
        )

    def __len__(self) -> int:
        return len(self.tempo)


@cache
def human_phrases() -> HumanPhrases:
    """The phrases that ship."""
    with np.load(HUMAN_PHRASES, allow_pickle=False) as arrays:
        return HumanPhrases(**arrays)


def phrases_of(take: Beats) -> list[Beats]:
    """A take's runs of four bars that have enough strokes."""
    runs = [take.of_bars(bar, bar + PHRASE_BARS) for bar in range(0, take.bars - PHRASE_BARS + 1, PHRASE_BARS)]
    return [phrase for phrase in runs if phrase.struck.sum() >= LEAST_STROKES]


def ticks_of(beats: Beats, struck: NDArray[np.int64]) -> NDArray[np.int64]:
    """When each stroke (n,) comes, in 24ths of a beat from the start."""
    return np.asarray(FINEST * struck[:, 0] + FINEST * struck[:, 1] // beats.division[struck[:, 0]], np.int64)

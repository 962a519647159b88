"""Judgements: written notes and played hits paired, or left alone.

Asynchrony is played minus written: **negative is early**.
"""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray


class Label(IntEnum):
    """What became of a note or a hit."""

    MATCH = 0
    MISS = 1
    EXTRA = 2
    WRONG_PIECE = 3
    IGNORED = 4
    """A hit that nobody counts: unwritten foot timekeeping, a chick that closes an open hat, and their like."""
    PENDING = 5
    """Live only: a verdict on a note is taken back, and the note is still to be played, or has no hit."""
    PLAYED_AGAIN = 6
    """A hit of an attempt at a passage that does not count: the student began again, or played a bar twice."""
    UNKNOWN = 7
    """A note without a hit, of a moment in which no stroke could be heard: nobody knows whether it was played."""


OF_LONE_HITS = frozenset({Label.EXTRA, Label.IGNORED, Label.PLAYED_AGAIN})
"""What becomes of a hit that answers no note."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """One note, one hit, or the two paired.

    `note_index` None for extras, `hit_index` None for misses. `asynchrony_ns` played − written and `velocity_error`
    played − written where both are there, else None. `corrects`: it takes back what was said live of its
    note or hit.
    """

    label: Label
    note_index: int | None
    hit_index: int | None
    asynchrony_ns: int | None = None
    velocity_error: float | None = None
    corrects: bool = False


@dataclass(frozen=True, eq=False)
class Matching:
    """A whole alignment as arrays: one label a note (n,) and a hit (m,), and each one's partner or −1.

    `hit_of_note` (n,) and `note_of_hit` (m,) are inverse to each other; notes are MATCH, MISS, WRONG_PIECE
    or UNKNOWN, hits MATCH, WRONG_PIECE or one of `OF_LONE_HITS`.
    """

    hit_of_note: NDArray[np.int64]
    note_of_hit: NDArray[np.int64]
    note_label: NDArray[np.uint8]
    hit_label: NDArray[np.uint8]

    def count(self, label: Label) -> int:
        """How many notes (for MISS, MATCH, WRONG_PIECE, UNKNOWN) or hits (for `OF_LONE_HITS`) bear `label`."""
        labels = self.hit_label if label in OF_LONE_HITS else self.note_label
        return int(np.count_nonzero(labels == label))

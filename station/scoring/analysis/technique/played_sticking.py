"""Whether the hands are those that are written, where sensors on the sticks told which hand struck.

A stroke whose hand nobody could tell counts as neither right nor wrong. Where the lesson asks for no hand, any will do:
then only how often each hand played is told.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import HAND_PIECES, Limb
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.matching.alignment import Alignment

HANDS = (Limb.RIGHT_HAND, Limb.LEFT_HAND)


@dataclass(frozen=True, eq=False)
class PlayedSticking:
    """Masks over notes (n,): `right` and `wrong` hands, and those matched of which it `cannot_tell`.

    They are of the notes that ask for a hand. `played` counts the hits of each hand, and of none that is known.
    """

    right: NDArray[np.bool_]
    wrong: NDArray[np.bool_]
    cannot_tell: NDArray[np.bool_]
    played: dict[Limb, int]

    @property
    def told(self) -> int:
        """How many strokes were right or wrong."""
        return int(self.right.sum() + self.wrong.sum())


def played_sticking(
    score: Score, performance: Performance, alignment: Alignment, asks: NDArray[np.bool_] | None = None
) -> PlayedSticking | None:
    """The hands of `performance` beside those of `score`; None where no hit's hand is known.

    `asks` (n,) says which notes ask for their hand, None: all that have one.
    """
    limbs = performance.hits["limb"]
    if not np.isin(limbs, HANDS).any():
        return None
    written = score.notes["limb"]
    asked = np.isin(written, HANDS) & (alignment.note_label == Label.MATCH)
    if asks is not None:
        asked &= asks
    played = np.full(len(score), Limb.UNKNOWN, np.int8)
    played[asked] = limbs[alignment.hit_of_note[asked]]
    known = asked & np.isin(played, HANDS)
    by_hands = np.isin(performance.hits["piece"], [*HAND_PIECES])
    counts = {hand: int((limbs == hand).sum()) for hand in HANDS}
    counts[Limb.UNKNOWN] = int((by_hands & ~np.isin(limbs, HANDS)).sum())
    return PlayedSticking(known & (played == written), known & (played != written), asked & ~known, counts)

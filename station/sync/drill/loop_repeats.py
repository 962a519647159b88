"""A loop's own repeats: a motion that is the same twice in a loop cannot tell the first from the second.

Found in the motion itself, not in the score: two bars whose hands do the same are one to the sensors, whatever the feet
play. The kit's hits know pieces and feet, so they may settle in which repeat somebody is.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit

Array = NDArray[np.float64]

ALIKE = 0.97
"""Two segments with this normalised correlation are one motion: the drummer's own, without chance, has 1.000 where a
bar returns and at most 0.956 where it is changed (samba-1, docs/drill-phase.md)."""
NEAR_S = 0.08
"""A hit so near to a note of its piece speaks for it: half a sixteenth at 94 bpm (our choice)."""
LEAD_HITS = 3
"""A repeat is settled when so many more hits speak for it than for any other (our choice: one or two are slips)."""


def repeats(values: Array, strokes: Sequence[int]) -> int:
    """How often the shortest motion returns within a loop, 1 where none does.

    `values` (n, c) are samples evenly over the loop, zero-mean; `strokes` how many each hand plays, which a repeat
    shares out evenly.
    """
    most = int(np.gcd.reduce([count for count in strokes if count] or [1]))
    return next(parts for parts in range(most, 0, -1) if most % parts == 0 and _returns(values, parts))


def _returns(values: Array, parts: int) -> bool:
    """Whether the loop is the same when it is turned by one of `parts`."""
    if parts == 1:
        return True
    norm = np.sum(values**2)
    return bool(np.sum(values * _turned(values, len(values) / parts)) > ALIKE * norm)


def _turned(values: Array, by: float) -> Array:
    """`values` read `by` samples later, straight between samples."""
    at = np.arange(len(values)) + by
    below = np.floor(at).astype(int)
    share = (at - below)[:, None]
    return np.asarray((1 - share) * values[below % len(values)] + share * values[(below + 1) % len(values)])


def settled(
    hits: Sequence[Hit], place_s: Sequence[float], onset_s: Array, piece: NDArray[np.integer], loop_s: float, parts: int
) -> int | None:
    """In which of a loop's `parts` equal repeats somebody is, by what they struck; None where the hits do not say.

    `place_s` is where in the loop each hit fell if this were the first repeat; the loop's notes are at `onset_s` (n,)
    and on `piece` (n,).
    """
    votes = np.zeros(parts)
    for hit, place in zip(hits, place_s, strict=True):
        mine = onset_s[piece == hit.piece]
        if len(mine):
            places = place + loop_s / parts * np.arange(parts)
            apart = (places[:, None] - mine + loop_s / 2) % loop_s - loop_s / 2
            votes += np.abs(apart).min(axis=1) < NEAR_S
    first, second = (*np.sort(votes)[::-1], 0.0)[:2]
    return int(np.argmax(votes)) if first - second >= LEAD_HITS or parts == 1 else None

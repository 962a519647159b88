"""Buzz rolls in a MIDI file: notes of a drum that are held, in a file whose strokes are short.

MIDI has no sign for a buzz; programs that keep one hold its note, as ours does. A drum's note length means something
only where all other strokes have one length: in most files it is an accident of the editor.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import DRUMS, Articulation

_LONGER = 2
"""So many times as long as a stroke a held note is at least (our choice)."""


def held_notes(
    ticks: NDArray[np.int64],
    lasts: NDArray[np.int64],
    pieces: NDArray[np.uint8],
    articulations: NDArray[np.uint8],
    shortest: int,
) -> NDArray[np.bool_]:
    """Which notes (n,) of a file are buzz rolls; `lasts` is how long each is, in its ticks, `shortest` a buzz's least.

    All other strokes are of one length, and a drum that has no such stroke is held each time until its next one.
    """
    may_buzz: NDArray[np.bool_] = np.isin(pieces, sorted(DRUMS)) & (articulations == Articulation.NORMAL)
    others = lasts[~may_buzz] if not may_buzz.all() else lasts[lasts == lasts.min(initial=0)]
    if not len(others) or others.min() != others.max():
        return np.zeros(len(ticks), np.bool_)
    held: NDArray[np.bool_] = may_buzz & (lasts >= max(_LONGER * int(others[0]), shortest))
    if (lasts[~held] != others[0]).any():
        return np.zeros(len(ticks), np.bool_)
    for piece in np.unique(pieces[held]):
        own = np.flatnonzero(pieces == piece)
        if held[own].all() and not _runs_on(ticks[own], lasts[own]):
            held[own] = False
    return held


def _runs_on(ticks: NDArray[np.int64], lasts: NDArray[np.int64]) -> bool:
    """Whether most notes of one piece last until the next begins."""
    order = np.argsort(ticks, kind="stable")
    gaps = np.diff(ticks[order])
    return len(gaps) > 0 and bool((lasts[order][:-1] == gaps).mean() >= _MOST)


_MOST = 0.5
"""A roll is written bound, but for its rests (our choice)."""

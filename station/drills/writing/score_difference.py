"""Where two scores differ, said for people: what tells that music written anew is still the same."""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece, word
from station.music.score import NOTE_DTYPE, Score

_SILENT = ("midi_note", "swing_ticks")
"""Columns that no player hears: where a note came from, and how the swing that it is played with is written."""
_ORDER = ("tick", "lead_ms", "piece", "limb", *(name for name in NOTE_DTYPE.names or () if name != "midi_note"))


def in_one_order(rows: NDArray[np.void]) -> NDArray[np.void]:
    """Rows (n,) in an order that is theirs alone: two feet on one kick at once come in any order, and sound alike."""
    return rows[np.lexsort([rows[name] for name in reversed(_ORDER)])]


def score_difference(a: Score, b: Score) -> str:
    """What the first stroke is that differs, for people; empty if the scores sound and read alike."""
    if a.tempo_map != b.tempo_map or a.end_tick != b.end_tick:
        return "tempo, meter or length differ"
    if len(a) != len(b):
        return f"{len(a)} strokes became {len(b)}"
    ours, theirs = in_one_order(a.notes), in_one_order(b.notes)
    for name in NOTE_DTYPE.names or ():
        if name in _SILENT:
            continue
        left, right = ours[name], theirs[name]
        same = (left == right) | (np.isnan(left) & np.isnan(right))
        if not np.all(same):
            i = int(np.flatnonzero(~same)[0])
            place = a.tempo_map.position_at(int(ours["tick"][i]))
            piece = word(Piece(ours["piece"][i]))
            return f"bar {place.bar + 1}, beat {place.beat + 1}, {piece}: {name} {left[i]} became {right[i]}"
    return ""

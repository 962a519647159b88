"""Where two scores differ, said for people: what tells that music written anew is still the same."""

import numpy as np

from station.core.pieces import word
from station.music.score import NOTE_DTYPE, Score

_SILENT = ("midi_note", "swing_ticks")
"""Columns that no player hears: where a note came from, and how the swing that it is played with is written."""


def score_difference(a: Score, b: Score) -> str:
    """What the first stroke is that differs, for people; empty if the scores sound and read alike."""
    if a.tempo_map != b.tempo_map or a.end_tick != b.end_tick:
        return "tempo, meter or length differ"
    if len(a) != len(b):
        return f"{len(a)} strokes became {len(b)}"
    for name in NOTE_DTYPE.names or ():
        if name in _SILENT:
            continue
        left, right = a.notes[name], b.notes[name]
        same = (left == right) | (np.isnan(left) & np.isnan(right))
        if not np.all(same):
            i = int(np.flatnonzero(~same)[0])
            note = a[i]
            place = a.tempo_map.position_at(note.tick)
            return f"bar {place.bar + 1}, beat {place.beat + 1}, {word(note.piece)}: {name} {left[i]} became {right[i]}"
    return ""

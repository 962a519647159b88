"""A bar of the other player's turn, as a phrase that can be sounded and shown: every stroke where it was played."""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Ornament
from station.core.units import NS_PER_MS
from station.music.performance import Performance
from station.music.score import NOTE_DTYPE, Score
from station.practice.battle.ground import Ground
from station.practice.battle.phrase import Phrase

_SAME = ("openness", "piece", "zone", "articulation", "velocity", "limb", "midi_note")


def bar_of(played: Performance, bar: int, ground: Ground, early_ns: int) -> Performance:
    """What of a turn, in turn time, belongs to its bar: from `early_ns` before its downbeat up to before the next."""
    begin_ns, end_ns = (ground.ns_of_bars(number) - early_ns for number in (bar, bar + 1))
    hits, chokes = (
        rows[(rows["at_ns"] >= begin_ns) & (rows["at_ns"] < end_ns)] for rows in (played.hits, played.chokes)
    )
    return Performance.from_array(hits, chokes)


def heard_bar(played: Performance, bar: int, ground: Ground) -> Phrase:
    """The bar with its strokes, in turn time, moved to where it begins; what came before its downbeat stays before."""
    at_ns = played.hits["at_ns"] - ground.ns_of_bars(bar)
    notes = np.zeros(len(played), NOTE_DTYPE)
    for name in _SAME:
        notes[name] = played.hits[name]
    notes["dynamic"], notes["ornament"] = Dynamic.NORMAL, Ornament.NONE  # velocities say it
    notes["tick"] = ground.tempo_map.ticks_at_ns(np.maximum(at_ns, 0))
    notes["late_ms"] = np.minimum(at_ns, 0) / NS_PER_MS
    notes["choke_ticks"] = _choke_ticks(played, ground)
    return Phrase(Score.from_array(notes, ground.tempo_map, ground.bar_ticks))


def _choke_ticks(played: Performance, ground: Ground) -> NDArray[np.int64]:
    """How long after each stroke (n,) its cymbal is grabbed: the last one before each choke; 0 where none is."""
    ticks = np.zeros(len(played), np.int64)
    for choke in played.chokes:
        before = np.flatnonzero((played.hits["piece"] == choke["piece"]) & (played.hits["at_ns"] < choke["at_ns"]))
        if len(before):
            after_ns = int(choke["at_ns"]) - int(played.hits["at_ns"][before[-1]])
            ticks[before[-1]] = max(int(ground.tempo_map.ticks_at_ns(after_ns)), 1)
    return ticks

"""What was played as a score: every hit a note at its own time, nothing moved to a grid."""

import numpy as np

from station.core.pieces import Dynamic, Ornament
from station.music.performance import Performance
from station.music.score import NOTE_DTYPE, Score
from station.music.tempo import TempoMap

_SAME = ("openness", "piece", "zone", "articulation", "limb", "midi_note")
"""Fields that hits and notes share."""


def score_as_played(played: Performance, tempo_map: TempoMap, title: str = "") -> Score:
    """The hits of `played`, whose time 0 is the score's, to the nearest tick (5 µs at 120 bpm); chokes with them.

    Hits before time 0 move the score on by as many of its first bars as they need.
    """
    hits = played.hits
    bar_ns = int(tempo_map.ns_at(tempo_map.bar_start(1)))
    early_ns = max(0, -int(hits["at_ns"].min(initial=0)))
    shift_ns = -(-early_ns // bar_ns) * bar_ns
    notes = np.zeros(len(hits), NOTE_DTYPE)
    notes["tick"] = tempo_map.ticks_at_ns(hits["at_ns"] + shift_ns)
    notes["dynamic"], notes["ornament"] = Dynamic.NORMAL, Ornament.NONE  # as in MIDI files: velocities say it
    notes["velocity"] = np.maximum(hits["velocity"], 1)
    for name in _SAME:
        notes[name] = hits[name]
    for choke in played.chokes:
        tick = int(tempo_map.ticks_at_ns(choke["at_ns"] + shift_ns))
        before = np.flatnonzero((notes["piece"] == choke["piece"]) & (notes["tick"] < tick))
        if len(before):
            notes["choke_ticks"][before[-1]] = tick - notes["tick"][before[-1]]
    return Score.from_array(notes, tempo_map, title=title)

"""How far from its note a hit may lie: by the spacing of what is written, and the tempo. One rule, live and at the end.

A hit belongs to the note whose neighbours leave it no better place. So a note's reach, to each side, is a share of the
way to the next slot of its match class, which the music shortens where it is dense, and a part of a beat where it is
not. Who plays a shuffle straight at 60 bpm is 167 ms early and has played every note; a 16th at 160 bpm reaches 60 ms,
and takes nothing that belongs to the next.
"""

import numpy as np

from station.core.units import NS_PER_MS, PPQ
from station.music.score import Score
from station.scoring.matching.pairing import Indices, Room, Times

_SHARE = 0.6
"""Of the way to the next slot: half of it is where both are as near, and straight eighths that are swung 4:1, harder
than players swing (HUMANS: 1–3.5), still lie within it."""

_PART_OF_BEAT = 1 / 3
"""Of a quarter, where the next slot is far: twice what straight and swung offbeats of 2:1 are apart."""

LEAST_REACH_NS = 60 * NS_PER_MS
"""Our choice: below 45 ms even a machine-like player's slip would be a miss. In a roll, whose notes are nearer to each
other than that, the order of the strokes says which is which."""

_LEAST_FAR_NS = 120 * NS_PER_MS
"""The part of a beat is never less (our choice: a beginner's worst intended stroke, as DTXMania's widest window)."""

TOGETHER_NS = 40 * NS_PER_MS
"""A piece's strokes written so close are one slot's: flams reach 40 ms (HUMANS, Timing)."""


def reach_of(score: Score, lane: Indices) -> Room:
    """The reach of each note of `score` among those of its `lane` (n,), in ns of score time."""
    at_ns = score.onset_ns
    if not len(at_ns):
        return Room(at_ns, at_ns)
    order = np.lexsort((at_ns, lane))
    apart = np.diff(at_ns[order])
    apart[np.diff(lane[order]) != 0] = _NEVER
    apart = np.concatenate(([_NEVER], apart, [_NEVER]))
    begins = np.flatnonzero(apart[:-1] > TOGETHER_NS)  # of slots
    slot = np.cumsum(apart[:-1] > TOGETHER_NS) - 1
    ends = np.append(begins[1:], len(order))
    far_ns = _far_ns(score)[order]
    early, late = np.empty(len(order), np.int64), np.empty(len(order), np.int64)
    early[order] = _share(apart[begins[slot]], far_ns)
    late[order] = _share(apart[ends[slot]], far_ns)
    return Room(early, late)


_NEVER = 2**60


def _share(apart_ns: Times, far_ns: Times) -> Times:
    reach_ns: Times = np.maximum(np.minimum(np.rint(_SHARE * apart_ns).astype(np.int64), far_ns), LEAST_REACH_NS)
    return reach_ns


def _far_ns(score: Score) -> Times:
    """The reach of each note (n,) that has no neighbours."""
    tick = score.notes["tick"]
    quarter_ns = score.tempo_map.ns_at(tick + PPQ) - score.tempo_map.ns_at(tick)
    far_ns: Times = np.maximum(np.rint(_PART_OF_BEAT * quarter_ns).astype(np.int64), _LEAST_FAR_NS)
    return far_ns

"""The same part on another cymbal: the timekeeping of a lesson moved between hi-hat and ride.

A groove that holds in one orchestration only is half learnt (TEACHING: vary the orchestration once it is stable). Notes
stay where they are in time; a hi-hat stroke becomes one on the ride's bow, one on the ride a stroke on the closed
hi-hat.
"""

import numpy as np

from station.core.pieces import Articulation, Piece, Zone
from station.music.score import Score

CLOSED = 0.0


def can_reorchestrate(score: Score) -> bool:
    """Whether the score keeps time on hi-hat or ride; with both, strokes would fall together, or change hands."""
    return len(np.intersect1d(score.notes["piece"], (Piece.HIHAT, Piece.RIDE))) == 1


def reorchestrated(score: Score) -> Score:
    """The score with its strokes on the hi-hat on the ride, or those on the ride on the hi-hat; it has only one."""
    assert can_reorchestrate(score), "there is another cymbal for all strokes"
    notes = score.notes.copy()
    hat = notes["piece"] == Piece.HIHAT
    if hat.any():
        moved, piece, zone, openness = hat, Piece.RIDE, Zone.BOW, np.nan
    else:
        moved, piece, zone, openness = notes["piece"] == Piece.RIDE, Piece.HIHAT, Zone.BOW, CLOSED
    for name, value in (
        ("piece", piece),
        ("zone", zone),
        ("openness", openness),
        ("articulation", Articulation.NORMAL),
    ):
        notes[name][moved] = value
    for name in ("choke_ticks", "midi_note"):
        notes[name][moved] = 0
    return Score.from_array(notes, score.tempo_map, score.end_tick, score.title, score.loudness, score.beyond)

"""How loud against how loud it was written: velocity error, level in dB, and the classes ghost, normal, accent.

Pads answer differently and players play at their own level, so that loudness is judged against the player's own level
on that pad: the median difference between what was played and written there is set apart first, in which unmarked
strokes count thrice. Level is 40·log10(v/127) dB (HUMANS, Velocity). Only marked notes, ghosts and accents, and the
unmarked ones beside them ask for anything; elsewhere shaping a repeated hat is free.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic
from station.core.units import PPQ
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.matching.alignment import Alignment

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

FREE_DB = 2.0
"""Nobody hears less as wrong (HUMANS: dynamics in dB with ±2 dB free)."""

LOST_DB = 12.0
"""So far off nothing of the dynamic is left: the step from accent to normal, and from normal to ghost (our choice)."""

BESIDE_TICKS = 2 * PPQ
"""An unmarked stroke this near a marked one on its piece shows the contrast (our choice: two beats)."""

_FULL_SCALE = 127.0
_DB_PER_DECADE = 40.0


@dataclass(frozen=True, eq=False)
class Loudness:
    """Loudness of the matched notes.

    `mean_velocity_error` and `sd_velocity_error` played − written over all matched notes, graces too. `confusion` (3,
    3) counts matched, judged notes, row = written class, column = played class (ghost, normal, accent). `off_db` (n,)
    played − written level beyond the player's own on that piece, NaN where not judged. None or empty without data.
    """

    mean_velocity_error: float | None
    sd_velocity_error: float | None
    confusion: NDArray[np.int64]
    off_db: Floats


def level_db(velocity: NDArray[np.generic] | Floats) -> Floats:
    """Level of velocities 1–127 in dB against full scale."""
    return np.asarray(_DB_PER_DECADE * np.log10(np.maximum(velocity.astype(np.float64), 1.0) / _FULL_SCALE))


def judged_notes(score: Score) -> Flags:
    """Marked notes and the unmarked ones beside them on the same piece, shape (n,); no grace strokes."""
    judged = np.zeros(len(score), np.bool_)
    notes, main = score.notes, ~score.is_grace
    for piece in np.unique(notes["piece"]):
        own = np.flatnonzero(main & (notes["piece"] == piece))
        marked = notes["tick"][own[notes["dynamic"][own] != Dynamic.NORMAL]]
        if len(marked):
            right = np.minimum(np.searchsorted(marked, notes["tick"][own]), len(marked) - 1)
            left = np.maximum(right - 1, 0)
            near = np.minimum(np.abs(marked[right] - notes["tick"][own]), np.abs(marked[left] - notes["tick"][own]))
            judged[own[near <= BESIDE_TICKS]] = True
    return judged


def dynamics(score: Score, performance: Performance, alignment: Alignment) -> Loudness:
    """Sum up the loudness of what was matched."""
    matched = np.flatnonzero(alignment.note_label == Label.MATCH)
    played = performance.fine_velocity[alignment.hit_of_note[matched]]
    written = score.notes["velocity"][matched].astype(np.float64)
    error = played - written
    off_db = np.full(len(score), np.nan)
    off_db[matched] = level_db(played) - level_db(written)
    judged = judged_notes(score) & (alignment.note_label == Label.MATCH)
    off_db = _against_own_level(score, off_db, judged)
    return Loudness(
        float(error.mean()) if len(error) else None,
        float(error.std(ddof=1)) if len(error) > 1 else None,
        _confusion(score, off_db, judged),
        off_db,
    )


_UNMARKED_COUNT = 3
"""An unmarked stroke says as much of a pad's own level as so many marked ones, for these somebody thinks about (our
choice); no number of them is a threshold."""


def _against_own_level(score: Score, off_db: Floats, judged: Flags) -> Floats:
    """`off_db` less the player's own level on each piece; NaN where not judged."""
    own = np.full(len(off_db), np.nan)
    for piece in np.unique(score.notes["piece"][judged]):
        here = judged & (score.notes["piece"] == piece)
        says = np.where(score.notes["dynamic"][here] == Dynamic.NORMAL, _UNMARKED_COUNT, 1)
        own[here] = off_db[here] - np.median(np.repeat(off_db[here], says))
    return own


def _confusion(score: Score, off_db: Floats, judged: Flags) -> NDArray[np.int64]:
    """Written class against the class whose written level on that piece lies nearest to what was played."""
    table = np.zeros((len(Dynamic), len(Dynamic)), np.int64)
    written_db = level_db(score.notes["velocity"])
    for piece in np.unique(score.notes["piece"][judged]):
        here = judged & (score.notes["piece"] == piece)
        dynamic = score.notes["dynamic"][here].astype(np.int64)
        classes = np.unique(dynamic)
        centres = np.array([np.median(written_db[here][dynamic == c]) for c in classes])
        played_db = written_db[here] + off_db[here]
        heard = classes[np.argmin(np.abs(played_db[:, None] - centres[None, :]), axis=1)]
        np.add.at(table, (dynamic, heard), 1)
    return table


def dynamic_credit(off_db: Floats) -> Floats:
    """Share of full marks, 1 … 0: all within `FREE_DB`, none beyond `LOST_DB`, 1 where not judged (NaN)."""
    return np.interp(np.abs(np.nan_to_num(off_db, nan=0.0)), (FREE_DB, LOST_DB), (1.0, 0.0))

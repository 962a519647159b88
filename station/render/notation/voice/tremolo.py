"""Diddles and open rolls as one note with slashes on its stem: which strokes are written so, and how they are drawn.

A diddle's two strokes share a cell of the beat: the cell is a note with one slash more than its own beams or flags,
for both strokes are half as long. So every cell of a roll keeps its own sticking. Where another stroke of the voice
falls within the cell, or the cell is longer than a beat, both strokes are written out.
"""

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from operator import itemgetter

import numpy as np
from numpy.typing import NDArray

from station.music.passages import diddle_pairs
from station.music.score import Score
from station.render.notation.beams import Anchor, StaffVoice
from station.render.notation.spelling.note_values import TimedValue
from station.render.notation.spelling.written_rhythm import beats_of
from station.render.palette import INK
from station.render.text.sign_outlines import BEAM_STEP

_HEAD_ROOM, _FLAG_ROOM, _OVER_WHOLE = 1.0, 3.25, 1.6
"""What stays free beside a head, what a flag takes of a stem, and how far from a whole note slashes stand, in staff
spaces (our choice)."""


def measured_cells(
    score: Score, is_foot: NDArray[np.bool_], written: NDArray[np.int64]
) -> Iterator[tuple[int, int, int]]:
    """First and second stroke of each cell that one note writes, and the written tick where it ends.

    `is_foot` and `written`, shape (n,), tell the voices and where strokes are written.
    """
    pairs = [(a, b) for a, b in diddle_pairs(score) if is_foot[a] == is_foot[b] and written[a] < written[b]]
    if not pairs:
        return
    beats, seconds = sorted(beats_of(score)), dict(pairs)
    mains = np.flatnonzero(~score.is_grace)
    mains = mains[np.argsort(written[mains], kind="stable")]
    for a, b in pairs:
        until = int(2 * written[b] - written[a])
        first, last = np.searchsorted(written[mains], [written[a], until])
        inside = {i for i in mains[first:last].tolist() if is_foot[i] == is_foot[a]}
        openers = {i for i in inside if written[i] == written[a]}
        fits = until <= beats[bisect_right(beats, written[a], key=itemgetter(0)) - 1][1]
        together = all(i in seconds and written[seconds[i]] == written[b] for i in openers)
        if fits and together and inside == openers | {seconds[i] for i in openers}:
            yield a, b, until


def draw_slashes(
    anchor: Anchor, value: TimedValue, voice: StaffVoice, stem: tuple[Sequence[float], float], has_flags: bool
) -> None:
    """The slashes of a note: `stem` is where its heads are and where it ends."""
    heads, beam_y = stem
    head = min(heads) if voice.is_up else max(heads)
    taken = max(value.value.beams - 1, 0) * BEAM_STEP + (_FLAG_ROOM if has_flags else 0.5) * bool(value.value.beams)
    near, far = head + voice.way * _HEAD_ROOM, beam_y - voice.way * taken
    x, middle = voice.stem_x, (near + far) / 2
    if value.value.base == 1:
        x, middle = 0.0, head + voice.way * _OVER_WHOLE
    anchor.draw_list.sign(f"tremolo_{value.slashes}", (x, middle), INK)

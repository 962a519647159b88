"""Runs of kicks that are too fast for one foot, shared between two as double pedals are taught.

The feet take turns on the cells of the run, the right foot on the beat; a cell without a stroke is a turn missed, so
that a gallop (x-xx) is R-RL. A run in which the left foot has the hi-hat stays the right foot's.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.motion.feasibility.playable import unplayable_rows
from station.music.score import Note, Score
from station.music.tempo import TempoMap

_TURNS = 2
"""A run goes on where the next kick is at most so many cells away: one missed turn (our choice)."""


def with_both_feet(notes: Sequence[Note], tempo_map: TempoMap) -> list[Note]:
    """The main strokes `notes`, in order of ticks, in runs of kicks beyond one foot every other by the left foot."""
    kicks = [i for i, n in enumerate(notes) if n.piece is Piece.KICK]
    if any(notes[i].limb is Limb.LEFT_FOOT for i in kicks) or len(kicks) < 2:
        return list(notes)
    ticks = [notes[i].tick for i in kicks]
    too_fast = {ticks[i] for i in unplayable_rows(Score.from_notes([notes[i] for i in kicks], tempo_map)).tolist()}
    pedals = [n.tick for n in notes if n.piece is Piece.HIHAT_PEDAL]
    left: set[int] = set()
    for run in _runs(ticks, too_fast):
        if not any(run[0] <= tick <= run[-1] for tick in pedals):
            left |= _left(run, tempo_map)
    return [replace(n, limb=Limb.LEFT_FOOT) if n.piece is Piece.KICK and n.tick in left else n for n in notes]


def _runs(ticks: Sequence[int], too_fast: set[int]) -> Iterator[list[int]]:
    """The runs as fast as those in which kicks come too fast."""
    gaps = [b - a for a, b in pairwise(ticks) if b in too_fast]
    if not gaps:
        return
    cell, run = min(gaps), [ticks[0]]
    for tick in [*ticks[1:], None]:
        if tick is not None and tick - run[-1] <= _TURNS * cell:
            run.append(tick)
            continue
        if any(b - a <= cell for a, b in pairwise(run)):
            yield run
        run = [tick] if tick is not None else []


def _left(run: Sequence[int], tempo_map: TempoMap) -> set[int]:
    """The kicks of a run whose turn is the left foot's; turns are counted from the beat in which it begins."""
    cell = min(b - a for a, b in pairwise(run))
    begin = tempo_map.bar_start(int(tempo_map.bars_at(run[0])))
    begin += (run[0] - begin) // PPQ * PPQ
    return {tick for tick in run if round((tick - begin) / cell) % 2}

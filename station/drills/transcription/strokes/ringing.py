"""How long buzzes and ringing cymbals last: to a cell of the grid, and never into what comes next."""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import replace

from station.core.pieces import Articulation, Piece
from station.core.units import PPQ
from station.drills.transcription.strokes.playable_strokes import Reach
from station.drills.transcription.timing.grid_times import BeatCells, GridTimes
from station.music.score import Note

SHORTEST_BUZZ_TICKS = PPQ // 4
"""A sixteenth, for a buzz of which the file does not say how long it lasts."""


def with_lengths(reach: Reach, ends: Sequence[int], times: GridTimes) -> list[Note]:
    """The strokes that are asked, in order; rolls end, at the latest, where their piece is struck next or at an end.

    `ends` are ticks in order, the music's end the last; a cymbal that rings until the next stroke is not choked. What
    was played ends on a cell, as its strokes begin on one.
    """
    marks = reach.marks
    next_tick: dict[Piece, int] = {}
    kept: list[Note] = []
    for note in sorted((*reach.asked, *reach.beyond), key=lambda n: (n.tick, n.piece), reverse=True):
        end = ends[min(bisect_right(ends, note.tick), len(ends) - 1)]
        room = min(next_tick.get(note.piece, end), end) - note.tick
        is_buzz = note.articulation is Articulation.BUZZ
        wanted = _on_a_cell(note, note.duration_ticks or SHORTEST_BUZZ_TICKS, times) if is_buzz else 0
        choke = _on_a_cell(note, note.choke_ticks, times) if note.choke_ticks else 0
        kept.append(replace(note, duration_ticks=min(wanted, room), choke_ticks=choke if choke < room else 0))
        next_tick[note.piece] = note.tick
    return [note for note in reversed(kept) if (note.tick, note.piece) not in marks]


def _on_a_cell(note: Note, lasts_ticks: int, times: GridTimes) -> int:
    """How long a stroke lasts to the nearest cell after it; as long as it does where the score was on a grid."""
    if not times.spread_ms:
        return lasts_ticks
    beat = times.beats[max(bisect_right(times.beats, note.tick, key=_start) - 1, 0)]
    end = note.tick + lasts_ticks
    there = times.beats[max(bisect_right(times.beats, end, key=_start) - 1, 0)]
    there = (
        there
        if end < there.tick + there.length_ticks
        else BeatCells(end - end % beat.length_ticks, beat.length_ticks, 1)
    )
    cells = 1 if times.swing.ratio != 1 else there.cells
    places = [there.tick + round(i * there.length_ticks / cells) for i in range(cells + 1)]
    after = [place for place in places if place > note.tick]
    return min(after, key=lambda place: abs(place - end)) - note.tick if after else there.length_ticks


def _start(beat: BeatCells) -> int:
    return beat.tick

"""Dynamics of a take by what its player mostly does: a groove is struck alike whenever it comes again.

Nobody strikes twice alike, and where two levels of a player lie near each other some strokes of a steady groove fall on
the wrong side of the line between them. Where a piece has the same rhythm in several bars, each place of that rhythm
has levels of its own (`levels_of`), mostly one; all strokes of such a level are meant as most of them are. A stroke
that is clearly louder or softer than the others of its place is a level by itself and stays as it was heard.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from station.core.pieces import Dynamic, Piece
from station.drills.grid.stroke_settings import Velocities
from station.drills.transcription.strokes.loudness_levels import levels_of
from station.music.score import Note
from station.music.tempo import TempoMap

_FEWEST_BARS = 3
"""So many bars have a majority (our choice; of two nobody knows which is meant)."""
_Place = tuple[Piece, tuple[int, ...], int]
"""A piece, the ticks in a bar at which it is struck, and one of them."""


def steady_dynamics(
    strokes: Sequence[Note], heard: Sequence[int], velocities: Velocities, tempo_map: TempoMap
) -> list[Note]:
    """`strokes` of a take with the dynamic that most of their place have, and its velocity.

    `heard` has the velocity with which each was struck, `velocities` those of the dynamics.
    """
    found = list(strokes)
    for place in _places(strokes, tempo_map).values():
        if len(place) >= _FEWEST_BARS:
            for level in levels_of([heard[i] for i in place]):
                alike = [i for i in place if level.low <= heard[i] <= level.high]
                usual, count = Counter(strokes[i].dynamic for i in alike).most_common(1)[0]
                for i in alike if 2 * count > len(alike) else ():
                    found[i] = _struck(strokes[i], usual, velocities)
    return found


def _struck(note: Note, dynamic: Dynamic, velocities: Velocities) -> Note:
    return replace(note, dynamic=dynamic, velocity=velocities.of(note.piece, dynamic))


def _places(strokes: Sequence[Note], tempo_map: TempoMap) -> dict[_Place, list[int]]:
    """The indices of the strokes at each place of each rhythm."""
    by_bar: dict[tuple[Piece, int], list[int]] = {}
    bars = tempo_map.bars_at([note.tick for note in strokes]).tolist()
    for i, (note, bar) in enumerate(zip(strokes, bars, strict=True)):
        by_bar.setdefault((note.piece, bar), []).append(i)
    found: dict[_Place, list[int]] = {}
    for (piece, bar), indices in by_bar.items():
        start = tempo_map.bar_start(bar)
        rhythm = tuple(strokes[i].tick - start for i in indices)
        for i, tick in zip(indices, rhythm, strict=True):
            found.setdefault((piece, rhythm, tick), []).append(i)
    return found

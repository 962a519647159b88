"""Strokes of a kit as strokes of a grid: which line, which letter, how loud.

Loudness is heard by the grid's own dynamics: the border between two of them lies at the mean of their velocities, as
the spread of a hand is even in MIDI's scale (HUMANS: ± 10 of 127). Within `HYSTERESIS` of a border a stroke is what the
stroke before it on that line was, so that a hand that plays near a border is not written in two kinds.
"""

from collections.abc import Iterable, Sequence
from itertools import pairwise

from station.core.events import Hit
from station.core.pieces import CLOSED, Articulation, Dynamic, Limb, Ornament, Piece
from station.drills.editing.lesson_edits import LineAt, PlayedStroke
from station.drills.grid.stroke_settings import Velocities
from station.drills.grid.tab_symbols import LETTER_OF, TabFamily, TabSymbol, family_of
from station.drills.transcription.strokes.letters import nearest_letter
from station.music.tempo import TempoMap

HYSTERESIS = 4
"""Half a practised hand's spread (`loudness_levels.SPREAD`): a wider one would swallow dynamics that lie 16 apart, a
narrower one does nothing (our choice)."""


def played_strokes(
    hits: Iterable[Hit], grid: int, lines: Sequence[LineAt], tempo_map: TempoMap, velocities: Velocities
) -> tuple[PlayedStroke, ...]:
    """The strokes that `hits` make in grid `grid`, whose bars lie on `tempo_map` from its tick 0.

    The hits are in the order in which they came, their `at_ns` from there, negative before it. `lines` are those that
    the grid has: a stroke goes to the line of its piece, with the hand that the kit knows where there are several, and
    to a line to be made where there is none.
    """
    found: list[PlayedStroke] = []
    before: dict[Piece, Dynamic] = {}
    for hit in hits:
        dynamic = heard_dynamic(hit.velocity, hit.piece, velocities, before.get(hit.piece))
        before[hit.piece] = dynamic
        tick = float(tempo_map.ticks_at_ns(hit.at_ns))
        found.append(PlayedStroke(_line(hit, grid, lines), tick, _letter(hit, dynamic), hit.velocity))
    return tuple(found)


def heard_dynamic(velocity: int, piece: Piece, velocities: Velocities, before: Dynamic | None) -> Dynamic:
    """What a stroke of `piece` is, the one before it on its line having been `before`."""
    levels = [velocities.of(piece, dynamic) for dynamic in Dynamic]
    borders = [(low + high) / 2 for low, high in pairwise(levels)]
    if before is not None:
        borders = [b + HYSTERESIS if before <= i else b - HYSTERESIS for i, b in enumerate(borders)]
    return Dynamic(sum(velocity >= border for border in borders))


def _letter(hit: Hit, dynamic: Dynamic) -> str:
    """The letter that plays most nearly what was played."""
    family = family_of(hit.piece)
    openness = CLOSED if hit.openness is None and family is TabFamily.HIHAT else hit.openness
    articulation = Articulation.NORMAL if hit.articulation is Articulation.BUZZ else hit.articulation
    symbol = nearest_letter(family, TabSymbol(hit.zone, articulation, dynamic, openness, Ornament.NONE))
    return LETTER_OF[family][symbol]


def _line(hit: Hit, grid: int, lines: Sequence[LineAt]) -> LineAt:
    mine = [line for line in lines if (line.grid, line.piece, line.cycle) == (grid, hit.piece, None)]
    by_limb = (line for line in mine if line.limb is hit.limb)
    return next(by_limb, None) or next(iter(mine), None) or LineAt(grid, hit.piece, Limb.UNKNOWN)

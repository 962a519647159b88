"""Into how many cells each beat of a turn is cut: the likeliest course of divisions, by the playing alone.

A stroke falls about its cell with a Gaussian error (`take_fit`), and each division costs what it costs a transcriber
(`divisions`): that is one beat. A beat with few strokes says little, so that the course of all beats is sought at
least cost (Viterbi 1967), where a change between beats costs the more the less the two divisions have in common.
All is tried with several leans and swings of the whole turn, for a player who is late everywhere plays no other
rhythm, and fast jazz swings less than triplets do.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.drills.transcription.timing.beat_spans import BeatSpans, Floats, Ints
from station.drills.transcription.timing.beat_spans import is_ternary as is_ternary_span
from station.drills.transcription.timing.divisions import Division, divisions_of
from station.drills.transcription.timing.take_feel import LEAN_SD_S, LEANS_S
from station.drills.transcription.timing.take_fit import Strokes, collision_cost, nearest_cells
from station.music.swing import Swing
from station.practice.battle.ground import Feel, Ground

DIVISIONS = (3, 4, 6, 8)
"""Eighth triplets, sixteenths, sextuplets, thirty-seconds: the cells that a beat may have."""
MOST_CELLS = max(DIVISIONS)
SPREAD_S = 0.020
"""The spread of the strokes about their cells: between a professional's 10 ms and the 26 ms of the Groove MIDI Dataset
(HUMANS, Timing)."""
OTHER_FEEL_COST = 0.4
"""What each beat with strokes between the beats costs that is not divided in the ground's feel: it decides where the
playing does not, as between straight eighths and the light swing of fast jazz. Our choice: less than one stroke on a
clear triplet says."""
OFF_THE_BEAT = 1 / 8
"""So far from both beats, of a beat, lies a stroke between them (our choice: the finest cell)."""
SWUNG_PLACES = (2 / 3, 0.60, 0.72)
"""Where the third of three is played: a triplet, and a swing of 1.5 or 2.6 to 1, which jazz has at fast and at slow
tempi (HUMANS, Timing: about (beat_ms - 100)/100)."""
SWUNG_COST = 3.0
"""What it costs that a turn's swing is none of 2:1, as named ratios cost a transcriber (`take_feel`)."""
CHANGE_COST, FINER_COST = 2.5, 1.0
"""Cost (a natural logarithm of odds) of going from straight cells to triplets or back between two beats, and of going
to finer or coarser cells of the same kind: about one beat in twelve, and one in three. Our choice."""
_STRAIGHT = np.array([division % 3 != 0 for division in DIVISIONS])


@dataclass(frozen=True, eq=False)
class PlayedCells:
    """`division` (b,) of each beat, and of each stroke (n,) its `beat`, its `cell` and how late it is (`late_s`)."""

    division: Ints
    beat: Ints
    cell: Ints
    late_s: Floats


def beat_spans(ground: Ground, bars: int) -> BeatSpans:
    """The counted beats of so many bars from tick 0 on; the last of a bar may be short."""
    bar, in_bar = np.divmod(np.arange(bars * ground.beats_a_bar, dtype=np.int64), ground.beats_a_bar)
    starts = bar * ground.bar_ticks + in_bar * ground.beat_ticks
    ends = np.minimum(starts + ground.beat_ticks, (bar + 1) * ground.bar_ticks)
    starts_s, ends_s = (ground.tempo_map.ns_at(ticks) / NS_PER_S for ticks in (starts, ends))
    is_ternary = np.full(len(bar), is_ternary_span(ground.beat_ticks, ground.meter))
    return BeatSpans(starts, ends, starts_s, ends_s, bar, in_bar, is_ternary)


def cells_played(times_s: Floats, piece: Ints, ground: Ground, bars: int) -> PlayedCells:
    """On which cells the strokes (n,) are, in order of time, from the first downbeat of `bars` bars.

    A bar more is read than was asked for: what is played on its downbeat is the landing.
    """
    spans = beat_spans(ground, bars + 1)
    strokes = _with_each_lean(times_s, piece, spans)
    cells, costs = _cuts(strokes)
    costs += _feel_costs(strokes, ground.feel)
    by_manner = costs.reshape(len(SWUNG_PLACES), len(LEANS_S), len(spans), len(DIVISIONS)).swapaxes(0, 1)
    (lean, swung), chosen = _cheapest_course(by_manner)
    own = slice(lean * len(piece), (lean + 1) * len(piece))  # the strokes as they are with that lean
    span, place, length_s = strokes.span[own] - lean * len(spans), strokes.place[own], strokes.length_s[own]
    cell = cells[swung, chosen[span], np.arange(own.start, own.stop)]
    division = np.array(DIVISIONS)[chosen]
    late_s = (place - cell / division[span]) * length_s + LEANS_S[lean]
    over = cell == division[span]  # the end of a beat is the next one's first cell
    beat, cell = span + over, np.where(over, 0, cell)
    division, cell = _coarsest(division, beat, cell)
    return PlayedCells(division, beat, cell, late_s)


def _coarsest(division: Ints, beat: Ints, cell: Ints) -> tuple[Ints, Ints]:
    """Divisions (b,) and cells (n,), halved where every second of six or eight cells is enough."""
    is_odd = np.bincount(beat, cell % 2, len(division)) > 0
    halved = (division > MOST_CELLS // 2) & ~is_odd
    return np.where(halved, division // 2, division), np.where(halved[beat], cell // 2, cell)


def _with_each_lean(times_s: Floats, piece: Ints, spans: BeatSpans) -> Strokes:
    """The strokes without each of `LEANS_S`, one take after the other on spans of its own: l times n on l times b."""
    span, place = spans.places(times_s - np.array(LEANS_S)[:, None])
    takes = np.arange(len(LEANS_S))[:, None]
    again = spans.only(np.tile(np.arange(len(spans)), len(LEANS_S)))
    return Strokes(again, (span + takes * len(spans)).ravel(), place.ravel(), np.tile(piece, len(LEANS_S)), SPREAD_S)


def _cuts(strokes: Strokes) -> tuple[Ints, Floats]:
    """Of each swing and division the cells of the strokes, (w, d, l·n), and what those cost each beat, (w, l·b, d)."""
    cells = np.zeros((len(SWUNG_PLACES), len(DIVISIONS), len(strokes.place)), np.int64)
    costs = np.full((len(SWUNG_PLACES), len(strokes.spans), len(DIVISIONS)), np.inf)
    is_ternary, length = bool(strokes.spans.is_ternary[0]), int(strokes.spans.lengths[0])
    for division in divisions_of(is_ternary, length, Swing()):
        if division.cells not in DIVISIONS:
            continue
        at = DIVISIONS.index(division.cells)
        if division.cells != 3 or is_ternary:  # these do not swing
            cells[:, at], costs[:, :, at] = _cut(strokes, division)
            continue
        for swing, swung in enumerate(SWUNG_PLACES):
            places = np.array([0.0, 1 / 3, swung, 1.0])
            cells[swing, at], costs[swing, :, at] = _cut(strokes, replace(division, places=places))
    return cells, costs


def _cut(strokes: Strokes, division: Division) -> tuple[Ints, Floats]:
    """The cells of the strokes where all beats are cut so, and what that costs each beat."""
    cell = nearest_cells(strokes, division.places)
    struck = np.zeros((len(strokes.spans), division.cells + 1), np.bool_)
    struck[strokes.span, cell] = True
    error = strokes.sums(strokes.error_cost(division.places[cell])) + collision_cost(strokes, cell)
    return cell, error + division.fine + struck[:, 1:-1] @ division.costs[1:-1]


def _feel_costs(strokes: Strokes, feel: Feel) -> Floats:
    """What each division (d,) costs each beat (l·b,) beside the ground's feel, which decides what is left open."""
    between = strokes.sums((np.abs(strokes.place - 0.5) < 0.5 - OFF_THE_BEAT).astype(np.float64)) > 0
    between.reshape(len(LEANS_S), -1)[:, 0] = True  # where nothing is played, it begins in the ground's feel
    cost: Floats = np.where((feel is Feel.STRAIGHT) == _STRAIGHT, 0.0, OTHER_FEEL_COST)
    return np.where(between[:, None], cost, 0.0)


def _cheapest_course(costs: Floats) -> tuple[tuple[int, int], Ints]:
    """Lean and swing of the cheapest course, and each beat's division in it, from (l, w, b, d) (Viterbi 1967)."""
    total, came = costs[:, :, 0], np.zeros(costs.shape, np.int64)
    for beat in range(1, costs.shape[2]):
        steps = total[..., None] + _CHANGES
        came[:, :, beat] = np.argmin(steps, axis=2)
        total = steps.min(axis=2) + costs[:, :, beat]
    whole = total.min(axis=2) + _MANNER_COSTS
    lean, swung = np.unravel_index(int(np.argmin(whole)), whole.shape)
    chosen = [int(np.argmin(total[lean, swung]))]
    for beat in range(costs.shape[2] - 1, 0, -1):
        chosen.append(int(came[lean, swung, beat, chosen[-1]]))
    return (int(lean), int(swung)), np.array(chosen[::-1])


def _changes() -> NDArray[np.float64]:
    differs = ~np.eye(len(DIVISIONS), dtype=np.bool_)
    of_kind = _STRAIGHT[:, None] != _STRAIGHT[None, :]
    return np.where(of_kind, CHANGE_COST, FINER_COST) * differs


_CHANGES = _changes()
_MANNER_COSTS = np.add.outer(
    [(lean_s / LEAN_SD_S) ** 2 / 2 for lean_s in LEANS_S],
    [SWUNG_COST if swung != SWUNG_PLACES[0] else 0.0 for swung in SWUNG_PLACES],
)
"""What each lean and swing (l, w) costs before a stroke is heard."""

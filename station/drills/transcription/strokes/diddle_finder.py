"""Diddles found among the strokes of a drum once they stand on cells: two quick strokes that share one cell.

Two strokes of one drum and one loudness, less than `QUICK_MS` apart, the first on a cell twice as long: two hands
seldom play singles so fast, and a book writes the one cell with a slash. An accent is the first one's alone. What is
slower stays single strokes, for nothing but the sticking would tell, and MIDI has none.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby, pairwise

from station.core.pieces import DRUMS, Articulation, Dynamic, Ornament, Zone
from station.core.units import NS_PER_MS
from station.drills.grid.stroke_settings import Velocities
from station.music.score import Note
from station.music.tempo import TempoMap

QUICK_MS = 90.0
"""Two hands that play singles as fast make 11 strokes a second, what the fastest of our single stroke lessons ask (95
ms); our doubles begin at 77 ms (our choice between them)."""


def with_diddles(
    notes: Sequence[Note], beyond: Sequence[Note], tempo_map: TempoMap, velocities: Velocities
) -> list[Note]:
    """The main strokes `notes`, in order of ticks, those of diddles by their ornament, of rolls where they touch.

    `beyond` are the strokes beyond the player, which need cells in the same lines.
    """
    found = list(notes)
    for piece in DRUMS & {n.piece for n in notes}:
        rows = [i for i, n in enumerate(notes) if n.piece is piece]
        cells = [n.tick for n in beyond if n.piece is piece]
        cells += [n.tick + n.duration_ticks for n in notes if n.piece is piece and n.duration_ticks]
        pairs = _pairs([notes[i] for i in rows], cells, tempo_map)
        spans = {notes[rows[a]].tick: 2 * (notes[rows[b]].tick - notes[rows[a]].tick) for a, b in pairs}
        ends = {start + span for start, span in spans.items()}
        for a, b in pairs:
            first, second = notes[rows[a]], notes[rows[b]]
            touches = first.tick in ends or first.tick + spans[first.tick] in spans
            ornament = Ornament.ROLL if touches else Ornament.DIDDLE
            dynamic = min(first.dynamic, Dynamic.NORMAL)
            found[rows[a]] = replace(first, ornament=ornament)
            velocity = velocities.of(piece, dynamic)
            found[rows[b]] = replace(second, ornament=ornament, dynamic=dynamic, velocity=velocity, limb=first.limb)
    return found


def _pairs(line: Sequence[Note], starts: Sequence[int], tempo_map: TempoMap) -> list[tuple[int, int]]:
    """Indices of the strokes of each diddle in one drum's line, beat by beat; cells begin at `starts` besides."""
    found: list[tuple[int, int]] = []
    for beat, rows in groupby(range(len(line)), key=lambda i: _beat_of(line[i], tempo_map)):
        in_beat = list(rows)
        pairs = [(a, b) for a, b in pairwise(in_beat) if _is_diddle(line[a], line[b], beat, tempo_map)]
        seconds = {b for _, b in pairs}
        cells = {2 * (line[b].tick - line[a].tick) for a, b in pairs}
        others = [line[i].tick for i in in_beat if i not in seconds]
        others += [tick for tick in starts if beat[0] <= tick < sum(beat)]
        if len(cells) == 1 and not any((tick - beat[0]) % max(cells) for tick in others):
            found += pairs
    return found


def _beat_of(note: Note, tempo_map: TempoMap) -> tuple[int, int]:
    """Start and length of the beat that the stroke is in."""
    meter = tempo_map.meter_at(note.tick)
    start = tempo_map.bar_start(int(tempo_map.bars_at(note.tick)))
    return note.tick - (note.tick - start) % meter.beat_ticks, meter.beat_ticks


def _is_diddle(first: Note, second: Note, beat: tuple[int, int], tempo_map: TempoMap) -> bool:
    """Whether two strokes of one drum are a diddle of a cell of the `beat`, its start and length."""
    gap = second.tick - first.tick
    gap_ns = int(tempo_map.ns_at(second.tick)) - int(tempo_map.ns_at(first.tick))
    if not 0 < gap_ns <= QUICK_MS * NS_PER_MS or not (_is_plain(first) and _is_plain(second)):
        return False
    if first.dynamic is not second.dynamic and (first.dynamic, second.dynamic) != (Dynamic.ACCENT, Dynamic.NORMAL):
        return False
    start, length = beat
    return length % (2 * gap) == 0 and (first.tick - start) % (2 * gap) == 0


def _is_plain(note: Note) -> bool:
    """Whether a diddle may be made of it; swung cells are no halves of longer ones."""
    return (
        note.ornament is Ornament.NONE
        and note.articulation is Articulation.NORMAL
        and note.zone is Zone.HEAD
        and not note.swing_ticks
    )

"""What an import tells the teacher: what was found and what was done, each in a sentence that says in which bars."""

from collections import Counter
from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, PPQ
from station.drills.grid.tab_symbols import BEYOND
from station.drills.lesson import Lesson
from station.drills.transcription.strokes.ornament_finder import BOUNCE_MS, FoundOrnaments
from station.drills.transcription.strokes.playable_strokes import Reach
from station.drills.transcription.timing.grid_times import GridTimes
from station.music.bar_numbers import named_bars
from station.music.score import Score
from station.music.swing import Swing

_STROKES_APART = 2
"""A bar that differs from a groove by no more strokes is that groove: one that fell out and one more, or one that moved
(our choice)."""
_LEAST_BARS = 4
"""So many bars at least are a groove, and a third of all (our choice)."""
_KINDS_TRIED = 64
"""Kinds of bars, the most frequent, each of which may be the groove (our choice)."""
_TIDIED_BPM = 0.05
"""A tempo that was only made readable differs less."""
_TOLD_MS = 0.5
"""What is less rounds to no millisecond."""


def remarks_on(
    ornaments: FoundOrnaments, times: GridTimes, mains: Score, reach: Reach, lesson: Lesson, steadied: int = 0
) -> Iterator[str]:
    """The remarks on a `lesson` made of the strokes `mains` of a file, `steadied` of which got another dynamic."""
    yield from _on_tempo(mains, lesson.score)
    yield from _on_meter(mains, lesson.score)
    if mains.loudness:
        yield f"loudness marks and hairpins left out: {_bars(mains, (mark.tick for mark in mains.loudness))}"
    yield from _on_times(times, mains)
    if steadied:
        yield f"{_counted(steadied, 'stroke')} made as loud as the others of their place in the groove"
    if times.spread_ms:
        yield from _on_groove(lesson.score)
    if lesson.is_swung:
        yield f"swing {lesson.swing.ratio:.3g}:1 of {_unit(lesson.swing)}"
    found = {"flam": ornaments.flams, "drag": ornaments.drags, "buzz": ornaments.buzzes}
    if any(found.values()):
        yield f"found {', '.join(_counted(count, name) for name, count in found.items() if count)}"
    if ornaments.bounces:
        yield (
            f"{_counted(ornaments.bounces, 'stroke')} left out that only doubled another: "
            f"of the same drum, at the same moment or far softer within {BOUNCE_MS:g} ms"
        )
    if reach.merged:
        yield f"{_counted(reach.merged, 'stroke')} fell into one cell with a louder one"
    if reach.plain:
        bars = _bars(lesson.score, (note.tick for note in reach.plain))
        yield f"{_counted(len(reach.plain), 'ornament')} without grace strokes, for which no hand is free: {bars}"
    if reach.beyond:
        bars = _bars(lesson.score, lesson.beyond["tick"])
        yield f"{_counted(len(reach.beyond), 'stroke')} beyond two hands and two feet, written {BEYOND}: {bars}"


def _on_meter(before: Score, after: Score) -> Iterator[str]:
    old, new = before.tempo_map.meters, after.tempo_map.meters
    if len(old) == len(new) == 1 and (old[0].beats, old[0].unit) != (new[0].beats, new[0].unit):
        yield f"no meter in it: heard as {new[0]}"


def _on_tempo(before: Score, after: Score) -> Iterator[str]:
    """A lesson's tempo changes at bar lines, and not for what only wanders."""
    old, new = before.tempo_map, after.tempo_map
    within = any(change.tick != old.bar_start(int(old.bars_at(change.tick))) for change in old.tempos)
    if len(old.tempos) == len(new.tempos) == 1 and abs(old.tempos[0].tempo_bpm - new.tempos[0].tempo_bpm) > _TIDIED_BPM:
        yield f"no tempo in it: played at {new.tempos[0].tempo_bpm:.4g}"
    if within or len(new.tempos) < len(old.tempos):
        changes = len(new.tempos) - 1
        said = f"{changes} at bar lines" if changes else f"one tempo, {new.tempos[0].tempo_bpm:.4g}"
        yield f"{_counted(len(old.tempos) - 1, 'change')} of tempo written as {said}"


def _on_times(times: GridTimes, mains: Score) -> Iterator[str]:
    moved = _shifts_ms(times, mains)
    if (farthest := moved.max(initial=0.0)) >= _TOLD_MS:
        side = "late" if times.lean_ms > 0 else "early"
        lean = f", the take as a whole {abs(times.lean_ms):.0f} ms {side}" if abs(times.lean_ms) >= _TOLD_MS else ""
        count = int(np.count_nonzero(moved >= _TOLD_MS))
        yield f"{_counted(count, 'stroke')} moved onto the grid, by at most {farthest:.0f} ms{lean}"


def _shifts_ms(times: GridTimes, mains: Score) -> NDArray[np.float64]:
    """How far each stroke moved; from the end to the start of the music is no way.

    A take moved in time. What was on the grid moved in the music, at the lesson's tempo: its changes may lie elsewhere.
    """
    tempo_map = times.score.tempo_map
    before = (mains.tempo_map if times.spread_ms else tempo_map).ns_at(mains.notes["tick"][times.origin])
    by = np.abs(before - tempo_map.ns_at(times.score.notes["tick"]))
    return np.asarray(np.minimum(by, np.abs(mains.length_ns - by)) / NS_PER_MS)


def _on_groove(score: Score) -> Iterator[str]:
    """Which bars of a take are one groove: nobody plays a bar twice alike, so the page cannot show it."""
    bars = _strokes_by_bar(score)
    kinds = [kind for kind, _ in Counter(filter(None, bars)).most_common(_KINDS_TRIED)]
    groups = [[i for i, bar in enumerate(bars) if len(bar ^ kind) <= _STROKES_APART] for kind in kinds]
    groove = max(groups, key=len, default=[])
    if len(groove) < max(_LEAST_BARS, len(bars) // 3):
        return
    model = bars.index(kinds[groups.index(groove)])
    others = [bar for bar in range(len(bars)) if bar not in set(groove)]
    apart = f"; not {named_bars(others)}" if others else ""
    yield f"one groove: {named_bars(groove)} play bar {model + 1}, but for {_STROKES_APART} strokes at most{apart}"


def _strokes_by_bar(score: Score) -> list[frozenset[tuple[int, int]]]:
    """Piece and tick of each main stroke, from the start of its bar."""
    found: list[set[tuple[int, int]]] = [set() for _ in range(score.bar_count)]
    starts = [score.tempo_map.bar_start(bar) for bar in range(score.bar_count)]
    mains = score.notes[~score.is_grace]
    for bar, tick, piece in zip(
        score.bar[~score.is_grace].tolist(), mains["tick"].tolist(), mains["piece"].tolist(), strict=True
    ):
        found[bar].add((piece, tick - starts[bar]))
    return list(map(frozenset, found))


def _unit(swing: Swing) -> str:
    named = {PPQ // 2: "eighths", PPQ // 4: "sixteenths", PPQ // 8: "thirty-seconds"}
    return named.get(swing.unit_ticks, f"{swing.unit_ticks / PPQ:g} of a quarter note")


def _bars(score: Score, ticks: Iterable[int]) -> str:
    """The bars in which these moments are."""
    return named_bars(score.tempo_map.bars_at(np.array(list(ticks), np.int64)).tolist())


def _counted(count: int, noun: str) -> str:
    """The count and the noun, "1 flam" or "2 buzzes"."""
    return f"{count} {noun}{'' if count == 1 else 'es' if noun.endswith('z') else 's'}"

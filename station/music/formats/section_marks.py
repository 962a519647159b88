"""Sections from marks at moments, as charts and MIDI files have them: a mark says what begins, not where it ends."""

from collections.abc import Iterable

from station.music.drum_part import PartSection
from station.music.score import Score
from station.music.tempo import TempoMap


def sections_from_marks(marks: Iterable[tuple[int, str]], score: Score) -> tuple[PartSection, ...]:
    """Of marks (tick, name) each from the bar nearest to it to the next; of several at a bar the nearest counts.

    A mark without a name ends the section before it.
    """
    placed = [(*_nearest_bar(score.tempo_map, tick), name) for tick, name in marks]
    names: dict[int, str] = {}
    for bar, _, name in sorted(placed, key=lambda mark: mark[1]):
        names.setdefault(bar, name)
    firsts = sorted(bar for bar in names if bar < score.bar_count)
    ends = [*firsts[1:], score.bar_count]
    return tuple(PartSection(names[a], a, b - 1) for a, b in zip(firsts, ends, strict=False) if names[a])


def _nearest_bar(tempo_map: TempoMap, tick: int) -> tuple[int, int]:
    """The bar that begins nearest to `tick`, and how far away."""
    bar = int(tempo_map.bars_at(tick))
    return min((abs(tick - tempo_map.bar_start(near)), near) for near in (bar, bar + 1))[::-1]

"""Which beams a group of notes has: how far each reaches, where the inner ones break, and which way stubs point.

After Gould, "Behind Bars" (2011), on beaming: the outer beam joins the group; beams of thirty-seconds and shorter break
at the eighth, those of two tuplets between them; a stub points to the note with which it fills a step.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from station.core.units import PPQ
from station.render.notation.spelling.note_values import BeatGroup


@dataclass(frozen=True, slots=True)
class BeamSpan:
    """A beam on `level` (0 the outermost) over notes `first` to `last` of a group.

    `stub` is −1 or 1 where it is broken off at its only note, to the left or the right; else 0.
    """

    level: int
    first: int
    last: int
    stub: int = 0


def beam_runs(group: BeatGroup) -> list[tuple[int, int]]:
    """First and last of the group's notes that one beam joins; a note that keeps its flags is both."""
    return list(_spans([value.value.beams > 0 for value in group.strokes], 0))


def beam_spans(group: BeatGroup) -> Iterator[BeamSpan]:
    """All beams of a group."""
    for first, last in beam_runs(group):
        if first < last:
            yield from _levels(group, first, last)


def _levels(group: BeatGroup, first: int, last: int) -> Iterator[BeamSpan]:
    beams = [group.strokes[k].value.beams for k in range(first, last + 1)]
    for level in range(max(beams)):
        cuts = [k for k in range(first + 1, last + 1) if level and _breaks(group, k, level)]
        for begin, end in pairwise([first, *cuts, last + 1]):
            reaches = [group.strokes[k].value.beams > level for k in range(begin, end)]
            for a, b in _spans(reaches, begin):
                yield BeamSpan(level, a, b, 0 if a < b else _way(group, a, (first, last), (begin, end - 1)))


def _breaks(group: BeatGroup, k: int, level: int) -> bool:
    """Whether an inner beam breaks before note `k`."""
    tick = group.strokes[k].tick
    if any(abs(tick - tuplet.start) <= 1 for tuplet in group.tuplets):
        return True
    is_counted = any(tuplet.start <= tick < tuplet.end for tuplet in group.tuplets)
    eighth = PPQ // 2
    finest = max(value.value.base for value in group.strokes)
    return not is_counted and finest >= 32 and abs((tick - group.start + 1) % eighth - 1) <= 1


def _way(group: BeatGroup, k: int, run: tuple[int, int], part: tuple[int, int]) -> int:
    """Which way a stub points: within its part of the beam, and there to the note that it fills a step with."""
    if k == run[0] or (k == part[0] != part[1]):
        return 1
    if k == run[1] or k == part[1]:
        return -1
    value = group.strokes[k]
    step = round((value.tick - group.start) / float(group.time_of(value)))
    return -1 if step % 2 else 1


def _spans(flags: Sequence[bool], offset: int) -> Iterator[tuple[int, int]]:
    """First and last index of every run of True, counted from `offset`."""
    start: int | None = None
    for i, flag in enumerate([*flags, False]):
        if flag and start is None:
            start = i
        elif not flag and start is not None:
            yield offset + start, offset + i - 1
            start = None

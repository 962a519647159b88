"""The lines of a page: which bars stand on each, and which lines are seen at a time.

Two lines stand below each other. The play line crosses one while the other shows what comes after it: at a line's end
the eye goes where the music has stood all along. Where a line was played, the one after the next takes its place, but
its end stays for a moment longer, for the marks on its last strokes come late. Pure: no window, no OpenGL.
"""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil

import numpy as np

from station.core.units import PPQ
from station.music.score import Score
from station.render.snapshot import BarNumbers

ROWS = 2
"""Lines that are seen at once: the one that is played and the next (our choice: the fewer, the larger)."""
LEAST_BARS, MOST_BARS = 2, 4
"""Bars on a line (our choice: a phrase); with two on the next one, two bars are ahead even where this one ends."""
READABLE_APART = 3.0
"""Staff spaces between strokes from which a line holds more than two bars (our choice: two heads and a half)."""
CLOSEST_APART = 1.3
"""And at the least, where two bars would need more room than there is: a head and a tenth of one."""
_CLOSER = 0.1
"""How many of the strokes may stand closer (our choice)."""
LEAST_LINE_S = 4.0
"""Short loops come again on one line until it lasts so long (our choice: at 240 a minute four bars, not two)."""
KEPT_SHARE = 0.28
"""So much of a line's end stays when the play line has left it (our choice: a bar of four, half a bar of two)."""
KEPT_S, _KEPT_OF_LINE = 1.0, 0.3
"""And for so long, or this part of the next line where that is short; verdicts come within a quarter of a second."""


@dataclass(frozen=True, slots=True)
class ScoreLine:
    """Bars that stand on one line: `first` to `after`, from 0, from when until when, and their share of the width."""

    first: int
    after: int
    start_s: float
    end_s: float
    share: float


@dataclass(frozen=True, slots=True)
class ShownLine:
    """A line that is seen: on which `row` of the page, and between which shares of its own width.

    `is_played`: the play line is on it. `is_again`: it is to be played once more, and bears no marks yet.
    """

    line: ScoreLine
    row: int
    is_played: bool = False
    left: float = 0.0
    right: float = 1.0
    is_again: bool = False


def _gap_ticks(score: Score) -> float:
    """From a stroke to the next in the score's denser places, a beat where there are not two strokes."""
    gaps = np.diff(np.unique(score.notes["tick"][~score.is_grace]))
    return float(np.quantile(gaps, _CLOSER)) if len(gaps) else float(PPQ)


def _longest_ticks(score: Score, bars: int) -> int:
    """How long so many bars in a row are at the most."""
    tempo_map, count = score.tempo_map, max(score.bar_count, bars)
    starts = [tempo_map.bar_start(bar) for bar in range(count + 1)]
    return max(end - start for start, end in zip(starts, starts[bars:], strict=False))


def line_spaces(score: Score) -> float:
    """Staff spaces without which `LEAST_BARS` bars do not stand on a line."""
    return _longest_ticks(score, LEAST_BARS) / _gap_ticks(score) * CLOSEST_APART


def score_lines(score: Score, numbers: BarNumbers, spaces: float) -> tuple[ScoreLine, ...]:
    """The lines of `score`, each `spaces` staff spaces wide at the most; a line begins where a pass or section does."""
    starts = [score.tempo_map.bar_start(bar) for bar in range(score.bar_count + 1)]
    starts_s = [float(s) for s in score.tempo_map.seconds_at(starts)]
    fitting = spaces / (_longest_ticks(score, 1) / _gap_ticks(score) * READABLE_APART)
    most = min(max(int(fitting), LEAST_BARS), MOST_BARS)
    edges = _edges(score.bar_count, numbers, most, starts_s)
    longest = max((starts[after] - starts[first] for first, after in edges), default=1)
    return tuple(
        ScoreLine(first, after, starts_s[first], starts_s[after], (starts[after] - starts[first]) / longest)
        for first, after in edges
    )


def _edges(bars: int, numbers: BarNumbers, most: int, starts_s: Sequence[float]) -> list[tuple[int, int]]:
    """First bar and bar after the last of each line."""
    loop = min(numbers.per_pass or bars, bars)
    if not loop:
        return []
    passes = bars // loop if numbers.passes is None else min(numbers.passes, bars // loop)
    times = 1
    while 2 * times * loop <= most and (loop * times < LEAST_BARS or starts_s[min(times * loop, bars)] < LEAST_LINE_S):
        times *= 2
    found: list[tuple[int, int]] = []
    unit = loop * times
    for start in range(0, passes * loop, unit):
        end = min(start + unit, passes * loop)
        found += _of_pass(start, end, [start + bar for bar, _ in numbers.sections], most)
    if passes * loop < bars:
        found += _of_pass(passes * loop, bars, [], most)
    return found


def _of_pass(start: int, end: int, sections: Sequence[int], most: int) -> list[tuple[int, int]]:
    """The lines of bars that belong together: alike long, none of a single bar where there are more."""
    edges = [start]
    for bar in sorted(sections):
        if edges[-1] + LEAST_BARS <= bar <= end - LEAST_BARS:
            edges.append(bar)
    edges.append(end)
    found: list[tuple[int, int]] = []
    for first, after in pairwise(edges):
        count = after - first
        lines = ceil(count / most)
        if count // lines < LEAST_BARS:
            lines = max(count // LEAST_BARS, 1)
        cuts = [first + count * k // lines for k in range(lines + 1)]
        found += pairwise(cuts)
    return found


def rows_of(lines: Sequence[ScoreLine], comes_again: bool, lines_before: int) -> int:
    """On how many rows the page of such lines stands: a single line has it for itself."""
    return ROWS if len(lines) > 1 or comes_again or lines_before else 1


def shown_lines(
    lines: Sequence[ScoreLine], position_s: float, comes_again: bool = False, lines_before: int = 0
) -> list[ShownLine]:
    """What is seen at a time of the score, the line that is played first.

    `comes_again`: after the last line comes the first. `lines_before` were shown of what was played before.
    """
    if not lines:
        return []
    rows = rows_of(lines, comes_again, lines_before)
    k = max(bisect_right([line.start_s for line in lines], position_s) - 1, 0)
    row = (k + lines_before) % rows
    played = ShownLine(lines[k], row, is_played=True)
    if rows == 1:
        return [played]
    other = 1 - row
    before = lines[k - 1] if k else None
    if k + 1 < len(lines) or comes_again:
        is_again = k + 1 == len(lines)
        coming = lines[0] if is_again else lines[k + 1]
        kept_s = min(KEPT_S, _KEPT_OF_LINE * (lines[k].end_s - lines[k].start_s))
        if before is None or position_s - lines[k].start_s >= kept_s:
            return [played, ShownLine(coming, other, is_again=is_again)]
        seam = (1 - KEPT_SHARE) * before.share
        return [
            played,
            ShownLine(coming, other, right=min(seam / coming.share, 1.0), is_again=is_again),
            ShownLine(before, other, left=1 - KEPT_SHARE),
        ]
    return [played] if before is None else [played, ShownLine(before, other)]

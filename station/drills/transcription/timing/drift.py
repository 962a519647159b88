"""Takes without a click: how their beat wanders off the tempo that the file says, and the take with that removed.

A line is laid through the errors of a few strokes at a time, and says where the next are expected: a tracking filter of
second order (alpha-beta; Benedict & Bordner 1962), for the beat of a player who has no click walks while the tempo
holds. Afterwards the points are smoothed from both sides. The result counts only where it explains the take much
better than a constant lean does.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from math import ceil

import numpy as np

from station.drills.transcription.timing.beat_spans import Floats
from station.drills.transcription.timing.take_feel import Feel, Take, clipped_errors, cost_of, settled

STROKES = 10
"""As many make a point of the drift: their mean is known to a third of their spread."""
_MOST_POINTS = 300
"""Of a take of more than 3000 strokes each point has more of them: what it costs, a beat read for each point, must not
grow without end (our choice)."""
FIRST_STROKES = 40
"""As many decide where the beat begins, and how fast."""
LEAST_STROKES = 20
"""Fewer do not tell a tempo from a lean (our choice)."""
_NUMBERS_OF_A_LINE = 2
_LEANS_S = tuple(ms / 1000 for ms in range(-40, 41, 10))
_SLOPES = (-0.02, -0.015, -0.01, -0.005, 0.0, 0.005, 0.01, 0.015, 0.02)
"""Tempo errors to begin with, as a share; HUMANS, Timing: professionals without a click keep it to 2 %."""
ALPHA, BETA = 0.7, 0.25
"""Gains of the filter: Benedict & Bordner's beta is alpha squared by 2 minus alpha, 0.38; less, as errors of meaning
must not run away with the tempo."""
_COST_OF_A_POINT = 2.0
"""What each point of the drift must gain: it is a number fitted to the strokes (our choice, above Akaike's 1)."""
_SMOOTHED_OVER = 7
"""Points on a local line."""


@dataclass(frozen=True, slots=True)
class _Line:
    """Late by `late_s` at `at_s`, and by `slope` seconds more each second."""

    at_s: float
    late_s: float
    slope: float

    def late(self, times_s: Floats) -> Floats:
        """How late it is at those times."""
        return self.late_s + self.slope * (times_s - self.at_s)


def steadied(take: Take, feel: Feel) -> Take | None:
    """The take with its drift removed; None where the constant lean of `feel` explains it as well."""
    if len(take.piece) < LEAST_STROKES:
        return None
    rivals = [(_straight(take, feel).late(take.times_s), _NUMBERS_OF_A_LINE)]
    if len(take.piece) >= FIRST_STROKES:
        points = np.array(list(_points(take, feel)))
        rivals.append((_smooth(points[:, 0], points[:, 1], take.times_s), len(points)))
    cost, steady = min((_cost(take, feel, late, fitted) for late, fitted in rivals), key=lambda rival: rival[0])
    return steady if cost < cost_of(take, feel) else None


def _cost(take: Take, feel: Feel, late_s: Floats, fitted: int) -> tuple[float, Take]:
    """What the take costs with its drift `late_s` (n,) removed, into which so many numbers were fitted."""
    steady = replace(take, times_s=take.times_s - late_s)
    then = settled(steady, settled(steady, replace(feel, lean_s=0.0)))
    return cost_of(steady, then) + _COST_OF_A_POINT * fitted, steady


def _straight(take: Take, feel: Feel) -> _Line:
    """The line of a take whose tempo is steady but another than its file says: fitted to ever more of its strokes."""
    line, flat = _begin(take, feel), replace(feel, lean_s=0.0)
    count = FIRST_STROKES
    while True:
        some = take.first(count)
        here = replace(some, times_s=some.times_s - line.late(some.times_s))
        errors = clipped_errors(here.errors_s(flat, here.read(flat)), feel.spread_s)
        slope, late = np.polyfit(some.times_s - line.at_s, errors, 1)
        line = replace(line, late_s=line.late_s + float(late), slope=line.slope + float(slope))
        if count >= len(take.piece):
            return line
        count = count * 3 // 2


def _points(take: Take, feel: Feel) -> Iterator[tuple[float, float]]:
    """Where the take's beat is: time, and how late it then is, by `STROKES` strokes or more each."""
    line = _begin(take, feel)
    count = max(STROKES, ceil(len(take.piece) / _MOST_POINTS))
    for start in range(0, len(take.piece), count):
        some = slice(start, start + count)
        times_s = take.times_s[some]
        middle = float(times_s.mean())
        error = _error(take, some, line, feel)
        late = float(line.late(np.array(middle))) + error
        yield middle, late
        passed = max(middle - line.at_s, float(np.ptp(times_s)) / 2, 1e-3)
        line = _Line(middle, late - (1 - ALPHA) * error, line.slope + BETA * error / passed)


def _begin(take: Take, feel: Feel) -> _Line:
    """The line on which the first strokes cost least."""
    start = float(take.times_s[0])
    lines = [_Line(start, lean, slope) for lean, slope in product(_LEANS_S, _SLOPES)]
    first = take.first(FIRST_STROKES)

    def cost(line: _Line) -> float:
        here = replace(first, times_s=first.times_s - line.late(first.times_s))
        return here.read(replace(feel, lean_s=0.0)).cost + abs(line.slope) / 0.01 + (line.late_s / 0.02) ** 2 / 2

    return min(lines, key=cost)


def _error(take: Take, some: slice, line: _Line, feel: Feel) -> float:
    """The mean error of some strokes about the line."""
    times_s = take.times_s[some]
    here = replace(take, times_s=times_s - line.late(times_s), piece=take.piece[some])
    flat = replace(feel, lean_s=0.0)
    return float(clipped_errors(here.errors_s(flat, here.read(flat)), feel.spread_s).mean())


def _smooth(at_s: Floats, late_s: Floats, times_s: Floats) -> Floats:
    """The points smoothed by lines through a few neighbours each, at `times_s`."""
    if len(at_s) < 2:
        return np.full(len(times_s), late_s.mean())
    smooth = np.empty(len(at_s))
    for i, at in enumerate(at_s):
        first = min(max(i - _SMOOTHED_OVER // 2, 0), max(len(at_s) - _SMOOTHED_OVER, 0))
        some = slice(first, first + _SMOOTHED_OVER)
        smooth[i] = np.polyval(np.polyfit(at_s[some] - at, late_s[some], 1), 0.0)
    inner = np.interp(times_s, at_s, smooth)
    ends = [(times_s < at_s[0], 0, 1), (times_s > at_s[-1], -2, -1)]
    for beyond, a, b in ends:
        slope = (smooth[b] - smooth[a]) / (at_s[b] - at_s[a])
        near = 0 if a == 0 else -1
        inner[beyond] = smooth[near] + slope * (times_s[beyond] - at_s[near])
    return inner

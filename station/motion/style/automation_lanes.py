"""Lanes of automation as the user draws them: points (bar, value) of a control, in rising order of bars.

Bars count from 1 and a fraction is a place within the bar. A score that plays the same bars again and again, or begins
in the middle of a lesson, needs the lesson's lanes laid over its own bars: `in_passes`.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from station.core.pieces import Piece, word
from station.motion.style.style import NATURAL, NUMBERS, Automation, Style

SEAM_BARS = 1e-3
"""So long before a pass ends stands its last point: the next pass begins with another value (our choice: unseen)."""
CHANGE_BARS = 0.5
"""So long a style takes to become another one (our choice: two beats, as a player settles into a new part)."""
NEAREST_BARS = 0.02
"""Points of a lane are no nearer to one another (our choice: less than a hundredth of a second)."""


def value_at(lane: Automation, bar: float) -> float:
    """What the lane says at `bar`: straight between points, level beyond the first and the last."""
    bars, values = np.array(lane, np.float64).T
    return float(np.interp(bar, bars, values))


def with_point(lane: Automation, bar: float, value: float) -> Automation:
    """The lane with a point more; it takes the place of those that are nearer than `NEAREST_BARS`."""
    kept = [point for point in lane if abs(point[0] - bar) >= NEAREST_BARS]
    return tuple(sorted([*kept, (bar, value)]))


def without_point(lane: Automation, index: int) -> Automation:
    """The lane without one of its points."""
    return (*lane[:index], *lane[index + 1 :])


def with_moved(lane: Automation, index: int, bar: float, value: float) -> Automation:
    """The lane with one of its points elsewhere, though never past its neighbours."""
    low = lane[index - 1][0] + NEAREST_BARS if index else 1.0
    high = lane[index + 1][0] - NEAREST_BARS if index + 1 < len(lane) else np.inf
    return (*lane[:index], (float(min(max(bar, low), high)), value), *lane[index + 1 :])


def drawn(lane: Automation, stroke: Iterable[tuple[float, float]]) -> Automation:
    """The lane with `stroke`, points that were drawn by hand in any order, instead of what it had from end to end."""
    points = dict(stroke)  # what was drawn last on a place counts
    if not points:
        return lane
    first, last = min(points) - NEAREST_BARS, max(points) + NEAREST_BARS
    return tuple(sorted([*(point for point in lane if not first < point[0] < last), *points.items()]))


def in_turn(style: Style, changes: Sequence[tuple[float, Style]]) -> Style:
    """`style`, and from each of the bars in `changes`, rising and from 1, another one.

    Numbers, also those of pieces, change evenly over `CHANGE_BARS` from there on, so that no stick and no joint jumps.
    What the hands hold and everything else that is a word stays as `style` has it: nobody changes a grip at a bar line.
    """
    if not changes:
        return style
    styles = list(dict([(1.0, style), *changes]).items())  # one that begins with the first bar is there at once
    pieces = {word(piece): piece for _, one in styles for piece in one.own_pieces}
    names = [name for name in (*NUMBERS, *pieces) if _differs([style, *(one for _, one in styles)], name, pieces)]
    return replace(style, automation={name: _joined(styles, name, pieces) for name in names})


def _differs(styles: Sequence[Style], name: str, pieces: Mapping[str, Piece]) -> bool:
    """Whether a control changes anywhere."""
    return any(name in one.automation for one in styles) or len({_constant(one, name, pieces) for one in styles}) > 1


def _constant(style: Style, name: str, pieces: Mapping[str, Piece]) -> float:
    """What a control, or a piece's amplitude, is where no lane says otherwise."""
    return style.pieces.get(pieces[name], NATURAL) if name in pieces else float(getattr(style, name))


def _joined(styles: Sequence[tuple[float, Style]], name: str, pieces: Mapping[str, Piece]) -> Automation:
    """The lane of a control through all styles in turn."""
    lanes = [one.automation.get(name, ((1.0, _constant(one, name, pieces)),)) for _, one in styles]
    starts = [bar for bar, _ in styles]
    joined: list[tuple[float, float]] = []
    for lane, start, end in zip(lanes, starts, [*starts[1:], np.inf], strict=True):
        begin = min(start + CHANGE_BARS, end) if joined else start
        inside = [(bar, value) for bar, value in lane if begin < bar < end]
        last = [] if np.isinf(end) else [(end, value_at(lane, end))]
        joined += [(begin, value_at(lane, begin)), *inside, *last]
    return tuple(sorted(dict(joined).items()))


def in_passes(style: Style, first_bar: int, bar_count: int, passes: int) -> Style:
    """`style` for a score of `passes` times the bars that begin with the lesson's bar `first_bar`, from 0."""
    if not style.automation:
        return style
    lanes = {name: _repeated(lane, first_bar + 1.0, bar_count, passes) for name, lane in style.automation.items()}
    return replace(style, automation=lanes)


def _repeated(lane: Automation, start: float, length: int, times: int) -> Automation:
    end = start + length
    within = [point for point in lane if start + SEAM_BARS < point[0] < end - 2 * SEAM_BARS]
    one = [(start, value_at(lane, start)), *within, (end - SEAM_BARS, value_at(lane, end - SEAM_BARS))]
    return tuple((bar - start + 1.0 + pass_ * length, value) for pass_ in range(times) for bar, value in one)

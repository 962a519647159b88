"""Swing as books write it: straight cells under a mark, which says how two of them are played.

Two beamed eighths (or sixteenths) equal a triplet of a long and a short note; a ratio that is no triplet is said in
words beside the pair. Strokes carry how much later than written they are played (`swing_ticks`). Units of what is
drawn are staff spaces, y down.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music import swing
from station.music.score import Score
from station.render.text.draw_list import Colour, DrawList, TypeStyle
from station.render.text.fonts import Face
from station.render.text.sign_outlines import sign_box

_SAME = 0.02
"""Ratios closer than this are one: ticks are rounded, and imports by more (our choice)."""
_SCALE = 0.34
"""A staff space of the mark's notes in em of its letters: heads are as high as small ones (our choice)."""
_BETWEEN, _STEM_HEIGHT, _STEM_WIDTH = 1.9, 3.1, 0.13
_BEAM, _BEAM_STEP, _STUB = 0.5, 0.78, 1.0
_BRACKET_Y, _HOOK, _LINE, _FIGURE = 4.2, 0.5, 0.14, 1.9
"""From one note of a pair to the next, and the measures of `beams`, in spaces of the mark; its bracket's height."""
_GAP = 0.4
"""Beside the equals sign, in em (our choice)."""


@dataclass(frozen=True, slots=True)
class SwingMark:
    """From here on two cells of `unit_ticks` are played `ratio` : 1; a ratio of 1 is straight."""

    ratio: float
    unit_ticks: int = PPQ // 2

    @property
    def is_straight(self) -> bool:
        """Whether it ends a swing."""
        return abs(self.ratio - swing.STRAIGHT) < _SAME

    def is_as(self, other: "SwingMark") -> bool:
        """Whether both say the same."""
        return abs(self.ratio - other.ratio) < _SAME and (self.is_straight or self.unit_ticks == other.unit_ticks)


STRAIGHT = SwingMark(swing.STRAIGHT)


def swing_marks(score: Score) -> dict[int, SwingMark]:
    """The mark over each bar, from 0, from which on another feel holds than before; straight at first.

    The first mark stands at the beginning, where nothing straight comes before what swings.
    """
    found: dict[int, SwingMark] = {}
    if not score.notes["swing_ticks"].any():
        return found
    holds, late, before = STRAIGHT, set[int](), set[int]()
    for bar, cells, mark, swung in _bars(score):
        if mark is not None and not mark.is_as(holds):
            first = bar if found or before & swung else 0
            found[first], holds, late = mark, mark, set()
        elif not holds.is_straight and mark is None and late & cells:
            found[bar], holds, late = STRAIGHT, STRAIGHT, set()
        late |= swung
        before |= cells
    return found


def _bars(score: Score) -> Iterator[tuple[int, set[int], SwingMark | None, set[int]]]:
    """Each bar with strokes: where in their beats those are written, the swing that it has, and where it has it."""
    bars, firsts = np.unique(score.bar, return_index=True)
    whole = _unit(score.notes, _cells(score, score.notes))
    for bar, rows in zip(bars.tolist(), np.split(score.notes, firsts[1:]), strict=True):
        cells = _cells(score, rows)
        is_swung = rows["swing_ticks"] > 0
        mark = None
        if is_swung.any():
            unit = _unit(rows, cells) or whole or PPQ // 2
            mark = SwingMark(_ratio(cells[is_swung], rows["swing_ticks"][is_swung], unit), unit)
        yield bar, set(cells.tolist()), mark, set(cells[is_swung].tolist())


def _cells(score: Score, rows: NDArray[np.void]) -> NDArray[np.int64]:
    """Where in its beat each stroke is written, in ticks; pairs of cells begin with the beats of the bar."""
    written = rows["tick"] - rows["swing_ticks"]
    starts = np.array([score.tempo_map.bar_start(int(bar)) for bar in score.tempo_map.bars_at(written)], np.int64)
    cells: NDArray[np.int64] = (written - starts) % PPQ
    return cells


def _unit(rows: NDArray[np.void], cells: NDArray[np.int64]) -> int | None:
    """The cell that swings: eighths where the half beat is late, sixteenths where it is not; None where none tells."""
    late = set(cells[rows["swing_ticks"] > 0].tolist())
    if PPQ // 2 in late:
        return PPQ // 2
    return PPQ // 4 if late & {PPQ // 4, 3 * PPQ // 4} and PPQ // 2 in set(cells.tolist()) else None


def _ratio(cells: NDArray[np.int64], late: NDArray[np.int64], unit: int) -> float:
    """Long to short, from the strokes that are latest for where they are written."""
    inside = cells % (2 * unit)
    inside = np.where(inside == 0, unit, inside)
    first = inside <= unit
    share = np.where(first, (inside + late) / (2 * inside), 1 - (2 * unit - inside - late) / (2 * (2 * unit - inside)))
    long = float(np.median(share[inside == unit] if (inside == unit).any() else share))
    return round(long / max(1 - long, 1e-3), 3)


# --- drawing ----------------------------------------------------------------------------------------------------------


def draw_swing_mark(
    draw_list: DrawList, at: tuple[float, float], size: float, mark: SwingMark, colour: Colour
) -> float:
    """The mark from `at` on, which is on its line, as large as letters of `size` em; returns how long it is."""
    style = TypeStyle(size, colour, Face.BOLD)
    (x, y), gap = at, _GAP * size
    if mark.is_straight:
        return draw_list.text("straight", at, style)
    levels = 1 if mark.unit_ticks >= PPQ // 2 else 2
    x += _pair(draw_list, at, _SCALE * size, (levels, levels), colour) + gap
    if abs(mark.ratio - swing.TRIPLETS) >= _SAME:
        return x + draw_list.text(f"swing {mark.ratio:.3g} : 1", (x, y), style) - at[0]
    x += draw_list.text("=", (x, y), style) + gap
    return x + _triplet(draw_list, (x, y), _SCALE * size, levels, colour) - at[0]


def _pair(draw_list: DrawList, at: tuple[float, float], space: float, levels: tuple[int, int], colour: Colour) -> float:
    """Two notes with so many beams each, the fewer on both; returns how long they are."""
    (left, base), half = at, sign_box("head_round").width / 2 * space
    top = base - _STEM_HEIGHT * space
    for k in (0, 1):
        stem_x = _stemmed(draw_list, (left + k * _BETWEEN * space, base), space, colour)
    first = stem_x - (_BETWEEN + _STEM_WIDTH / 2) * space
    for level in range(max(levels)):
        is_whole = level < min(levels)
        length = ((_BETWEEN if is_whole else _STUB) + _STEM_WIDTH) * space
        begin = first if is_whole else first + (_BETWEEN - _STUB) * space
        draw_list.box((begin, top + level * _BEAM_STEP * space), (length, _BEAM * space), colour)
    return 2 * half + _BETWEEN * space


def _stemmed(draw_list: DrawList, at: tuple[float, float], space: float, colour: Colour) -> float:
    """A head whose left end stands on the line at `at`, and its stem; returns where that is."""
    box = sign_box("head_round")
    x, y = at[0] + box.width / 2 * space, at[1] - box.height / 2 * space
    stem_x = x + (box.width - _STEM_WIDTH) / 2 * space
    draw_list.sign("head_round", (x, y), colour, space)
    draw_list.line((stem_x, y), (stem_x, at[1] - _STEM_HEIGHT * space), _STEM_WIDTH * space, colour)
    return stem_x


def _triplet(draw_list: DrawList, at: tuple[float, float], space: float, levels: int, colour: Colour) -> float:
    """A long and a short note under a bracket with its three; returns how long it is."""
    (left, base), x = at, at[0]
    if levels > 1:
        x += _pair(draw_list, at, space, (levels - 1, levels), colour)
    else:
        _stemmed(draw_list, at, space, colour)
        stem_x = _stemmed(draw_list, (left + _BETWEEN * space, base), space, colour)
        top = base - _STEM_HEIGHT * space
        draw_list.sign("flag_8", (stem_x - _STEM_WIDTH / 2 * space, top), colour, space)
        x = stem_x + sign_box("flag_8").right * space
    y, middle, free = base - _BRACKET_Y * space, (left + x) / 2, 0.75 * space
    for begin, end, hook_x in ((left, middle - free, left), (middle + free, x, x)):
        draw_list.line((begin, y), (end, y), _LINE * space, colour)
        draw_list.line((hook_x, y), (hook_x, y + _HOOK * space), _LINE * space, colour)
    draw_list.text("3", (middle, y + 0.35 * _FIGURE * space), TypeStyle(_FIGURE * space, colour, Face.BOLD, 0.5))
    return x - left

"""The row below the staff that says how loud: words from ppp to fff, and hairpins from one to the next.

Units are staff spaces, y down, 0 on the staff's middle line.
"""

from station.music.loudness_marks import GROW, LoudnessMark
from station.music.score import Score
from station.render.notation.beams import Anchor
from station.render.palette import INK
from station.render.text.draw_list import TypeStyle
from station.render.text.fonts import Face

LOUDNESS_Y = 8.6
"""The words' baseline, below the sticking's."""
ROW_BOTTOM = 9.2
_WORD = TypeStyle(1.9, INK, Face.BOLD, 0.5)
_MIDDLE_Y, _OPENING, _THICK = LOUDNESS_Y - 0.5, 0.6, 0.13
"""A hairpin's axis, half its width where it is open, and how thick its lines are."""
_STEPS = 32
"""Its lines slope in so many level steps a bar, for time stretches level shapes alone: 0.02 spaces each."""
_AFTER_WORD, _LETTER = 0.5, 0.55
"""What it leaves free beside a word, and what half of each letter takes."""


def draw_loudness(anchor: Anchor, score: Score, start: int, end: int) -> None:
    """What the row says in [start, end) ticks of `score`."""
    marks = score.loudness
    for i, mark in enumerate(marks):
        after = marks[i + 1] if i + 1 < len(marks) else None
        if mark.is_hairpin:
            _hairpin(anchor, (marks[i - 1] if i else None, mark, after), score.end_tick, (start, end))
        elif start <= mark.tick < end:
            anchor.at(mark.tick)
            anchor.draw_list.text(mark.sign, (0.0, LOUDNESS_Y), _WORD)


def _hairpin(
    anchor: Anchor,
    marks: tuple[LoudnessMark | None, LoudnessMark, LoudnessMark | None],
    end_tick: int,
    bar: tuple[int, int],
) -> None:
    """As much of a hairpin as lies in `bar`; `marks` are the one before it, itself, and the one that ends it."""
    before, pin, after = marks
    until = end_tick if after is None else after.tick
    first, last = max(pin.tick, bar[0]), min(until, bar[1])
    if first >= last:
        return
    left = _room(before) if before is not None and before.tick == pin.tick else 0.0
    right = _room(after) if after is not None and last == until else 0.0
    for k in range(_STEPS):
        ticks = [first + (last - first) * (k + side) // _STEPS for side in (0, 1)]
        share = ((ticks[0] + ticks[1]) / 2 - pin.tick) / (until - pin.tick)
        open_by = _OPENING * (share if pin.sign == GROW else 1 - share)
        begin_x, end_x = (left * (1 - (k + side) / _STEPS) - right * (k + side) / _STEPS for side in (0, 1))
        _level(anchor, (ticks[0], ticks[1]), (begin_x - 0.03, end_x + 0.03), open_by)


def _level(anchor: Anchor, ticks: tuple[int, int], ends_x: tuple[float, float], open_by: float) -> None:
    """One step of both lines, between two ticks and so far beside them."""
    anchor.at(ticks[0])
    anchor.until(ticks[1])
    for y in (_MIDDLE_Y - open_by, _MIDDLE_Y + open_by):
        anchor.draw_list.box((ends_x[0], y - _THICK / 2), (ends_x[1] - ends_x[0], _THICK), INK)
    anchor.draw_list.span_s = 0.0


def _room(mark: LoudnessMark) -> float:
    """What a word takes on each side of its tick, with the gap to a hairpin; nothing where there is none."""
    return 0.0 if mark.is_hairpin else _AFTER_WORD + _LETTER * len(mark.sign)

"""The row below the staff that says how loud: words from ppp to fff, and hairpins from one to the next.

Units are staff spaces, y down, 0 on the staff's middle line.
"""

from station.core.units import PPQ
from station.music.loudness_marks import GROW, LoudnessMark
from station.music.score import Score
from station.render.notation.beams import Anchor
from station.render.palette import INK
from station.render.text.sign_outlines import HAIRPIN_LINE, sign_box

_RAISED, _OPENING = 0.5, 0.6
"""How far a hairpin's axis lies above the words' baseline, and half its width where it is open."""
_STEPS = 32
"""Its lines slope in so many level steps a bar, for time draws out level shapes alone: 0.02 spaces each."""
_AFTER_WORD = 0.5
"""What it leaves free beside a word."""

_FROM_LINE = PPQ // 100
"""So much before its bar begins what comes over the bar line, in ticks: nothing that a screen shows."""


def draw_loudness(anchor: Anchor, score: Score, bar: tuple[int, int], y: float) -> None:
    """What the row says from one tick of `score` up to another, the words' baseline at `y`."""
    marks, (start, end) = score.loudness, bar
    for i, mark in enumerate(marks):
        after = marks[i + 1] if i + 1 < len(marks) else None
        if mark.is_hairpin:
            _hairpin(anchor, (marks[i - 1] if i else None, mark, after), score.end_tick, bar, y)
        elif start <= mark.tick < end:
            anchor.at(mark.tick)
            anchor.draw_list.sign(f"loud_{mark.sign}", (0.0, y), INK)


def _hairpin(
    anchor: Anchor,
    marks: tuple[LoudnessMark | None, LoudnessMark, LoudnessMark | None],
    end_tick: int,
    bar: tuple[int, int],
    y: float,
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
        if k == 0 and pin.tick < bar[0]:
            ticks[0] -= _FROM_LINE  # paper has the bar line and a new meter between: it begins there
        _level(anchor, (ticks[0], ticks[1]), (begin_x - 0.03, end_x + 0.03), (y - _RAISED, open_by))


def _level(anchor: Anchor, ticks: tuple[int, int], ends_x: tuple[float, float], lines: tuple[float, float]) -> None:
    """One step of both lines, between two ticks and so far beside them; `lines`: their axis, and how far they open."""
    axis_y, open_by = lines
    anchor.at(ticks[0])
    anchor.until(ticks[1])
    for y in (axis_y - open_by, axis_y + open_by):
        anchor.draw_list.box((ends_x[0], y - HAIRPIN_LINE / 2), (ends_x[1] - ends_x[0], HAIRPIN_LINE), INK)
    anchor.draw_list.span_s = 0.0


def _room(mark: LoudnessMark) -> float:
    """What a word takes on each side of its tick, with the gap to a hairpin; nothing where there is none."""
    return 0.0 if mark.is_hairpin else _AFTER_WORD + sign_box(f"loud_{mark.sign}").right

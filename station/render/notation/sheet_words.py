"""Words above a line of a sheet: bar numbers, brackets of endings, how often, sections, tempo and swing.

Units are staff spaces, y down. Nearest to the staff stand the numbers, each as low as what is below lets it; brackets
of endings stand over them, and above all one row of sections, tempi and swing, in two where they would meet.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from station.core.units import PPQ
from station.render.notation.bar_lines import Volta, draw_volta
from station.render.notation.beat_note import draw_beat_note
from station.render.notation.skyline import Skyline
from station.render.notation.swing_words import SwingMark, draw_swing_mark
from station.render.palette import INK, INK_SOFT
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face

_NUMBER = TypeStyle(1.25, INK_SOFT, Face.BOLD)
_TIMES = TypeStyle(1.6, INK, Face.BOLD, 1.0)
_SECTION, _TEMPO, _FEEL = TypeStyle(1.9, INK, Face.BOLD), TypeStyle(1.7, INK, Face.BOLD), TypeStyle(1.7, INK)
_BEAT_NOTE = 1.35
_CAPITAL, _BELOW = 0.72, 0.22
"""How far letters reach above and below their line, in em (Roboto)."""
_AIR, _BESIDE = 0.45, 1.0
"""What words leave free below them and beside them (our choice)."""
_LOWEST = -2.9
"""The lowest line of what stands above a staff."""
_VOLTA_HEIGHT = 1.7
_FRAME, _FRAME_LINE = 0.45, 0.13
"""A section's name stands in a frame, so far off and so thick."""
_LONGEST_NAME = 36.0
"""A longer name is cut: half a line of the largest staff (our choice)."""
RAMPS = {1: "accel. to", -1: "rit. to"}


@dataclass(frozen=True, slots=True)
class TempoSign:
    """`beats_a_minute` of beats `beat_ticks` long; `way` 1 or −1 where it is reached growing faster or slower."""

    beats_a_minute: float
    beat_ticks: int = PPQ
    way: int = 0


@dataclass(frozen=True, slots=True)
class LineWord:
    """What stands above the line from `x` on, in this order; empty what is not.

    A section's name, a tempo, the one that is reached from it, a swing.
    """

    x: float
    section: str = ""
    tempo: TempoSign | None = None
    ramp: TempoSign | None = None
    swing: SwingMark | None = None


def draw_number(draw_list: DrawList, skyline: Skyline, x: float, number: str) -> None:
    """A bar's number over the middle of its left bar line."""
    width = draw_list.width(number, _NUMBER)
    left = max(x - width / 2, 0.0)
    _low(draw_list, skyline, (left, left + width), number, _NUMBER)


def draw_times(draw_list: DrawList, skyline: Skyline, x: float, times: int) -> None:
    """How often a passage is played, above the sign that ends it at `x`."""
    text = f"×{times}"
    _low(draw_list, skyline, (x - draw_list.width(text, _TIMES), x), text, _TIMES)


def _low(draw_list: DrawList, skyline: Skyline, ends_x: tuple[float, float], text: str, style: TypeStyle) -> None:
    """A line of text as low as it goes."""
    y = min(_LOWEST, skyline.top_over(ends_x[0] - _AIR, ends_x[1] + _AIR) - _AIR)
    draw_list.text(text, (ends_x[1] if style.align else ends_x[0], y), style)
    skyline.add(ends_x[0], ends_x[1], y - _CAPITAL * style.size, y)


def draw_voltas(draw_list: DrawList, skyline: Skyline, voltas: Sequence[tuple[float, float, Volta]]) -> None:
    """The brackets of a line's endings, each from one x to another, all at one height."""
    if not voltas:
        return
    y = min(skyline.top_over(left, right) for left, right, _ in voltas) - _AIR - _VOLTA_HEIGHT
    for left, right, volta in voltas:
        draw_volta(draw_list, (left, right), y, volta)
        skyline.add(left, right, y - 0.1, y)


def draw_words(draw_list: DrawList, skyline: Skyline, words: Sequence[LineWord]) -> None:
    """The upper row; what would meet its neighbour on the left stands a row higher, and nothing leaves the line."""
    lengths = [_drawn(DrawList(draw_list.atlas), word, 0.0) for word in words]
    most = [max(skyline.width - length, 0.0) for length in lengths]
    words = [replace(word, x=min(word.x, x)) for word, x in zip(words, most, strict=True)]
    ends = [word.x + length for word, length in zip(words, lengths, strict=True)]
    rows: list[float] = []
    row_of = []
    for word, end in zip(words, ends, strict=True):
        row = next((k for k, right in enumerate(rows) if right + _BESIDE <= word.x), len(rows))
        rows[row : row + 1] = [end]
        row_of.append(row)
    for row in range(len(rows)):
        chosen = [(word, end) for word, end, of in zip(words, ends, row_of, strict=True) if of == row]
        y = min(_LOWEST, *(skyline.top_over(word.x - _AIR, end + _AIR) for word, end in chosen)) - _AIR - _FRAME
        for word, end in chosen:
            _drawn(draw_list, word, y)
            skyline.add(word.x, end, y - _SECTION.size * _CAPITAL - _FRAME, y + _FRAME)


def _drawn(draw_list: DrawList, word: LineWord, y: float) -> float:
    """Draw a word on its line; returns how long it is."""
    x = word.x
    if word.section:
        x += _framed(draw_list, word.section, (x, y)) + _BESIDE
    for tempo in (word.tempo, word.ramp):
        if tempo is not None:
            x = _tempo(draw_list, tempo, (x, y)) + _BESIDE
    if word.swing is not None:
        x += draw_swing_mark(draw_list, (x, y), _FEEL.size, word.swing, INK) + _BESIDE
    return x - _BESIDE - word.x


def _framed(draw_list: DrawList, text: str, at: tuple[float, float]) -> float:
    text = draw_list.fitted(text, _SECTION, _LONGEST_NAME)
    (x, y), width = at, draw_list.width(text, _SECTION) + 2 * _FRAME
    top, bottom = y - _CAPITAL * _SECTION.size - _FRAME, y + _FRAME
    for edge in (top, bottom):
        draw_list.line((x, edge), (x + width, edge), _FRAME_LINE, INK)
    for side in (x, x + width):
        draw_list.line((side, top - _FRAME_LINE / 2), (side, bottom + _FRAME_LINE / 2), _FRAME_LINE, INK)
    draw_list.text(text, (x + _FRAME, y), _SECTION)
    return width


def _tempo(draw_list: DrawList, tempo: TempoSign, at: tuple[float, float]) -> float:
    """A tempo from a place on; returns where it ends."""
    x, y = at
    if tempo.way:
        x += draw_list.text(RAMPS[tempo.way], (x, y), _FEEL) + _BESIDE / 2
    x = draw_beat_note(draw_list, (x, y), _BEAT_NOTE, tempo.beat_ticks, INK)
    return x + draw_list.text(f"= {tempo.beats_a_minute:g}", (x, y), _TEMPO)

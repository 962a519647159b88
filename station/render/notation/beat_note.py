"""The note before a tempo, "♩. =": the beat that it counts."""

from station.core.units import PPQ
from station.render.text.draw_list import Colour, DrawList

_HEAD, _HALF, _TURN = (0.45, -0.27), (0.36, 0.26), -0.38
_STEM_X, _STEM_TOP, _STEM = 0.76, -1.45, 0.1
_HOLLOW = 0.1
_FLAG, _FLAG_STEP = 0.48, 0.3
_DOT_X, _DOT = 1.2, 0.12
_AFTER, _BESIDE = 1.3, 0.35
"""In units of which the note is one and a half high: as letters of that size are read (our choice). The flag's sign is
set so much smaller than on a staff. What a note takes with the gap after it, and a flag or a dot besides."""


def draw_beat_note(draw_list: DrawList, at: tuple[float, float], unit: float, beat_ticks: int, colour: Colour) -> float:
    """A note `beat_ticks` long whose left end on the baseline is `at`, a `unit` large; returns where text goes on."""
    (left, base), dotted = at, _is_dotted(beat_ticks)
    plain_ticks = beat_ticks * 2 // 3 if dotted else beat_ticks
    style = (0.0, _HOLLOW * unit if plain_ticks >= 2 * PPQ else 0.0, 0.0)
    head = (left + _HEAD[0] * unit, base + _HEAD[1] * unit)
    draw_list.ellipse(head, (_HALF[0] * unit, _HALF[1] * unit), colour, _TURN, style)
    stem_x, top = left + _STEM_X * unit, base + _STEM_TOP * unit
    draw_list.line((stem_x, head[1]), (stem_x, top), _STEM * unit, colour)
    flags = max((PPQ // plain_ticks).bit_length() - 1, 0)
    for k in range(flags):
        draw_list.sign("flag", (stem_x, top + _FLAG_STEP * k * unit), colour, _FLAG * unit)
    if dotted:
        dot_x = _DOT_X + (_BESIDE if flags else 0.0)
        draw_list.ellipse((left + dot_x * unit, head[1]), (_DOT * unit, _DOT * unit), colour)
    return left + (_AFTER + _BESIDE * (bool(flags) + dotted)) * unit


def _is_dotted(ticks: int) -> bool:
    """Whether a note of that length is half as long again as a plain one."""
    return ticks % 3 == 0 and (4 * PPQ) % (ticks * 2 // 3) == 0 and (4 * PPQ) % ticks != 0

"""The note before a tempo, "♩. =": the beat that it counts."""

from station.core.units import PPQ
from station.render.text.draw_list import Colour, DrawList
from station.render.text.sign_outlines import sign_box

_SCALE = 0.55
"""A note of three and a quarter spaces is then as high as letters of which a `unit` is two thirds (our choice)."""
_AFTER, _BEFORE_DOT = 0.5, 0.15
"""What is free after the note, and between it and its dot, in units (our choice)."""


def draw_beat_note(draw_list: DrawList, at: tuple[float, float], unit: float, beat_ticks: int, colour: Colour) -> float:
    """A note `beat_ticks` long whose left end on the baseline is `at`, a `unit` large; returns where text goes on."""
    (x, y), dotted = at, _is_dotted(beat_ticks)
    scale = _SCALE * unit
    base = max(4 * PPQ // (beat_ticks * 2 // 3 if dotted else beat_ticks), 1)
    y += sign_box("head_round").bottom * scale  # its head stands on the baseline
    draw_list.sign(f"beat_{base}", (x, y), colour, scale)
    x += sign_box(f"beat_{base}").width * scale
    if dotted:
        x += _BEFORE_DOT * unit
        draw_list.sign("beat_dot", (x, y), colour, scale)
        x += sign_box("beat_dot").width * scale
    return x + _AFTER * unit


def _is_dotted(ticks: int) -> bool:
    """Whether a note of that length is half as long again as a plain one."""
    return ticks % 3 == 0 and (4 * PPQ) % (ticks * 2 // 3) == 0 and (4 * PPQ) % ticks != 0

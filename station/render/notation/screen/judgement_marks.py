"""The signs of judgements on notes: on time, early, late, missed, another piece, too loud, too soft.

A judged note bears a shape as well as a colour: a ring on time, an arrow that points left when early and right when
late, a barred ring when missed, a square when the wrong piece was struck, a grey ring with a question mark when nothing
could be heard. What is on time the student's level says (`on_time_ms`). The tick or arrow stands where the hit fell,
drawn out by `TICK_ZOOM` so that a few milliseconds can be seen across a room. A wedge above the head that points up
says too loud, one below that points down too soft. Units are staff spaces unless a size is given, y down.
"""

from dataclasses import dataclass, replace

import numpy as np

from station.music.judgement import Label
from station.render.palette import EARLY, GOOD, INK, INK_SOFT, LATE, MISSED, WRONG, with_opacity
from station.render.text.draw_list import Colour, DrawList, TypeStyle
from station.render.text.fonts import Face

TICK_ZOOM = 5.0
"""The tick's distance from its head is the asynchrony drawn out so much (our choice: 10 ms is half a head)."""
_NEAREST_ARROW, _FARTHEST_ARROW = 1.65, 2.1
"""Spaces: beside the head, and still nearer to it than to the next."""
LOUD_OFF_DB = 6.0
"""So far from the written level is told on the note: half the step from one dynamic to the next (`scoring.dynamics`),
and beyond a professional's own scatter of about 4 dB (HUMANS: SD 15-21 of 127)."""
_WEDGE_AWAY = 1.6
"""Spaces from the head's middle to the wedge's; our choice, clear of the ring."""
_WEDGE = 0.42
_FIGURES = TypeStyle(1.15, INK, Face.BOLD, 0.5)
_FIGURES_DROP = 1.7
"""Spaces from the head's middle down to the figures' baseline: between the arrow and the ring of a head two spaces
lower (our choice)."""
_MINUS = "\N{MINUS SIGN}"


@dataclass(frozen=True, slots=True)
class MarkScale:
    """How marks are drawn: staff spaces a second, what is `on_time_ms`, and whether notes fall."""

    spaces_per_s: float
    on_time_ms: float
    falls: bool = False


def draw_mark(draw_list: DrawList, row: np.void, at: tuple[float, float], scale: MarkScale) -> None:
    """The judgement of one note whose head stands at `at`: beside its time, and its height.

    Time goes to the right, or up where a note `falls`: early is then below.
    """
    x, y = at
    label = Label(int(row["label"]))
    if label is Label.MISS:
        draw_list.ellipse(at, (1.05, 1.05), MISSED, 0.0, (0.0, 0.2, 0.0))
        draw_list.line((x - 0.75, y + 0.75), (x + 0.75, y - 0.75), 0.2, MISSED)
    elif label is Label.UNKNOWN:
        draw_list.ellipse(at, (1.05, 1.05), INK_SOFT, 0.0, (0.0, 0.2, 0.0))
        draw_list.text("?", (x, y + 0.62), TypeStyle(1.7, INK_SOFT, Face.BOLD, 0.5))
    elif label is Label.WRONG_PIECE:
        draw_list.box((x - 1.0, y - 1.0), (2.0, 2.0), WRONG, None, (0.3, 0.2, 0.0))
    else:
        _draw_timing(draw_list, float(row["asynchrony_ms"]), at, scale)


def _draw_timing(draw_list: DrawList, asynchrony_ms: float, at: tuple[float, float], scale: MarkScale) -> None:
    (x, y), falls = at, scale.falls
    colour = timing_colour(asynchrony_ms, scale.on_time_ms)
    if np.isnan(asynchrony_ms):  # right, and its time is not told
        draw_list.ellipse(at, (1.0, 0.86), colour, 0.0, (0.0, 0.22, 0.0))
        return
    shift = asynchrony_ms / 1000 * scale.spaces_per_s * TICK_ZOOM
    if abs(asynchrony_ms) <= scale.on_time_ms:
        draw_list.ellipse(at, (1.0, 0.86), colour, 0.0, (0.0, 0.22, 0.0))
        if falls:
            draw_list.line((x - 0.95, y - shift), (x + 0.95, y - shift), 0.24, colour)
        else:
            draw_list.line((x + shift, y - 0.95), (x + shift, y + 0.95), 0.24, colour)
    else:
        way = 1.0 if asynchrony_ms > 0 else -1.0
        tip = way * min(max(abs(shift), _NEAREST_ARROW), _FARTHEST_ARROW)
        draw_list.ellipse(at, (1.0, 0.86), with_opacity(colour, 0.5), 0.0, (0.0, 0.16, 0.0))
        middle, turn_rad = ((x, y - tip), -way * np.pi / 2) if falls else ((x + tip, y), 0.0 if way > 0 else np.pi)
        draw_list.triangle(middle, (0.52, 0.66), colour, turn_rad)


def draw_asynchrony(draw_list: DrawList, asynchrony_ms: float, at: tuple[float, float], on_time_ms: float) -> None:
    """How many milliseconds early or late the note at `at` was, in figures under its arrow; nothing where on time."""
    if not abs(asynchrony_ms) > on_time_ms:
        return
    x = at[0] + np.copysign(_FARTHEST_ARROW, asynchrony_ms)
    style = replace(_FIGURES, colour=timing_colour(asynchrony_ms, on_time_ms))
    draw_list.text(f"{asynchrony_ms:+.0f}".replace("-", _MINUS), (x, at[1] + _FIGURES_DROP), style)


def timing_colour(asynchrony_ms: float, on_time_ms: float) -> Colour:
    """The signal colour of an asynchrony in ms; NaN, a right note whose time is not told, has that of one on time."""
    if not abs(asynchrony_ms) > on_time_ms:
        return GOOD
    return EARLY if asynchrony_ms < 0 else LATE


def off_db(written: int, error: float) -> float | None:
    """How many dB louder (negative: softer) than `written` (velocity) a hit was that is `error` off; None for NaN."""
    if np.isnan(error) or written < 1:
        return None
    return float(40 * np.log10(max(written + error, 1.0) / written))


def draw_dynamics(draw_list: DrawList, louder_db: float | None, at: tuple[float, float], size: float = 1.0) -> None:
    """The wedge of a note at `at` that was `louder_db` off, if that is much; `size` units a staff space."""
    if louder_db is None or abs(louder_db) < LOUD_OFF_DB:
        return
    up = louder_db > 0
    tip = (at[0], at[1] - (_WEDGE_AWAY if up else -_WEDGE_AWAY) * size)
    draw_list.triangle(tip, (_WEDGE * size, _WEDGE * size), INK, -np.pi / 2 if up else np.pi / 2)

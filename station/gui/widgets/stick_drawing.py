"""The live picture of sticks: each turns as its sensor says, over a head, with the sensor's face to show its roll."""

from collections.abc import Sequence

import numpy as np
from imgui_bundle import imgui

from station.core.imu import Quaternion
from station.gui import theme
from station.gui.widgets.stick_shape import Points, StickShape, head_outline, stick_shape
from station.render import palette
from station.render.text.draw_list import Colour

_WOOD, _WOOD_DARK = (0.91, 0.74, 0.50, 1.0), (0.36, 0.24, 0.13, 1.0)
"""Hickory in light and in shade (our choice)."""
_SHADOW = (0.02, 0.02, 0.03, 1.0)
"""None of the palette's: a theme turns those, and a shadow is dark in all of them (our choice)."""
_HEAD_AT, _HEAD_M = (0.0, 0.24, -0.06), 0.13
"""A 10-inch head ahead of the hands, just under where a tip at rest lies."""
_FULCRUM = (-0.16, 0.20)
"""Where in its half of the picture a stick's fulcrum lies from the middle, in heights: a raised tip and the head are
seen."""
_WIDEST = 1.22
"""How wide a stick and its head are, in heights."""


def draw_sticks(sticks: Sequence[tuple[str, Quaternion | None]], size: tuple[float, float]) -> None:
    """Draw sticks, each with its name, side by side into the next `size` pixels of the panel.

    A stick's turn is earth from stick, with the heading 0 ahead; None where it is unknown.
    """
    corner, brush = imgui.get_cursor_screen_pos(), imgui.get_window_draw_list()
    wide, high = size
    imgui.dummy(imgui.ImVec2(wide, high))
    low, far = corner, imgui.ImVec2(corner.x + wide, corner.y + high)
    brush.push_clip_rect(low, far, True)
    brush.add_rect_filled(low, far, _ink(palette.PAPER), theme.points(6))
    unit = min(high, wide / len(sticks) / _WIDEST)
    for place, (name, turn) in enumerate(sticks):
        left = corner.x + wide * place / len(sticks)
        at = imgui.ImVec2(left + theme.points(10), corner.y + theme.points(8))
        brush.add_text(at, _ink(palette.INK_SOFT), name)
        middle = np.array([left + wide * 0.5 / len(sticks), corner.y + 0.5 * high])
        middle += unit * np.array(_FULCRUM)
        _head(brush, middle, unit)
        if turn is not None:
            _stick(brush, stick_shape(turn, -_HEAD_AT[2]), middle, unit)
    brush.pop_clip_rect()


def _head(brush: imgui.ImDrawList, middle: Points, unit: float) -> None:
    edge = _at(head_outline(_HEAD_M, _HEAD_AT), middle, unit)
    brush.add_convex_poly_filled(edge, _ink(palette.with_opacity(palette.INK, 0.22)))
    brush.add_polyline(edge, _ink(palette.INK_SOFT), theme.points(2), imgui.ImDrawFlags_.closed)


def _stick(brush: imgui.ImDrawList, shape: StickShape, middle: Points, unit: float) -> None:
    shade = _ink(palette.with_opacity(_SHADOW, 0.35))
    for before, after in zip(shape.shadow[:-1], shape.shadow[1:], strict=True):
        _quad(brush, np.array([before[0], before[1], after[1], after[0]]), middle, unit, shade)
    for strip, lightness in enumerate(shape.shades):
        wood = _ink(palette.mixed(_WOOD_DARK, _WOOD, float(lightness)))
        one, other = shape.strips[strip], shape.strips[strip + 1]
        for k in range(len(one) - 1):
            _quad(brush, np.array([one[k], one[k + 1], other[k + 1], other[k]]), middle, unit, wood)
    dark = _ink(_WOOD_DARK)
    for edge in (shape.strips[0], shape.strips[-1]):  # quads have hard edges, lines soft ones
        brush.add_polyline(_at(edge, middle, unit), dark, 1.0, imgui.ImDrawFlags_.none)
    _quad(
        brush, shape.sensor, middle, unit, _ink(palette.mixed(palette.NIGHT, palette.BRAND, 0.25 + 0.75 * shape.faces))
    )


def _quad(brush: imgui.ImDrawList, corners: Points, middle: Points, unit: float, ink: int) -> None:
    a, b, c, d = _at(corners, middle, unit)
    brush.add_quad_filled(a, b, c, d, ink)


def _at(points: Points, middle: Points, unit: float) -> "list[imgui.ImVec2Like]":
    return [imgui.ImVec2(float(x), float(y)) for x, y in middle + unit * points]


def _ink(colour: Colour) -> int:
    return int(imgui.color_convert_float4_to_u32(imgui.ImVec4(*theme.themed(colour))))

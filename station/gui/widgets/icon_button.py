"""Buttons with the signs that every player has, drawn as triangles and bars: no font is needed for them."""

from collections.abc import Mapping
from enum import Enum
from types import MappingProxyType

from imgui_bundle import imgui

from station.gui import theme
from station.render import palette


class Sign(Enum):
    """What is drawn on a button."""

    START = "start"
    REWIND = "rewind"
    STEP_BACK = "step back"
    PLAY = "play"
    STOP = "stop"
    STEP = "step"
    FORWARD = "forward"
    END = "end"
    REVERSE = "reverse"


_Polygon = tuple[tuple[float, float], ...]


def _to_right(left: float, right: float) -> _Polygon:
    return (left, 0.0), (right, 0.5), (left, 1.0)


def _bar(left: float, right: float) -> _Polygon:
    return (left, 0.0), (right, 0.0), (right, 1.0), (left, 1.0)


_FORWARDS: Mapping[Sign, tuple[_Polygon, ...]] = {
    Sign.END: (_to_right(0.05, 0.8), _bar(0.8, 0.95)),
    Sign.FORWARD: (_to_right(0.0, 0.5), _to_right(0.5, 1.0)),
    Sign.STEP: (_bar(0.1, 0.25), _to_right(0.38, 0.95)),
    Sign.PLAY: (_to_right(0.1, 0.95),),
    Sign.STOP: (_bar(0.05, 0.95),),
}
_BACK_OF = {
    Sign.START: Sign.END,
    Sign.REWIND: Sign.FORWARD,
    Sign.STEP_BACK: Sign.STEP,
    Sign.REVERSE: Sign.PLAY,
}


def _mirrored(polygon: _Polygon) -> _Polygon:
    return tuple((1.0 - x, y) for x, y in reversed(polygon))


SHAPES: Mapping[Sign, tuple[_Polygon, ...]] = MappingProxyType(
    {
        **_FORWARDS,
        **{back: tuple(_mirrored(part) for part in _FORWARDS[sign]) for back, sign in _BACK_OF.items()},
    }
)
"""Every sign's polygons in the unit square, y down."""


def icon_button(label: str, sign: Sign, size: tuple[float, float], lit: bool = False) -> bool:
    """A button of `size` pixels that bears `sign`; returns whether it was pressed. `lit` shows that it is on."""
    if lit:
        imgui.push_style_color(imgui.Col_.button, imgui.ImVec4(*palette.with_opacity(theme.dyed(palette.BRAND), 0.55)))
    pressed = imgui.button(label, imgui.ImVec2(*size))
    if lit:
        imgui.pop_style_color()
    low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    side = 0.38 * min(high.x - low.x, high.y - low.y)
    x, y = (low.x + high.x - side) / 2, (low.y + high.y - side) / 2
    ink, brush = imgui.get_color_u32(imgui.Col_.text), imgui.get_window_draw_list()
    for polygon in SHAPES[sign]:
        brush.add_convex_poly_filled([imgui.ImVec2(x + px * side, y + py * side) for px, py in polygon], ink)
    return bool(pressed)

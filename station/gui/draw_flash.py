"""Draws the click as light (`practice.session.cues.click_flash`) at both sides of the picture, fading inwards."""

from imgui_bundle import imgui

from station.gui import theme
from station.practice.session.cues.click_flash import Flash
from station.render import palette
from station.render.painter import Area

_WIDE, _SHARE = 96.0, 0.12
"""Design pixels of each side, and at most so much of the picture (our choice: on a 24-inch screen 44 mm, half as bright
after 22 mm, seen while the eyes are on the score)."""
_VEIL = 0.14
"""Of an accent's brightness lies over the whole picture (our choice: the corner of an eye sees it)."""


def draw_flash(flash: Flash, picture: Area) -> None:
    """Draw it at the sides of `picture`, the window's free middle: an accent in the brand's colour, beats in ink."""
    if flash.strength <= 0.0:
        return
    io = imgui.get_io()
    scale_x, scale_y = io.display_framebuffer_scale
    left, width, height = picture[0] / scale_x, picture[2] / scale_x, picture[3] / scale_y
    bottom = io.display_size.y - picture[1] / scale_y
    ink = palette.BRAND if flash.is_accent else palette.INK
    colour, wide = theme.packed(palette.with_opacity(ink, flash.strength)), min(theme.points(_WIDE), _SHARE * width)
    brush = imgui.get_background_draw_list()
    veil = theme.packed(palette.with_opacity(ink, _VEIL * flash.strength * flash.is_accent))
    none, right = theme.packed(palette.with_opacity(ink, 0.0)), left + width
    for begin, end, from_left, from_right in (
        (left, right, veil, veil),
        (left, left + wide, colour, none),
        (right - wide, right, none, colour),
    ):
        low, high = imgui.ImVec2(begin, bottom - height), imgui.ImVec2(end, bottom)
        brush.add_rect_filled_multi_color(low, high, from_left, from_right, from_right, from_left)

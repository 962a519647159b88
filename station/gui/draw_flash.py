"""Draws the click as light (`app.sound.click_flash`): a frame round the picture, seen without looking."""

from imgui_bundle import imgui

from station.app.sound.click_flash import Flash
from station.gui import theme
from station.render import palette
from station.render.painter import Area

_THICK = 26.0
"""Design pixels: at two metres half a degree on a laptop's screen (our choice)."""
_VEIL = 0.12
"""Of an accent's brightness lies over the whole picture (our choice: the corner of an eye sees it)."""


def draw_flash(flash: Flash, picture: Area) -> None:
    """Draw it round `picture`, the window's free middle: an accent in the station's colour, beats in that of ink."""
    if flash.strength <= 0.0:
        return
    io = imgui.get_io()
    scale_x, scale_y = io.display_framebuffer_scale
    left, width, height = picture[0] / scale_x, picture[2] / scale_x, picture[3] / scale_y
    bottom = io.display_size.y - picture[1] / scale_y
    low, high = imgui.ImVec2(left, bottom - height), imgui.ImVec2(left + width, bottom)
    colour = palette.with_opacity(palette.BRAND if flash.is_accent else palette.INK, flash.strength)
    brush, inside = imgui.get_background_draw_list(), theme.points(_THICK) / 2
    if flash.is_accent:
        brush.add_rect_filled(low, high, theme.packed(palette.with_opacity(palette.BRAND, _VEIL * flash.strength)))
    brush.add_rect(
        imgui.ImVec2(low.x + inside, low.y + inside),
        imgui.ImVec2(high.x - inside, high.y - inside),
        theme.packed(colour),
        0.0,
        2 * inside,
    )

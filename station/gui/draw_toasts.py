"""Draws what the window shows in passing over the picture (`app.toasts`)."""

from imgui_bundle import imgui

from station.gui import theme
from station.render.painter import Area

ABOVE_RESULT = 58.0
"""Design pixels that a result leaves free for toasts above it."""
_TOP, _LOWEST = 150.0, 0.3
"""Where they stand over the room: design pixels from the picture's top, and the most of a low picture's height."""
_NAME = "##news"


def draw_toast(text: str, picture: Area, is_result: bool) -> None:
    """Draw it at the top of `picture`, which is the window's free middle; above a result, never over it."""
    if not text:
        return
    io = imgui.get_io()
    scale_x, scale_y = io.display_framebuffer_scale
    left, width, height = picture[0] / scale_x, picture[2] / scale_x, picture[3] / scale_y
    top = io.display_size.y - picture[1] / scale_y - height
    below = theme.points(4.0) if is_result else min(theme.points(_TOP), _LOWEST * height)
    at = imgui.ImVec2(left + width / 2, top + below)
    imgui.set_next_window_pos(at, imgui.Cond_.always, imgui.ImVec2(0.5, 0))
    flags = imgui.WindowFlags_.no_decoration | imgui.WindowFlags_.always_auto_resize | imgui.WindowFlags_.no_inputs
    flags |= imgui.WindowFlags_.no_focus_on_appearing | imgui.WindowFlags_.no_docking
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(theme.points(14), theme.points(6)))
    imgui.begin(_NAME, None, flags)
    most = width - theme.points(40)
    imgui.push_text_wrap_pos(min(most, imgui.calc_text_size(text).x + theme.points(16)))
    imgui.text(text)
    imgui.pop_text_wrap_pos()
    imgui.end()
    imgui.pop_style_var()

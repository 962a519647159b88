"""Draws what the window shows in passing (`app.toasts`) where nothing else is: in the band above the room."""

from imgui_bundle import imgui

from station.gui import theme
from station.render.hud import FreeLine
from station.render.painter import Area

ABOVE_RESULT = 52.0
"""Design pixels that a result leaves free for toasts above it: two lines with their edges."""
_TOP, _EDGE = 4.0, 8.0
"""Design pixels from the picture's upper edge where there is no band, and from its sides."""
_PADDING, _BORDER = (12.0, 3.0), 1.0
_NAME = "##news"


def draw_toast(text: str, picture: Area, line: FreeLine | None) -> None:
    """Draw it in `line` of `picture`, the window's free middle, where it has no words; without a band at its top.

    What is longer than the line is free covers the phase meanwhile; what is longer still has several lines.
    """
    if not text:
        return
    io = imgui.get_io()
    scale_x, scale_y = io.display_framebuffer_scale
    left, width, height = picture[0] / scale_x, picture[2] / scale_x, picture[3] / scale_y
    top = io.display_size.y - picture[1] / scale_y - height
    edge, padding = theme.points(_EDGE), imgui.ImVec2(*map(theme.points, _PADDING))
    most, wide = width - 2 * edge, imgui.calc_text_size(text).x + 2 * padding.x
    start, end = (edge, width - edge) if line is None else (line[0] / scale_x, line[1] / scale_x)
    if wide > end - start:
        start = edge
    if wide > end - start:
        end = width - edge
    at = imgui.ImVec2(left + (start + end) / 2, top + theme.points(_TOP))
    pivot = imgui.ImVec2(0.5, 0.0)
    if line is not None and wide <= most:
        at.y, pivot.y = top + line[2] / scale_y, 0.5
    imgui.set_next_window_pos(at, imgui.Cond_.always, pivot)
    flags = imgui.WindowFlags_.no_decoration | imgui.WindowFlags_.always_auto_resize | imgui.WindowFlags_.no_inputs
    flags |= imgui.WindowFlags_.no_focus_on_appearing | imgui.WindowFlags_.no_docking
    imgui.push_style_var(imgui.StyleVar_.window_padding, padding)
    imgui.push_style_var(imgui.StyleVar_.window_border_size, max(theme.points(_BORDER), 1.0))
    imgui.push_style_var(imgui.StyleVar_.window_min_size, imgui.ImVec2(1.0, 1.0))
    imgui.begin(_NAME, None, flags)
    imgui.push_text_wrap_pos(min(most - padding.x, imgui.calc_text_size(text).x + theme.points(16)))
    imgui.text(text)
    imgui.pop_text_wrap_pos()
    imgui.end()
    imgui.pop_style_var(3)

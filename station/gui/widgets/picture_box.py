"""A page or a band that lies over a part of the picture: where that is on the screen, and a bare window there."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from imgui_bundle import imgui

from station.render.painter import Area


@dataclass(frozen=True, slots=True)
class Box:
    """A place on the screen in imgui's pixels."""

    left: float
    top: float
    width: float
    height: float


def on_screen(picture: Area) -> Box:
    """The picture's place in imgui's pixels, from the window's top."""
    io = imgui.get_io()
    sx, sy = io.display_framebuffer_scale
    return Box(picture[0] / sx, io.display_size.y - (picture[1] + picture[3]) / sy, picture[2] / sx, picture[3] / sy)


@contextmanager
def bare_window(name: str, box: Box, is_square: bool = True, takes_keys: bool = False) -> Iterator[None]:
    """A window without a frame at `box`, below whatever is opened over it; `takes_keys` where its controls have any."""
    imgui.set_next_window_pos(imgui.ImVec2(box.left, box.top))
    imgui.set_next_window_size(imgui.ImVec2(box.width, box.height))
    imgui.set_next_window_bg_alpha(1.0)
    flags = imgui.WindowFlags_.no_decoration | imgui.WindowFlags_.no_move | imgui.WindowFlags_.no_docking
    flags |= imgui.WindowFlags_.no_saved_settings | imgui.WindowFlags_.no_focus_on_appearing
    flags |= imgui.WindowFlags_.no_bring_to_front_on_focus
    if not takes_keys:
        flags |= imgui.WindowFlags_.no_nav
    if is_square:
        imgui.push_style_var(imgui.StyleVar_.window_rounding, 0.0)
    imgui.begin(name, None, flags)
    try:
        yield
    finally:
        imgui.end()
        if is_square:
            imgui.pop_style_var()

"""What the window has to tell in passing: one or two lines over the picture that go away by themselves."""

from imgui_bundle import imgui

from station.gui import theme
from station.render.painter import Area

SHOWN_S = 8.0
"""How long a fault or a notice stays on the screen (our choice: twice the time to read it)."""
ABOVE_RESULT = 58.0
"""Design pixels that a result leaves free for news above it."""
_TOP, _LOWEST = 150.0, 0.3
"""Where news stands over the room: design pixels from the picture's top, and the most of a low picture's height."""
_MOST_LINES = 2
"""So many notices are read at once (our choice: what has room above a result)."""
_NAME = "##news"


class Toasts:
    """The line that is shown now, if any."""

    def __init__(self) -> None:
        self.text = ""
        self._left_s = 0.0
        self._told: tuple[str, ...] = ()

    def tell(self, text: str) -> None:
        """Show `text` from now on."""
        self.text, self._left_s = text, SHOWN_S

    def follow(self, notices: tuple[str, ...], passed_s: float) -> None:
        """Let time pass, and tell what of `notices`, the last ones that there were, is new."""
        self._left_s -= passed_s
        if notices != self._told:
            new = new_of(self._told, notices)[-_MOST_LINES:]
            self._told = notices
            if new:
                self.tell("\n".join(new))

    def gui(self, picture: Area, is_result: bool) -> None:
        """Draw it at the top of `picture`, which is the window's free middle; above a result, never over it."""
        if self._left_s <= 0:
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
        imgui.push_text_wrap_pos(min(most, imgui.calc_text_size(self.text).x + theme.points(16)))
        imgui.text(self.text)
        imgui.pop_text_wrap_pos()
        imgui.end()
        imgui.pop_style_var()


def new_of(before: tuple[str, ...], now: tuple[str, ...]) -> tuple[str, ...]:
    """What of the last lines of a list was added since the last lines were those `before`."""
    kept = next(
        kept for kept in range(min(len(before), len(now)), -1, -1) if before[len(before) - kept :] == now[:kept]
    )
    return now[kept:]

"""A dockable panel as the window sees it: what it is called, where it docks, when it is shown, who draws it.

A panel either belongs to what is going on (the lessons before a session, the bars after it), or it is a tool that the
user opens and closes. Whoever adds a panel writes a module here and a line in `gui.panel_table`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum

from imgui_bundle import hello_imgui, imgui

from station.app.window_state import State
from station.gui import theme

PANELS_LABEL = "Panels##panels"
_POPUP = "##panels-popup"
PANELS_WIDTH = 84.0
"""Design pixels of the button."""


class DockSide(StrEnum):
    """Where a panel docks first; tools can be dragged elsewhere."""

    BESIDE = "Beside"
    RIGHT = "Right"
    BELOW = "Below"
    EDITOR = "Editor"
    STRIP = "Strip"


@dataclass(frozen=True, slots=True)
class Panel:
    """One panel: `about` explains it in its tooltip, `gui` draws it; a tool's `shown` is None: the user opens it.

    `help` is what F1 says of a tool at length, `about` where there is none.
    """

    name: str
    side: DockSide
    gui: Callable[[State], None]
    about: str = ""
    shown: Callable[[State], bool] | None = None
    help: str = ""

    def window(self, state: Callable[[], State]) -> hello_imgui.DockableWindow:
        """The panel for hello_imgui; it shows `state` as it is when it is drawn."""
        window = hello_imgui.DockableWindow(self.name, str(self.side), lambda: self.gui(state()))
        window.is_visible = False
        window.can_be_closed = self.shown is None
        window.remember_is_visible = self.shown is None
        if self.side is DockSide.BELOW:
            window.imgui_window_flags = imgui.WindowFlags_.no_scrollbar
        return window


def panels_popup(tools: Sequence[Panel], docking: hello_imgui.DockingParams) -> None:
    """A button that opens the list of tools, each with a tick where it is open."""
    if not tools:
        return
    if imgui.button(PANELS_LABEL, imgui.ImVec2(theme.points(PANELS_WIDTH), 0)):
        imgui.open_popup(_POPUP)
    theme.tooltip("Panels to open beside the picture")
    imgui.same_line()
    if not imgui.begin_popup(_POPUP):
        return
    for page in tools:
        window = docking.dockable_window_of_name(page.name)
        _, window.is_visible = imgui.checkbox(page.name, window.is_visible)
        theme.tooltip(page.about)
    imgui.end_popup()

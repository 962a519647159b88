"""What is heard while the mouse rests on it, or the keyboard's focus does: begun once, ended when it goes elsewhere."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.sound_actions import StopHearing


class HoverTrial:
    """Tells `dispatch` to begin and to stop; `begin` and `end` surround what is drawn in a frame."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._name = ""
        self._is_looked_at = False

    def begin(self) -> None:
        """A frame begins."""
        self._is_looked_at = False

    def item(self, name: str, action: Action) -> None:
        """The item that was drawn last is tried by `action` when it has been looked at for 0.4 s (imgui's delay)."""
        if not imgui.is_item_hovered(imgui.HoveredFlags_.delay_normal | imgui.HoveredFlags_.no_shared_delay):
            return
        self._is_looked_at = True
        if name != self._name:
            self._name = name
            self._dispatch(action)

    def end(self) -> None:
        """A frame ends: what is looked at no longer is heard no longer."""
        if self._name and not self._is_looked_at:
            self._name = ""
            self._dispatch(StopHearing())

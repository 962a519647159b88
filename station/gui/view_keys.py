"""The keys that change where the user looks from, and what of it is kept."""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.action import Action, Notify
from station.app.actions.settings_actions import KeepViewpoint, SetView
from station.app.settings.view_settings import ViewSettings
from station.gui.keyboard_kit import slot_pressed, view_pressed
from station.gui.viewport import Viewport

_LOOKS: tuple[tuple[imgui.Key, Callable[[ViewSettings], ViewSettings]], ...] = (
    (imgui.Key.m, lambda view_settings: replace(view_settings, mirrored=not view_settings.mirrored)),
    (imgui.Key.p, ViewSettings.next_inset),
    (imgui.Key.n, ViewSettings.next_score),
    (imgui.Key.e, ViewSettings.next_double),
)
"""What a plain key makes of the look."""
_SIZES = ((imgui.Key.equal, 1), (imgui.Key.minus, -1))
"""Ctrl and these make the panels larger or smaller."""


class ViewKeys:
    """The viewpoints' keys over one viewport; what is chosen goes to `dispatch`."""

    def __init__(self, viewport: Viewport, dispatch: Callable[[Action], None]) -> None:
        self._viewport = viewport
        self._dispatch = dispatch

    def handle(self, view_settings: ViewSettings) -> None:
        """Do what was pressed since the last frame, which `view_settings` is from."""
        io = imgui.get_io()
        slot = slot_pressed()
        if slot is not None and io.key_ctrl and not io.key_shift:
            self.keep(slot)
        elif io.key_ctrl and (way := next((way for key, way in _SIZES if imgui.is_key_pressed(key)), 0)):
            self._dispatch(SetView(view_settings.scaled(way)))
        elif io.key_ctrl or io.key_shift or io.key_alt or io.key_super:
            return
        elif slot is not None:
            self.go(slot)
        elif not self.turn(view_settings):
            for change in (change for key, change in _LOOKS if imgui.is_key_pressed(key, repeat=False)):
                view_settings = change(view_settings)
                self._dispatch(SetView(view_settings))

    def turn(self, view_settings: ViewSettings) -> bool:
        """Go to the named view whose key was pressed since the last frame; returns whether one was."""
        view = view_pressed()
        if view is None:
            return False
        self._viewport.back_to(view)
        self._dispatch(SetView(replace(view_settings, view=view)))
        return True

    def keep(self, slot: int) -> None:
        """Keep where the user looks from as a slot (from 0)."""
        self._dispatch(KeepViewpoint(slot, self._viewport.camera))

    def go(self, slot: int) -> None:
        """Look from a slot's viewpoint, or say that none is kept there."""
        if not self._viewport.go(slot):
            self._dispatch(Notify(f"no viewpoint {slot + 1} is kept yet: Ctrl+{slot + 1} keeps where you look from"))

"""The station behind its window: takes in what has happened, does what the user asks, says what is shown.

`update` takes in what has happened and moves everything on; `dispatch` does what the user asks; nothing else changes
anything. `view` is what the window shows, one frozen value. Hits carry their own times, so that the frame rate decides
nothing. `station_parts` has what is moved, `station_view` what is shown of it, `handlers` who does what is asked.
"""

from datetime import date
from functools import partial

from station.app.actions.action import Action
from station.app.actions.practice_actions import Pause
from station.app.child_programs import ChildPrograms
from station.app.handlers.file_handler import take_imported
from station.app.handlers.handler_table import handlers_of
from station.app.handlers.history_handler import show_opened
from station.app.sessions.launch import Launch
from station.app.settings.settings_store import SettingsStore
from station.app.station_parts import StationParts
from station.app.station_view import state_of
from station.app.window_state import State
from station.core.errors import DeviceError, StationError
from station.engine.messages import EngineEvent


class Controller:
    """Moves the `parts` on and does what is asked; they are made of `processes`, `store` and `launch`."""

    def __init__(self, processes: ChildPrograms, store: SettingsStore, launch: Launch) -> None:
        self.parts = StationParts(processes, store, launch)
        self._handlers = handlers_of(self.parts)
        self._now_ns = 0
        self._view: State | None = None

    def view(self) -> State:
        """What the window shows, as of the last update and what was dispatched since."""
        if self._view is None:
            self._view = state_of(self.parts, self._now_ns)
        return self._view

    def dispatch(self, action: Action) -> None:
        """Do what the user asks; what cannot be done is said in one line."""
        self._view = None
        self.parts.toasts.attempt(lambda: self.parts.toasts.notify(self._handlers[type(action)](action) or ""))

    def update(self, now_ns: int) -> bool:
        """Take in what has happened until `now_ns` and move on; returns whether the engine has said anything."""
        self._view, self._now_ns = None, now_ns
        parts, attempt = self.parts, self.parts.toasts.attempt
        attempt(parts.calibration.advance)
        if not (parts.editor.is_open or parts.exam.looks or parts.battle.is_open):
            attempt(parts.chooser.update)
        events = self._heard()
        asked = [action for event in events if (action := self._handle(event)) is not None]
        parts.mapping.advance(now_ns)
        first = parts.sticks, parts.sessions, parts.exam, parts.battle
        for part in (*first, parts.editor, parts.phase, parts.song, parts.sound):
            attempt(partial(part.advance, now_ns))
        attempt(lambda: parts.toasts.notify(parts.export.news() or parts.export.written() or ""))
        attempt(lambda: parts.toasts.notify(parts.history.page_written()))
        attempt(lambda: take_imported(parts))
        if parts.history_opening.advance():
            parts.look_again()
        if parts.shown.today:
            attempt(lambda: parts.today.advance(date.today(), parts.sessions.practice.stage))
        if parts.shown.teacher:
            attempt(parts.teacher.advance)
        if parts.shown.assigned:
            attempt(lambda: parts.assigned.advance(date.today(), parts.sessions.practice.stage))
        if parts.shown.history:
            attempt(lambda: parts.history.advance(date.today(), parts.sessions.practice.stage))
        attempt(lambda: show_opened(parts))
        asked += self._chosen()
        for action in asked:
            self.dispatch(action)
        parts.pads.offer(parts.choice() if parts.kit_commands else None, now_ns)
        if not parts.sessions.practice.is_playing:
            self._keep()
        parts.toasts.update(now_ns)
        return bool(events)

    def _heard(self) -> list[EngineEvent]:
        try:
            return self.parts.engine.events()
        except DeviceError as fault:
            self.parts.toasts.notify(str(fault))
            self.parts.sessions.died()
            self.parts.editor.died()
            return []

    def _chosen(self) -> list[Action]:
        """What the kit asks for now that nothing came after a gesture; pads choose from what is on the screen."""
        parts = self.parts
        asked = parts.pads.advance(self._now_ns, parts.sessions.practice) if parts.kit_commands else None
        return [] if asked is None else [asked]

    def _handle(self, event: EngineEvent) -> Action | None:
        """Handle one event; a session that it asks for begins when all others are handled, a pause at once."""
        parts, attempt = self.parts, self.parts.toasts.attempt
        parts.mapping.handle(event)
        parts.sticks.handle(event)
        parts.sound.handle(event)
        attempt(lambda: parts.song.handle(event))
        parts.sessions.handle(event, self._now_ns)
        if parts.editor.is_open and not (parts.mapping.learns or parts.sticks.learns):
            attempt(lambda: parts.editor.handle(event))
        asked = parts.pads.handle(event, parts.sessions.practice) if parts.kit_commands else None
        if not isinstance(asked, Pause):
            return asked
        self.dispatch(asked)
        return None

    def _keep(self) -> None:
        """Write what was set; never while somebody plays."""
        self.parts.toasts.attempt(self.parts.style.keep)
        if self.parts.store.is_due:
            self.parts.toasts.attempt(self.parts.store.write)

    def close(self) -> StationError | None:
        """Keep what runs and what was set; returns what nobody can be shown any more."""
        self._view = None
        return self.parts.close()

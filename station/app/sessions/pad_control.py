"""What the kit asks for: two kicks start or go on, pads at once and foot switches pause, a pad answers a question.

Pads ask for nothing in mid-drill but the gestures of a pause, and nothing at all while the kit is heard for something
else: a gesture to be learnt.
"""

from station.app.actions.action import Action
from station.app.actions.practice_actions import Answer, Begin, Pause
from station.app.sessions.current_practice import CurrentPractice
from station.app.settings.preferences import Preferences
from station.app.settings.settings_store import SettingsStore
from station.engine.messages import EngineEvent
from station.music.score import Score
from station.practice.control.pad_commands import PadCommands


class PadControl:
    """Takes every event of the engine, by the settings of `store`; raises `BadInput` for a pause that is none."""

    def __init__(self, store: SettingsStore, preferences: Preferences, score: Score) -> None:
        self._store, self._preferences = store, preferences
        self._go_by(score)

    def _go_by(self, score: Score) -> None:
        self._by = _asked_by(self._store)
        self._pads = PadCommands(self._store.now, score)

    def forget(self) -> None:
        """What was struck so far means nothing."""
        self._pads.forget()

    def handle(self, event: EngineEvent, practice: CurrentPractice) -> Action | None:
        """What `event` asks for, given what is practised; None for nothing."""
        score = practice.session.plan.score
        if self._by != _asked_by(self._store):
            self._go_by(score)
        if practice.last_result.is_asking:
            self._pads.forget()
            guess = practice.last_result.guess_of(event)
            return None if guess is None else Answer(guess)
        if self._preferences.handle(event):
            self._pads.forget()
            return None
        self._pads.practise(score)
        may_start = not practice.is_playing or (practice.is_session and practice.session.paused)
        if may_start and self._pads.starts(event):
            self._pads.forget()
            return Pause() if practice.is_session else Begin()
        strokes = self._pads.pauses(event)
        if strokes is None or not practice.is_session:
            return None
        self._pads.forget()
        return Pause(tuple(strokes))


def _asked_by(store: SettingsStore) -> tuple[str, bool]:
    """The settings that say what pads ask for."""
    return store.now.pause, store.now.kicks_start

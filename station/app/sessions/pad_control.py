"""What the kit asks for: two kicks start or go on, pads at once and foot switches pause, a pad answers a question.

Between sessions, what pauses one asks who plays.

Pads ask for nothing in mid-drill but the gestures of a pause, and nothing at all while the kit is heard for something
else: a gesture to be learnt.
"""

from collections import deque

from station.app.actions.action import Action
from station.app.actions.practice_actions import Answer, Begin, Pause
from station.app.actions.settings_actions import AskWhoPlays
from station.app.sessions.current_practice import CurrentPractice
from station.app.sessions.who_plays import WhoPlays
from station.app.settings.preferences import Preferences
from station.app.settings.settings_store import SettingsStore
from station.core.events import Hit
from station.engine.messages import EngineEvent
from station.music.score import Score
from station.practice.control.pad_choice import SILENCE_NS
from station.practice.control.pad_commands import PadCommands

_REMEMBERED = 8
"""Strokes (our choice: as many as two hands strike at once, and some before)."""


class PadControl:
    """Takes every event of the engine, by the settings of `store`; raises `BadInput` for a pause that is none."""

    def __init__(self, store: SettingsStore, preferences: Preferences, who: WhoPlays, score: Score) -> None:
        self._store, self._preferences, self._who = store, preferences, who
        self._struck: deque[Hit] = deque(maxlen=_REMEMBERED)
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
        if isinstance(event, Hit):
            self._struck.append(event)
        if self._who.is_open:
            self._who.handle(event)
            return self._ask_who_plays(event, on=False)
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
        return self._pause(event, practice)

    def _pause(self, event: EngineEvent, practice: CurrentPractice) -> Pause | AskWhoPlays | None:
        """What a gesture that pauses asks for: that a session pauses or goes on, or between two who plays."""
        if not practice.is_playing:
            return self._ask_who_plays(event, on=True) if self._store.now.pads_switch else None
        strokes = self._pads.pauses(event)
        if strokes is None or not practice.is_session:
            return None
        self._pads.forget()
        return Pause(tuple(strokes))

    def _ask_who_plays(self, event: EngineEvent, on: bool) -> AskWhoPlays | None:
        """What pauses a session asks between two who plays, where no music leads to it."""
        strokes = self._pads.pauses(event)
        if strokes is None:
            return None
        self._pads.forget()
        first_ns = min((stroke.at_ns for stroke in strokes), default=0)
        before = [hit for hit in self._struck if hit not in strokes and hit.at_ns > first_ns - SILENCE_NS]
        return None if strokes and before else AskWhoPlays(on)


def _asked_by(store: SettingsStore) -> tuple[str, bool]:
    """The settings that say what pads ask for."""
    return store.now.pause, store.now.kicks_start

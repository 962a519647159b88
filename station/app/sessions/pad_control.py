"""What the kit asks for: two kicks start or go on, pads at once and foot switches pause, a pad chooses on the screen.

Between sessions, what pauses one asks who plays.

Pads ask for nothing in mid-drill but the gestures of a pause, and nothing at all while the kit is heard for something
else: a gesture to be learnt.
"""

from collections import deque
from dataclasses import replace

from station.app.actions.action import Action
from station.app.actions.practice_actions import Begin, Pause
from station.app.actions.settings_actions import AskWhoPlays
from station.app.sessions.current_practice import CurrentPractice
from station.app.sessions.screen_choice import Option, ScreenChoice
from station.app.sessions.who_plays import WhoPlays
from station.app.settings.preferences import Preferences
from station.app.settings.settings_store import SettingsStore
from station.core.events import Hit
from station.engine.messages import EngineEvent
from station.music.score import Score
from station.practice.control.pad_choice import ANSWERS, BEGINS, PadChoice
from station.practice.control.pad_commands import PadCommands
from station.practice.control.pad_gestures import BEFORE_NS

_REMEMBERED = 8
"""Strokes (our choice: as many as two hands strike at once, and some before)."""


class PadControl:
    """Takes every event of the engine, by the settings of `store`; raises `BadInput` for a pause that is none."""

    def __init__(self, store: SettingsStore, preferences: Preferences, who: WhoPlays, score: Score) -> None:
        self._store, self._preferences, self._who = store, preferences, who
        self._struck: deque[Hit] = deque(maxlen=_REMEMBERED)
        self._options: tuple[Option, ...] = ()
        self._is_question = self._kicks_choose = False
        self._choice: PadChoice | None = None
        self._might_start = True
        self._go_by(score)

    def _go_by(self, score: Score) -> None:
        self._by = _asked_by(self._store)
        self._pads = PadCommands(self._store.now, score)

    def forget(self) -> None:
        """What was struck so far means nothing."""
        self._pads.forget()

    def offer(self, choice: ScreenChoice | None, now_ns: int) -> None:
        """From now on `choice` is on the screen; the same as before goes on."""
        options = () if choice is None else choice.options
        self._is_question = choice is not None and bool(choice.question)
        self._kicks_choose = choice is not None and choice.kicks
        if options != self._options:
            self._options = options
            hears = any(option.pads for option in options)
            still = ANSWERS if self._is_question else BEGINS
            self._choice = PadChoice([option.pads for option in options], now_ns, still) if hears else None

    def heard(self, choice: ScreenChoice, now_ns: int) -> ScreenChoice:
        """The choice with what pads do to it now."""
        if self._choice is None or choice.options != self._options:
            return choice
        return replace(choice, hears=self._choice.hears(now_ns), meant=self._choice.meant)

    def handle(self, event: EngineEvent, practice: CurrentPractice) -> Action | None:
        """What `event` asks for, given what is practised; None for nothing."""
        score = practice.session.plan.score
        if isinstance(event, Hit):
            self._struck.append(event)
        if self._by != _asked_by(self._store):
            self._go_by(score)
        if not self._is_question and self._preferences.handle(event):
            self._pads.forget()
            return None
        self._pads.practise(score)
        has_kicked = self._pads.starts(event)
        chosen = self._choice.feed(event) if self._choice is not None and isinstance(event, Hit) else None
        if (asked := self._asked(has_kicked, chosen, practice)) is not None:
            return asked
        if not practice.is_playing:
            return self._who_plays(event)
        strokes = self._pads.pauses(event)
        if strokes is None or not practice.is_session:
            return None
        self._pads.forget()
        return Pause(tuple(strokes))

    def _who_plays(self, event: EngineEvent) -> AskWhoPlays | None:
        """Between sessions what pauses one asks who plays, where no music leads to it, and puts the list away."""
        strokes = self._pads.pauses(event)
        if strokes is None or not (self._who.is_open or (self._store.now.pads_switch and not self._is_question)):
            return None
        self._pads.forget()
        first_ns = min((stroke.at_ns for stroke in strokes), default=0)
        before = [hit for hit in self._struck if hit not in strokes and hit.at_ns > first_ns - BEFORE_NS]
        return None if strokes and before else AskWhoPlays(not self._who.is_open)

    def advance(self, now_ns: int, practice: CurrentPractice) -> Action | None:
        """What was asked for by `now_ns`: a gesture counts once nothing has come after it."""
        chosen = None if self._choice is None else self._choice.advance(now_ns)
        return self._asked(self._pads.starts_by(now_ns), chosen, practice)

    def _asked(self, has_kicked: bool, chosen: int | None, practice: CurrentPractice) -> Action | None:
        may_start = not practice.is_playing or (practice.is_session and practice.session.paused)
        if may_start is not self._might_start:  # two kicks of which one belonged to the music are none
            self._might_start, has_kicked = may_start, False
            self._pads.forget()
        if chosen is not None and self._options:
            return self._options[chosen].action
        if not has_kicked or not may_start or self._is_question:
            return None
        if practice.is_session:
            return Pause()
        return self._options[0].action if self._options and self._kicks_choose else Begin()


def _asked_by(store: SettingsStore) -> tuple[str, bool]:
    """The settings that say what pads ask for."""
    return store.now.pause, store.now.kicks_start

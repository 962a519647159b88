"""What the kit asks of the room: two kicks start or go on, pads at once and foot switches pause, gestures are learnt.

Pads command nothing in mid-drill but the gestures of a pause, and nothing at all while the kit is heard for something
else: an answer, or a gesture to be learnt.
"""

from station.app.goings_on import GoingsOn
from station.app.preferences import PracticePreferences, Preferences
from station.app.session_preparation import SessionPreparation
from station.engine.messages import EngineEvent
from station.practice.control.pad_commands import PadCommands


class KitCommands:
    """What the kit asks, by the habits of what is `prepared`; raises `BadInput` for a pause that is none.

    The habits change both: sessions go so from then on, and one that runs waits as it began.
    """

    def __init__(self, prepared: SessionPreparation, goings_on: GoingsOn) -> None:
        self._prepared, self._goings_on = prepared, goings_on
        self.habits = Preferences(prepared.settings, self._accustom)
        self._pads = self._by_habit()
        self._is_wanted = False

    def _by_habit(self) -> PadCommands:
        return PadCommands(self._prepared.settings, self._goings_on.run.plan.score)

    def _accustom(self, habits: PracticePreferences) -> None:
        self._prepared.settings = habits.within(self._prepared.settings)
        self._pads = self._by_habit()

    def wants_start(self) -> bool:
        """Whether two kicks have asked for what Enter starts; said once."""
        wanted, self._is_wanted = self._is_wanted, False
        return wanted

    def take(self, event: EngineEvent) -> None:
        """Do what `event` asks for: a session goes on or waits, kicks start what is quiet; a question has the pads."""
        goings_on, run = self._goings_on, self._goings_on.run
        if goings_on.outcome.is_asking or self.habits.take(event):
            self._pads.forget()
            return
        self._pads.practise(run.plan.score)
        if (not goings_on.is_playing or (goings_on.is_session and run.paused)) and self._pads.starts(event):
            self._is_wanted = not goings_on.is_session
            self.turn()
            return
        command = self._pads.pauses(event)
        if command is not None and goings_on.is_session:
            self._pads.forget()
            run.go_on() if run.paused else run.hold(command)

    def turn(self) -> None:
        """Pause the session, or let it go on; nothing where there is none."""
        if self._goings_on.is_session:
            run = self._goings_on.run
            self._pads.forget()
            run.go_on() if run.paused else run.hold()

"""The pauses of a session that has no window: pads and foot switches ask for them, silence too; the kit goes on again.

What may pause is the settings' word, as in the window: two pads at once or a switch pause and go on, two kicks go on.
"""

from collections.abc import Sequence

from station.core.events import Hit
from station.core.settings import Settings
from station.engine.messages import Command, EngineEvent
from station.music.score import Score
from station.practice.control.pad_commands import PadCommands
from station.practice.session.session import Session


class PadPause:
    """Hand it every event after the session, and ask now and then; what it returns is for the engine.

    `whole`: a pass that moves the tempo is taken whole after a pause. `attended`: somebody sits there who can go on,
    so that silence may pause too, if the settings let it. Raises `BadInput` for a pause in `settings` that is none.
    """

    def __init__(self, settings: Settings, score: Score, whole: bool = False, attended: bool = False) -> None:
        self._pads = PadCommands(settings, score)
        self._whole = whole
        self._was_asked = False
        ways = [*(["two kicks"] if settings.kicks_start else []), *settings.pause.split()]
        self.waits = attended and settings.auto_pause and bool(ways)
        """Whether a session shall wait for a student who has stopped."""
        self.words = f"paused: {' or '.join(ways)} to go on, Ctrl-C to end"
        """What to tell whoever has paused."""

    def take(self, session: Session, event: EngineEvent) -> Sequence[Command]:
        """Do what `event` asks for."""
        self._pads.practise(session.plan.score)
        if session.paused and self._pads.starts(event):
            return self._go_on(session)
        command = self._pads.pauses(event)
        if command is None:
            return ()
        self._pads.forget()
        return self._go_on(session) if session.paused else self._hold(session, command, asked=True)

    def look(self, session: Session) -> Sequence[Command]:
        """Wait for a student who has stopped."""
        return self._hold(session, (), asked=False) if session.waits and session.is_left else ()

    def _hold(self, session: Session, command: Sequence[Hit], asked: bool) -> Sequence[Command]:
        self._was_asked = asked
        return session.pause(command)

    def _go_on(self, session: Session) -> Sequence[Command]:
        self._pads.forget()
        return session.resume(self._was_asked, whole=self._whole)

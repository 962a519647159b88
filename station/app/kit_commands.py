"""What the kit asks of the room: two kicks start or go on, pads at once and foot switches pause, gestures are learnt.

Pads command nothing in mid-drill but the gestures of a pause, and nothing at all while the kit is heard for something
else: an answer, or a gesture to be learnt.
"""

from collections.abc import Callable

from station.app.habits import HabitDesk, Habits
from station.app.lesson_run import LessonRun
from station.core.settings import Settings
from station.engine.messages import EngineEvent
from station.music.score import Score
from station.practice.pad_commands import PadCommands


class KitCommands:
    """By the `habits` of `settings`, `changed` where they do; raises `BadInput` for a pause that is none."""

    def __init__(self, settings: Settings, score: Score, changed: Callable[[Habits], None]) -> None:
        self.habits = HabitDesk(settings, changed)
        self._pads = PadCommands(settings, score)
        self._is_wanted = False

    def accustom(self, settings: Settings, score: Score) -> None:
        """Go by other settings from now on."""
        self._pads = PadCommands(settings, score)

    def forget(self) -> None:
        """What was struck so far means nothing."""
        self._pads.forget()

    def wants_start(self) -> bool:
        """Whether two kicks have asked for what Enter starts; said once."""
        wanted, self._is_wanted = self._is_wanted, False
        return wanted

    def take(self, event: EngineEvent, run: LessonRun, is_running: bool, is_quiet: bool) -> None:
        """Do what `event` asks of `run`, which goes on or waits where it `is_running`; kicks start what is quiet."""
        if self.habits.take(event):
            self.forget()
            return
        self._pads.practise(run.plan.score)
        if (is_quiet or (is_running and run.paused)) and self._pads.starts(event):
            self._is_wanted = not is_running
            if is_running:
                self.turn(run)
            return
        command = self._pads.pauses(event)
        if command is not None and is_running:
            self.forget()
            run.go_on() if run.paused else run.hold(command)

    def turn(self, run: LessonRun) -> None:
        """Pause `run`, or let it go on."""
        self.forget()
        run.go_on() if run.paused else run.hold()

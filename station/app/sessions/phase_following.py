"""The sticks of a session are tracked: a model made meanwhile, sent to the engine, its phases heard.

The model of a section takes some seconds to make, on the thread that makes drummers; until then, and while the student
is not found, the drummer goes by the clock. The model is of the section at its first tempo: where the tempo follows the
student, the tracker finds theirs from half to double of it, and places are turned into those of the newer pass.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from contextlib import suppress

from station.app.engine_client import EngineClient
from station.core.errors import BadInput, DeviceError
from station.core.events import Hit, PhaseEstimate
from station.core.units import NS_PER_S
from station.engine.messages import Command, EngineEvent, TrackPhase
from station.music.score import Score
from station.practice.session.runner import SessionRunner
from station.scenes.session_part import AHEAD
from station.sync.drill.drill_model import DrillModel
from station.sync.drill.drummed_model import shipped_model
from station.sync.drill.phase_clock import PhaseClock
from station.sync.sonification.trigger_table import drill_triggers


class PhaseFollowing:
    """For the session of `runner`, to its end; `notify` hears why there is nothing to follow.

    With `sounds` the phase lets the section's strokes sound.
    """

    def __init__(
        self, engine: EngineClient, runner: SessionRunner, notify: Callable[[str], None], sounds: bool = False
    ) -> None:
        self._engine, self._runner, self._notify, self._sounds = engine, runner, notify, sounds
        section = self._section = runner.session.plan.section
        self._coming: Future[DrillModel] | None = AHEAD.submit(lambda: shipped_model(section))
        self._clock: PhaseClock | None = None
        self._loop_s = section.length_ns / NS_PER_S

    def handle(self, event: EngineEvent) -> None:
        """Take in a phase, or a stroke on the kit."""
        if self._clock is None:
            return
        if isinstance(event, PhaseEstimate):
            self._clock.handle(event)
        elif isinstance(event, Hit):
            self._clock.hit(event)

    def advance(self, now_ns: int, section: Score, clock_s: float | None) -> float | None:
        """Move on to `now_ns`; returns where in the passes of `section` the student is, None where nobody knows.

        `clock_s` is where the session's own clock is in them, None outside of them.
        """
        self._take_model()
        if self._clock is None or clock_s is None:
            return None
        stretched = section.length_ns / NS_PER_S / self._loop_s
        self._clock.advance(now_ns, clock_s / stretched)
        place_s = self._clock.position_s
        return None if place_s is None else place_s * stretched

    def end(self) -> None:
        """The engine need not track any longer."""
        self._coming = None
        self._send((TrackPhase(None),))

    def _take_model(self) -> None:
        if self._coming is None or not self._coming.done():
            return
        coming, self._coming = self._coming, None
        try:
            model = coming.result()
        except BadInput as fault:
            self._notify(str(fault))
            return
        self._clock = PhaseClock(model)
        triggers = drill_triggers(self._section, model.repeats) if self._sounds else ()
        self._send(self._runner.track(self._section, model, triggers))

    def _send(self, commands: Sequence[Command]) -> None:
        with suppress(DeviceError):  # a dead engine says so itself
            for command in commands:
                self._engine.send(command)

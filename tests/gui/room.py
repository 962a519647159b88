"""A station whose engine runs in this process, on a clock that moves by one step a frame.

Everything is the station's own: engine, session, controller, window. Only time is played: a session takes as many
frames as it has steps, however slowly they are drawn, and a virtual student's MIDI bytes arrive at their times.
"""

import sys
from collections.abc import Sequence
from math import degrees

from station.app.child_programs import ChildPrograms
from station.app.controller import Controller
from station.app.equipment.calibration import Message
from station.app.equipment.calibration_results import CalibrationResult, CalibrationResults
from station.app.equipment.latency_methods import MeasureRequest
from station.app.sessions.launch import Launch
from station.app.settings.settings_store import SettingsStore
from station.core.errors import DeviceError
from station.core.events import DeviceFound
from station.core.imu import STANDARD_GRAVITY_M_S2, ImuSample
from station.core.units import NS_PER_S
from station.devices.mapping.device_file import own_kit
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.devices.mapping.stick_file import own_stick
from station.drills.library import find_lesson
from station.engine.engine import Engine
from station.engine.latency_measurement import Devices
from station.engine.messages import Command, EngineEvent, KeyHit, Play, Ready, SetSounds, SoundsSet
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.simulation.student_spec import StudentSpec
from station.simulation.virtual_student import play
from station.sound.calibration.latency_estimate import LatencyEstimate
from tests.fakes.imu_speech import Measured, x_imu3

KIT, OUTPUT = "virtual student", "Speakers"


class FrameClock:
    """Moves on by `step_ns` whenever it is asked through `tick`."""

    def __init__(self, step_ns: int) -> None:
        self._now_ns = 0
        self._step_ns = step_ns

    def now_ns(self) -> int:
        return self._now_ns

    def tick(self) -> None:
        self._now_ns += self._step_ns


class DirectEngine:
    """The engine without its process; a student may be set to play the passes of a plan."""

    def __init__(self, clock: FrameClock, student: StudentSpec | None) -> None:
        self._engine = Engine(own_kit=own_kit, own_stick=own_stick)
        self._clock = clock
        self._student = student
        self._waiting: list[tuple[int, bytes]] = []
        self.sent: list[Command] = []
        self.plan: Plan | None = None
        self.strokes: Sequence[tuple[int, bytes]] = ()
        """What the kit plays whenever the transport starts, in nanoseconds from its zero."""
        self.refuses = ""
        """Why it takes no command, as an engine whose process is gone; empty while it does."""
        self._engine.use_preset(KIT, GENERAL_MIDI_PRESET)
        self._engine.device_found(KIT, clock.now_ns())
        self._told: list[EngineEvent] = [Ready(OUTPUT, 48_000)]

    def send(self, command: Command) -> None:
        if self.refuses:
            raise DeviceError(self.refuses)
        self.sent.append(command)
        self._engine.handle(command)
        if isinstance(command, SetSounds):
            self._told.append(SoundsSet(command.drums, command.click))
        if isinstance(command, Play) and self.strokes:
            zero_ns = self._clock.now_ns() + command.start_in_ns
            self._waiting = [(zero_ns + at, data) for at, data in self.strokes]
        elif isinstance(command, Play) and self._student is not None and self.plan is not None:
            zero_ns = self._clock.now_ns() + command.start_in_ns + self.plan.passes_start_ns
            self._waiting = [(zero_ns + at, data) for at, data in play(self.plan.score, self._student).midi]

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        del wait_s
        self._clock.tick()
        due = [(at, data) for at, data in self._waiting if at <= self._clock.now_ns()]
        self._waiting = self._waiting[len(due) :]
        for at_ns, data in due:
            self._engine.feed(KIT, data, at_ns)
        told, self._told = self._told, []
        return [*told, *self._engine.advance(self._clock.now_ns())]

    def close(self) -> None:
        """Its devices are free; what wakes next finds them again."""
        self._told = [Ready(OUTPUT, 48_000), DeviceFound(self._clock.now_ns(), KIT)]

    def play_bytes(self, text: str) -> None:
        """The kit sends bytes (hex) now."""
        self._engine.feed(KIT, bytes.fromhex(text), self._clock.now_ns())

    def will_play(self, strokes: Sequence[tuple[int, bytes]]) -> None:
        """The kit sends these bytes too, at these session times."""
        self._waiting = sorted([*self._waiting, *strokes])

    def plug_stick(self, device: str) -> None:
        """A sensor is here."""
        self._engine.sensor_found(device, self._clock.now_ns())

    def move_stick(self, device: str, samples: Sequence[ImuSample]) -> None:
        """The sensor says (in x-IMU3's binary) what it has measured until now, the last sample now."""
        for sample in samples:
            t_s, back_ns = 1.0 + sample.at_ns / NS_PER_S, samples[-1].at_ns - sample.at_ns
            assert sample.rate_rad_s is not None
            x, y, z = (each / STANDARD_GRAVITY_M_S2 for each in sample.acceleration_m_s2)
            p, q, r = map(degrees, sample.rate_rad_s)
            said = x_imu3(Measured(t_s, (x, y, z), (p, q, r)))
            self._engine.feed(device, said, self._clock.now_ns() - back_ns)

    @property
    def keys(self) -> list[KeyHit]:
        return [command for command in self.sent if isinstance(command, KeyHit)]


FILMS = "import sys; words = sys.argv; open(words[words.index('--out') + 1], 'w').write(words[1])"
"""Stands in for what films: its video says what was filmed."""


class Measurement:
    """Stands in for the process that measures: a measurement by strikes that finds something in doubt.

    It says a line at once, and what it found when it is asked for the 30th time, as if the pads were struck by then.
    """

    def __init__(self, request: MeasureRequest) -> None:
        doubtful = LatencyEstimate(4.0, -1.0, 9.0, 8.0, 12, ("the strokes scatter by 8 ms",))
        found = CalibrationResults(Devices(kit=KIT), (CalibrationResult("kit", KIT, doubtful),))
        self._says: list[list[Message]] = [["strike each pad"], *([] for _ in range(28)), [found]]
        self.by = request.by

    def messages(self) -> list[Message]:
        return self._says.pop(0) if self._says else []

    def end(self) -> None:
        pass


def station(
    lesson: str, options: PlanOptions, store: SettingsStore, student: StudentSpec | None, step_ns: int
) -> tuple[Controller, DirectEngine, FrameClock]:
    """A station that opens on `lesson`, its engine, and the clock that both go by."""
    clock = FrameClock(step_ns)
    engine = DirectEngine(clock, student)
    plan = plan_practice(find_lesson(lesson), options)
    engine.plan = plan
    processes = ChildPrograms(lambda: engine, Measurement, (sys.executable, "-c", FILMS))
    return Controller(processes, store, Launch(plan)), engine, clock

"""What the station starts beside itself, each in a process of its own."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from station.app.engine_client import WakeEngine
from station.app.equipment.calibration import MeasuringProcess, Running
from station.app.export import ANIMATE
from station.app.worker_process import StartWork, WorkerProcess

if TYPE_CHECKING:
    from station.app.equipment.latency_methods import MeasureRequest


@dataclass(frozen=True, slots=True)
class ChildPrograms:
    """How each is started: `engine` wakes an engine, `measure` begins a measurement, `animate` is a film's command.

    `work` reads and writes files.
    """

    engine: WakeEngine
    measure: "Callable[[MeasureRequest], Running]" = MeasuringProcess
    animate: Sequence[str] = ANIMATE
    work: StartWork = WorkerProcess

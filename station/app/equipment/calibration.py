"""Measuring latency from the window: in a process of its own, while the engine rests; nothing is stored unasked.

The engine has the sound card and the kit for itself: it is put to rest before and woken after. What was said and found
is kept here for the page; `keep` subtracts it from then on, only when the user says so. What measures is heavy, and not
imported before it is wanted: the window would open later by a fifth.
"""

import multiprocessing as mp
from collections.abc import Callable
from dataclasses import dataclass
from datetime import date
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, TypeAlias

from station.core.errors import DeviceError, StationError
from station.core.measured_latency import StoredCalibration, load_calibration, save_calibration

if TYPE_CHECKING:
    from station.app.equipment.calibration_results import CalibrationResult, CalibrationResults
    from station.app.equipment.latency_methods import MeasureRequest
    from station.practice.lag.session_lag import SessionLag
    from station.practice.session.device_latency import Latency

_ENDED = "the measurement ended without a result"


@dataclass(frozen=True, slots=True)
class Failed:
    """Why nothing could be measured, in a line."""

    why: str


Message: TypeAlias = "str | CalibrationResults | Failed"
"""What a measurement says: lines for the user, and at last what it found or why it did not."""


class Running(Protocol):
    """A measurement that runs."""

    def messages(self) -> "list[Message]":
        """What it has said since the last call."""
        ...

    def end(self) -> None:
        """End it, wherever it is."""
        ...


class MeasuringProcess:
    """A measurement in a process of its own; raises `DeviceError` where the system has none to give."""

    def __init__(self, request: "MeasureRequest") -> None:
        context = mp.get_context("spawn")
        self._from, to = context.Pipe(duplex=False)
        self._process = context.Process(target=_measure, args=(to, request), daemon=True)
        try:
            self._process.start()
        except OSError as fault:
            raise DeviceError(f"nothing can be measured: {fault.strerror or fault}") from fault
        finally:
            to.close()

    def messages(self) -> "list[Message]":
        """What has come through the pipe; a process that died has failed."""
        said: list[Message] = []
        try:
            while self._from.poll():
                said.append(self._from.recv())
        except (EOFError, OSError):
            said.append(Failed(_ENDED))
        return said

    def end(self) -> None:
        """Kill it if it still runs."""
        self._process.kill()
        self._process.join()
        self._from.close()


def _measure(to: Connection, request: "MeasureRequest") -> None:
    """What the process does."""
    from station.app.equipment.latency_methods import measured

    try:
        to.send(measured(request, load_calibration(), to.send))
    except StationError as fault:
        to.send(Failed(str(fault)))


@dataclass(frozen=True, slots=True)
class CalibrationView:
    """What the devices page shows: `known` of the devices, and of a measurement that `runs` its `lines`.

    After it `found` says in lines what was found, or `fault` why nothing was; `is_worth` whether judgement could
    subtract it, `trusted` whether nothing speaks against that.
    """

    known: StoredCalibration
    runs: bool = False
    lines: tuple[str, ...] = ()
    fault: str = ""
    found: tuple[str, ...] = ()
    is_worth: bool = False
    trusted: bool = True


class Calibration:
    """One measurement after the other; `rest` and `wake` are the engine's, `start` begins a measurement.

    `rest` returns what says whether the engine has let its devices go.
    """

    def __init__(
        self,
        rest: Callable[[], Callable[[], bool]],
        wake: Callable[[], None],
        start: "Callable[[MeasureRequest], Running]" = MeasuringProcess,
        path: Path | None = None,
    ) -> None:
        self._rest, self._wake, self._start, self._path = rest, wake, start, path
        self._running: Running | None = None
        self._request: MeasureRequest | None = None  # what waits for the devices
        self._are_free: Callable[[], bool] = lambda: True
        self._by = ""
        self.lines: list[str] = []
        self.fault = ""
        self.findings: CalibrationResults | None = None
        self._found: tuple[str, ...] = ()
        self._known = StoredCalibration()

    def view(self) -> CalibrationView:
        """What the page shows now."""
        is_worth = bool(self.worth)
        return CalibrationView(
            self._known, self.runs, tuple(self.lines), self.fault, self._found, is_worth, self.trusted
        )

    def look_up(self) -> None:
        """Read anew what is known of the devices; raises `BadInput` for a file that is not ours."""
        self._known = StoredCalibration()
        self._known = load_calibration(self._path)

    @property
    def runs(self) -> bool:
        """Whether something is being measured."""
        return self._running is not None or self._request is not None

    def measure(self, request: "MeasureRequest") -> None:
        """Begin as soon as the engine rests; raises `DeviceError` where that cannot be."""
        self.refuse()
        self._are_free = self._rest()
        self.drop()
        self._by, self._request = request.by, request
        self._begin()

    def _begin(self) -> None:
        """Begin with what waits for the devices, if they are free."""
        if self._request is None or not self._are_free():
            return
        request, self._request = self._request, None
        try:
            self._running = self._start(request)
        except DeviceError:
            self._wake()
            raise

    def advance(self) -> None:
        """Take in what was said; at its end the engine wakes. Raises `StationError` where it does not."""
        self._begin()
        if self._running is None:
            return
        for message in self._running.messages():
            if isinstance(message, str):
                self.lines.append(message)
                continue
            try:
                self._end_with(message)
            finally:
                self.cancel()
            return

    def _end_with(self, message: "CalibrationResults | Failed") -> None:
        if isinstance(message, Failed):
            self.fault = message.why
            return
        from station.app.equipment.calibration_results import text

        self.findings = message
        self._found = tuple(line.strip() for line in text(message, load_calibration(self._path)).splitlines())

    def cancel(self) -> None:
        """End what runs, and wake the engine; what was found stays."""
        if self.runs:
            self.close()
            self._wake()

    def close(self) -> None:
        """End what runs, and let the engine sleep: the window closes."""
        self._request = None
        if self._running is not None:
            self._running.end()
            self._running = None

    def refuse(self) -> None:
        """Raise `DeviceError` while something is being measured: nothing else may sound."""
        if self.runs:
            raise DeviceError("a device is being measured: wait for it, or cancel it on the Devices page")

    def drop(self) -> None:
        """Forget what was said and found."""
        self.lines, self.fault, self.findings, self._found = [], "", None, ()

    @property
    def worth(self) -> "list[CalibrationResult]":
        """What judgement could subtract; pads that are in doubt go with their kit."""
        rows = () if self.findings is None else self.findings.rows
        return [row for row in rows if row.storable and (row.estimate.trusted or row.what != "pad")]

    @property
    def trusted(self) -> bool:
        """Whether nothing speaks against any of that."""
        return all(row.estimate.trusted for row in self.worth)

    def answer_lag(self, lag: "SessionLag", latency: "Latency", take_out: bool) -> str:
        """Subtract a `lag` that was found with `latency` taken out, or ask no more of it; returns what to show."""
        from station.app.equipment.lag_answer import with_lag_left, with_lag_out

        before = load_calibration(self._path)
        assert lag.target is not None, "only what is nobody's own is offered"
        after = with_lag_out(before, lag, latency, date.today()) if take_out else with_lag_left(before, lag.target)
        path = save_calibration(after, self._path)
        done = f"{lag.found.lag_ms:.0f} ms are taken out from now on" if take_out else "left: it counts as yours"
        return f"{done} ({lag.target.name}, in {path}; Devices changes it)"

    def keep(self) -> str:
        """Subtract it from now on; returns what to show. Raises `StationError` if the file refuses."""
        from station.app.equipment.calibration_results import outdated, with_rows

        before, rows = load_calibration(self._path), self.worth
        path = save_calibration(with_rows(before, rows, self._by, date.today()), self._path)
        forgotten = outdated(before, rows)
        self.drop()
        also = f"; what was tapped on {', '.join(forgotten)} is forgotten: tap again" if forgotten else ""
        return f"kept in {path}{also}"

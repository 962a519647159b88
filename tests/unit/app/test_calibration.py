"""Latency measured from the window: the engine rests meanwhile, and nothing is stored before the user says so."""

from collections.abc import Callable
from pathlib import Path

import pytest

from station.app.actions.action import Show
from station.app.actions.equipment_actions import Measure
from station.app.actions.practice_actions import Begin
from station.app.equipment.calibration import Calibration, Failed, MeasuringProcess, Message
from station.app.equipment.calibration_results import CalibrationResult, CalibrationResults
from station.app.equipment.latency_methods import MeasureRequest
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.core.errors import DeviceError
from station.core.events import DeviceFound
from station.core.measured_latency import LOOPBACK, STRIKE, TAP, load_calibration
from station.core.pieces import Piece
from station.core.settings import Settings
from station.engine.latency_measurement import Devices
from station.engine.messages import Ready
from station.sound.calibration.latency_estimate import LatencyEstimate
from tests.fakes.stations import Line, room, station_on, store_with
from tests.unit.app.test_controller import PLAN

GOOD = LatencyEstimate(4.0, 3.5, 4.5, 0.8, 20)
POOR = GOOD.doubted("it scatters")


class Measurement:
    """A measurement that says what it is given to say."""

    def __init__(self, *says: Message) -> None:
        self.says = list(says)
        self.ended = False

    def messages(self) -> list[Message]:
        said, self.says = self.says, []
        return said

    def end(self) -> None:
        self.ended = True


def desk_over(measurement: Measurement, path: Path) -> tuple[Calibration, list[str]]:
    done: list[str] = []
    calibration = Calibration(resting(done), lambda: done.append("wake"), lambda _: measurement, path)
    return calibration, done


def resting(done: list[str]) -> Callable[[], Callable[[], bool]]:
    """An engine that rests at once."""

    def rest() -> Callable[[], bool]:
        done.append("rest")
        return lambda: True

    return rest


def request_by(by: str) -> MeasureRequest:
    return MeasureRequest.of(Settings(), by)


def test_the_engine_rests_while_it_is_measured_and_nothing_is_stored_unasked(tmp_path: Path) -> None:
    path = tmp_path / "calibration.toml"
    measurement = Measurement("chirps, 1 of 3")
    calibration, done = desk_over(measurement, path)
    calibration.measure(request_by(LOOPBACK))
    calibration.advance()
    assert (calibration.runs, calibration.lines, done) == (True, ["chirps, 1 of 3"], ["rest"])
    with pytest.raises(DeviceError, match="being measured"):
        calibration.refuse()
    measurement.says = [
        "chirps, 2 of 3",
        CalibrationResults(Devices(output="card"), (CalibrationResult("output", "card", GOOD),)),
    ]
    calibration.advance()
    assert (calibration.runs, done, measurement.ended) == (False, ["rest", "wake"], True)
    assert calibration.trusted
    assert not path.exists()
    assert calibration.keep() == f"kept in {path}"
    assert load_calibration(path).outputs["card"].latency_ms == 4.0
    assert calibration.findings is None


def test_what_measures_waits_until_the_engine_has_let_its_devices_go(tmp_path: Path) -> None:
    are_free, begun = [False], list[str]()

    def start(request: MeasureRequest) -> Measurement:
        begun.append(request.by)
        return Measurement()

    calibration = Calibration(lambda: lambda: are_free[0], lambda: begun.append("wake"), start, tmp_path / "c.toml")
    calibration.measure(request_by(TAP))
    calibration.advance()
    assert (calibration.runs, begun) == (True, [])
    are_free[0] = True
    calibration.advance()
    assert (calibration.runs, begun) == (True, ["tap"])
    calibration.cancel()
    are_free[0] = False
    calibration.measure(request_by(TAP))
    calibration.cancel()
    calibration.advance()
    assert (calibration.runs, begun) == (False, ["tap", "wake", "wake"])


def test_a_window_that_closes_ends_the_measurement_and_wakes_nothing(tmp_path: Path) -> None:
    measurement = Measurement("chirps, 1 of 3")
    calibration, done = desk_over(measurement, tmp_path / "calibration.toml")
    calibration.measure(request_by(LOOPBACK))
    calibration.close()
    assert (measurement.ended, calibration.runs, done) == (True, False, ["rest"])
    calibration.close()


def test_what_is_in_doubt_is_stored_with_its_doubts_and_a_doubtful_pad_not_at_all(tmp_path: Path) -> None:
    rows = (
        CalibrationResult("kit", "TD-17", POOR),
        CalibrationResult("pad", "TD-17", GOOD, Piece.SNARE),
        CalibrationResult("pad", "TD-17", POOR, Piece.KICK),
    )
    calibration, _ = desk_over(
        Measurement(CalibrationResults(Devices(kit="TD-17"), rows)), tmp_path / "calibration.toml"
    )
    calibration.measure(request_by(STRIKE))
    calibration.advance()
    assert not calibration.trusted
    calibration.keep()
    kept = load_calibration(tmp_path / "calibration.toml").kits["TD-17"]
    assert (kept.kit.doubts, kept.kit.by) == ("it scatters", "strike")
    assert list(kept.pads) == [Piece.SNARE]


def test_a_failure_is_one_line_and_the_engine_wakes(tmp_path: Path) -> None:
    calibration, done = desk_over(Measurement(Failed("no kit is plugged in")), tmp_path / "calibration.toml")
    calibration.measure(request_by(TAP))
    calibration.advance()
    assert (calibration.fault, calibration.runs, done) == ("no kit is plugged in", False, ["rest", "wake"])
    assert calibration.worth == []


def test_a_measurement_can_be_cancelled_and_forgotten(tmp_path: Path) -> None:
    measurement = Measurement("strike one pad")
    calibration, done = desk_over(measurement, tmp_path / "calibration.toml")
    calibration.measure(request_by(TAP))
    calibration.advance()
    calibration.cancel()
    assert (measurement.ended, calibration.runs, done) == (True, False, ["rest", "wake"])
    calibration.drop()
    assert (calibration.lines, calibration.findings) == ([], None)


def test_a_process_that_dies_has_failed() -> None:
    """No way of that name is known: the child ends without a word."""
    process = MeasuringProcess(request_by("no such way"))
    said: list[Message] = []
    while not said:
        said = process.messages()
    process.end()
    assert said == [Failed("the measurement ended without a result")]


def test_the_engine_lets_its_devices_go_and_takes_them_again(tmp_path: Path) -> None:
    first, second = Line(), Line()
    measurement = Measurement("strike one pad")
    station = station_on([first, second], store_with(tmp_path), Launch(PLAN), lambda _: measurement)
    station.dispatch(Show(devices=True))
    first.says += [Ready("Speakers", 48_000), DeviceFound(0, "TD-17")]
    station.update(1)
    assert (room(station).kit, station.view().mapping.devices) == ("TD-17", ("TD-17",))
    station.dispatch(Measure(TAP))
    while not first.dead:  # on a thread: no frame waits for it
        station.update(1)
    assert (room(station).kit, station.view().mapping.devices) == ("", ())
    station.update(2)
    for action in (Begin(), Measure(TAP)):
        station.dispatch(action)
        station.update(2)
        assert "being measured" in station.view().toast
        assert room(station).stage is Stage.IDLE
    measurement.says.append(Failed("no kit"))
    while station.view().calibration.runs:
        station.update(3)
    second.says += [Ready("Speakers", 48_000), DeviceFound(4, "TD-17")]
    station.update(5)
    assert (room(station).kit, room(station).sound) == ("TD-17", "Speakers")
    assert station.view().calibration.fault == "no kit"


def test_nothing_is_measured_while_somebody_plays(tmp_path: Path) -> None:
    station = station_on([Line()], store_with(tmp_path), Launch(PLAN))
    station.dispatch(Begin())
    station.dispatch(Measure(TAP))
    station.update(1)
    assert "end the session first" in station.view().toast


def test_a_measurement_that_cannot_begin_lets_the_engine_wake(tmp_path: Path) -> None:
    def start(_: MeasureRequest) -> Measurement:
        raise DeviceError("nothing can be measured: too many processes")

    done: list[str] = []
    calibration = Calibration(resting(done), lambda: done.append("wake"), start, tmp_path / "c.toml")
    with pytest.raises(DeviceError, match="too many processes"):
        calibration.measure(request_by(TAP))
    assert (calibration.runs, done) == (False, ["rest", "wake"])

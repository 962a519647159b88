"""How late devices are, and what the pages that are shown listen to."""

from typing import assert_never

from station.app.actions.action import Show
from station.app.actions.equipment_actions import (
    AnswerLag,
    CalibrationAction,
    CancelMeasuring,
    ForgetMeasured,
    KeepMeasured,
    Measure,
)
from station.app.sessions.lag_answered import judged_again
from station.app.station_parts import StationParts
from station.core.measured_latency import load_calibration
from station.practice.session.device_latency import latency_of


def measure(parts: StationParts, action: CalibrationAction) -> str | None:
    """Measure latency, and have sessions trust what is kept; returns a line for the user."""
    match action:
        case Measure(by, distance_m):
            from station.app.equipment.latency_methods import MeasureRequest

            parts.calibration.measure(MeasureRequest.of(parts.store.now, by, distance_m))
        case CancelMeasuring():
            parts.calibration.cancel()
        case KeepMeasured():
            line = parts.calibration.keep()
            parts.sessions.trust(latency_of(parts.store.now, load_calibration()))
            parts.toasts.notify(line)
            parts.calibration.look_up()
        case ForgetMeasured():
            parts.calibration.drop()
        case AnswerLag(take_out):
            return _answer_lag(parts, take_out)
        case _:
            assert_never(action)
    return None


def _answer_lag(parts: StationParts, take_out: bool) -> str | None:
    """Take a lag out or leave it in, and judge the result that is shown again; returns a line for the user."""
    last = parts.sessions.practice.last_result
    saved = last.saved
    if last.lag_ms is None or saved is None or saved.fair is None or saved.fair.lag is None:
        return None
    line = parts.calibration.answer_lag(saved.fair.lag, saved.result.latency, take_out)
    latency = latency_of(parts.store.now, load_calibration())
    parts.sessions.trust(latency)
    judged = judged_again(saved, parts.store.now, latency if take_out else None)
    last.put(judged)
    parts.calibration.look_up()
    return line if judged.fault is None else str(judged.fault)


def show(parts: StationParts, action: Show) -> None:
    """Show these pages: what is seen listens and is read, what is left listens no more."""
    before, parts.shown = parts.shown, action
    parts.mapping.listen(action.devices)
    if not action.sticks:
        parts.sticks.give_up()
    if not action.practice:
        parts.preferences.learn(on=False)
    if action.catalog or action.today or action.teacher or action.assigned or action.history:
        parts.chooser.offer_all()
    if action.history and not before.history:
        parts.history.look_again()
    if action.sound and not before.sound:
        parts.sound.look()
    if before.sound and not action.sound:
        parts.sound.leave()
    if action.devices and not before.devices:
        parts.calibration.look_up()

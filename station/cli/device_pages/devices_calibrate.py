"""`station devices calibrate`: measure the latency of outputs and kits, print it, and store it only when asked to.

What is stored is subtracted by practice: of an output what its driver does not report, of a kit and its pads how much
later than played a stroke is stamped. docs/calibration.md says how to set up each way of measuring.
"""

from dataclasses import dataclass, replace
from datetime import date
from typing import TYPE_CHECKING

from station.cli.console import ask, is_attended, print_json, say, write
from station.cli.options.device_option import DEVICE_FORM, DEVICE_HELP
from station.cli.options.option_fields import choice, flag, option, unread
from station.core.errors import BadInput
from station.core.measured_latency import GROOVE, StoredCalibration, load_calibration, save_calibration
from station.core.settings import Settings, load_settings
from station.devices.device_ports import parse_device

if TYPE_CHECKING:
    from station.app.equipment.calibration_results import CalibrationResult
    from station.app.equipment.latency_methods import MeasureRequest
    from station.practice.lag.session_lag import LagTarget

WAYS = ("report", "loopback", "strike", "tap", GROOVE)
MOST_DISTANCE_M = 10.0


def _distance_m(text: str) -> float:
    try:
        metres = float(text)
    except ValueError:
        metres = -1.0
    if not 0.0 <= metres <= MOST_DISTANCE_M:
        raise unread(f"0 to {MOST_DISTANCE_M:g} metres", text)
    return metres


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibrateOptions:
    """What is measured, how, and whether it is stored."""

    by: str = choice(dict(zip(WAYS, WAYS, strict=True)), f"how to measure ({WAYS[0]})", WAYS[0])
    device: str | None = option(DEVICE_FORM, f"{DEVICE_HELP} (the first kit found)", str, None)
    output: str | None = option("NAME", "part of the sound output's name (the settings')", str, None)
    input: str = option("NAME", "part of the sound input's name (the default)", str, "")
    distance: float = option("M", "metres from the pads to the microphone (0)", _distance_m, 0.0)
    store: bool = flag("store what can be trusted without asking", rivals="store")
    store_anyway: bool = flag("store also what cannot be trusted", rivals="store")
    leave: bool = flag("let the lag that the last session found count as yours (with --by groove)", rivals="store")
    json: bool = flag("print one JSON document; stores only when told to")


def run(options: CalibrateOptions) -> int:
    """Measure, or take what the last session has found; print, and store what the user wants stored."""
    from station.app.equipment.calibration_results import document, outdated, text, with_rows
    from station.app.equipment.latency_methods import measured

    if options.leave and options.by != GROOVE:
        raise BadInput("--leave", "", f"goes with --by {GROOVE}: what else is measured is stored or not")
    settings, before = load_settings(), load_calibration()
    if options.by == GROOVE:
        from station.app.equipment.lag_answer import last_lag

        findings, target = last_lag(settings)
        if options.leave:
            return _leave(before, target)
    else:
        findings = measured(_request(options, settings), before, say)
    worth = [row for row in findings.rows if row.storable and (row.estimate.trusted or _insists(options, row))]
    if not options.json:
        write(text(findings, before), end="")
    stores = bool(worth) and _wants(options, worth)
    if stores:
        path = save_calibration(with_rows(before, worth, options.by, date.today()))
        say(f"stored in {path}")
        for name in outdated(before, worth):
            say(f"what was tapped on {name} is forgotten, for the kit's latency was in it: tap again")
    elif options.store and findings.rows:
        say("nothing is stored, for it cannot be trusted (--store-anyway stores it)")
    if options.json:
        print_json(document(options.by, findings, stores))
    return 0


def _leave(before: StoredCalibration, target: "LagTarget") -> int:
    """Let a lag on the device count as the student's."""
    from station.app.equipment.lag_answer import with_lag_left

    path = save_calibration(with_lag_left(before, target))
    say(f"{target.name} stays as it is: what is late on it counts as yours (left, in {path})")
    return 0


# --- measuring -------------------------------------------------------------------------------------------------------


def _request(options: CalibrateOptions, settings: Settings) -> "MeasureRequest":
    """On the devices that are asked for, else on the settings'."""
    from station.app.equipment.latency_methods import MeasureRequest

    request = MeasureRequest.of(settings, options.by, options.distance)
    output = settings.output if options.output is None else options.output
    kit = request.kit if options.device is None else parse_device(options.device)
    return replace(request, sound=replace(request.sound, output=output, input=options.input), kit=kit)


# --- storing ---------------------------------------------------------------------------------------------------------


def _insists(options: CalibrateOptions, row: "CalibrationResult") -> bool:
    """Whether a doubtful result is worth a question, or is to be stored unasked."""
    return options.store_anyway or not (options.store or options.json or row.what == "pad")


def _wants(options: CalibrateOptions, rows: "list[CalibrationResult]") -> bool:
    """Whether the user wants `rows` stored: said on the command line, or asked now; nobody there is a no."""
    if options.store or options.store_anyway:
        return True
    if options.json or not is_attended():
        say("nothing is stored; say --store to have it subtracted from now on")
        return False
    doubtful = "" if all(row.estimate.trusted for row in rows) else ", although it cannot be trusted"
    return ask(f"subtract it from now on{doubtful}? [y/N] ").casefold() in ("y", "yes")

"""`station devices calibrate`: measure the latency of outputs and kits, tell it, and store it only when asked to.

What is stored is subtracted by practice: of an output what its driver does not report, of a kit and its pads how much
later than played a stroke is stamped. docs/calibration.md says how to set up each way of measuring.
"""

import argparse
import sys
from dataclasses import replace
from datetime import date
from typing import TYPE_CHECKING

from station.cli.console import print_json, say
from station.cli.device_option import KIT_HELP
from station.core.measured_latency import load_calibration, save_calibration
from station.core.settings import Settings, load_settings

if TYPE_CHECKING:
    from station.app.calibration_results import CalibrationResult
    from station.app.latency_methods import MeasureRequest

WAYS = ("report", "loopback", "strike", "tap")
MOST_DISTANCE_M = 10.0


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this verb's words."""
    parser.add_argument("--by", choices=WAYS, default=WAYS[0], help="how to measure (%(default)s)")
    parser.add_argument("--kit", metavar="PORT", help=KIT_HELP.replace("; once a kit", ""))
    parser.add_argument("--output", metavar="DEVICE", help="part of the sound output's name (the settings')")
    parser.add_argument("--input", metavar="DEVICE", default="", help="part of the sound input's name (the default)")
    parser.add_argument(
        "--distance", type=_distance, default=0.0, metavar="M", help="metres from the pads to the microphone (0)"
    )
    store = parser.add_mutually_exclusive_group()
    store.add_argument("--store", action="store_true", help="store what can be trusted without asking")
    store.add_argument("--store-anyway", action="store_true", help="store also what cannot be trusted")
    parser.add_argument("--json", action="store_true", help="print one JSON document; stores only when told to")


def _distance(text: str) -> float:
    fault = argparse.ArgumentTypeError(f"{text}: expected 0 to {MOST_DISTANCE_M:g} metres")
    try:
        metres = float(text)
    except ValueError:
        raise fault from None
    if not 0.0 <= metres <= MOST_DISTANCE_M:
        raise fault
    return metres


def run(arguments: argparse.Namespace) -> int:
    """Measure, tell, and store what the user wants stored."""
    from station.app.calibration_results import document, outdated, text, with_rows
    from station.app.latency_methods import measured

    settings, before = load_settings(), load_calibration()
    findings = measured(_wish(arguments, settings), before, say)
    worth = [row for row in findings.rows if row.storable and (row.estimate.trusted or _insists(arguments, row))]
    if not arguments.json:
        sys.stdout.write(text(findings, before))
    stores = bool(worth) and _wants(arguments, worth)
    if stores:
        path = save_calibration(with_rows(before, worth, arguments.by, date.today()))
        say(f"stored in {path}")
        for name in outdated(before, worth):
            say(f"what was tapped on {name} is forgotten, for the kit's latency was in it: tap again")
    elif arguments.store and findings.rows:
        say("nothing is stored, for it cannot be trusted (--store-anyway stores it)")
    if arguments.json:
        print_json(document(arguments.by, findings, stores))
    return 0


# --- measuring -------------------------------------------------------------------------------------------------------


def _wish(arguments: argparse.Namespace, settings: Settings) -> "MeasureRequest":
    """On the devices that are asked for, else on the settings'."""
    from station.app.latency_methods import MeasureRequest
    from station.devices.device_ports import parse_kit

    wish = MeasureRequest.of(settings, arguments.by, arguments.distance)
    output = settings.output if arguments.output is None else arguments.output
    kit = wish.kit if arguments.kit is None else parse_kit(arguments.kit)
    return replace(wish, sound=replace(wish.sound, output=output, input=arguments.input), kit=kit)


# --- storing ---------------------------------------------------------------------------------------------------------


def _insists(arguments: argparse.Namespace, row: "CalibrationResult") -> bool:
    """Whether a doubtful result is worth a question, or is to be stored unasked."""
    return bool(arguments.store_anyway or not (arguments.store or arguments.json or row.what == "pad"))


def _wants(arguments: argparse.Namespace, rows: "list[CalibrationResult]") -> bool:
    """Whether the user wants `rows` stored: said on the command line, or asked now; nobody there is a no."""
    if arguments.store or arguments.store_anyway:
        return True
    if arguments.json or not sys.stdin.isatty():
        say("nothing is stored; say --store to have it subtracted from now on")
        return False
    doubtful = "" if all(row.estimate.trusted for row in rows) else ", although it cannot be trusted"
    sys.stderr.write(f"subtract it from now on{doubtful}? [y/N] ")
    sys.stderr.flush()
    return sys.stdin.readline().strip().casefold() in ("y", "yes")

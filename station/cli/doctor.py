"""`station doctor`: what works on this computer, and what to do about what does not."""

import argparse
import sys

from station.app.diagnostics import Check, all_findings
from station.cli.console import print_json

SCHEMA = "drum-station/doctor/1"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this command's words."""
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def run(arguments: argparse.Namespace) -> int:
    """Look at everything; a missing convenience is no failure, so the exit status is 0."""
    checks = all_findings()
    if arguments.json:
        rows = [{"name": c.name, "works": c.works, "finding": c.finding, "remedy": c.remedy} for c in checks]
        print_json({"schema": SCHEMA, "checks": rows})
        return 0
    for check in checks:
        sys.stdout.write(_lines(check))
    return 0


def _lines(check: Check) -> str:
    remedy = f"\n{'':18}-> {check.remedy}" if check.remedy else ""
    return f"{'ok ' if check.works else '-- '} {check.name:14}{check.finding}{remedy}\n"

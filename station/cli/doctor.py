"""`station doctor`: what works on this computer, and what to do about what does not."""

from dataclasses import dataclass

from station.app.equipment.diagnostics import Check, all_findings
from station.app.equipment.file_endings import register, unregister
from station.cli.console import print_json, write
from station.cli.options.option_fields import Command, flag

SCHEMA = "drum-station/doctor/1"


@dataclass(frozen=True, slots=True, kw_only=True)
class DoctorOptions:
    """How the findings are printed."""

    json: bool = flag("print one JSON document")
    register_files: bool = flag("have double clicks open assignments, returns, notes and takes", rivals="files")
    unregister_files: bool = flag("take that back", rivals="files")


def run(options: DoctorOptions) -> int:
    """Look at everything; a missing convenience is no failure, so the exit status is 0."""
    if options.register_files or options.unregister_files:
        for line in register() if options.register_files else unregister():
            write(line)
        return 0
    checks = all_findings()
    if options.json:
        rows = [{"name": c.name, "works": c.works, "finding": c.finding, "remedy": c.remedy} for c in checks]
        print_json({"schema": SCHEMA, "checks": rows})
        return 0
    for check in checks:
        write(_lines(check))
    return 0


def _lines(check: Check) -> str:
    remedy = f"\n{'':18}-> {check.remedy}" if check.remedy else ""
    return f"{'ok ' if check.works else '-- '} {check.name:14}{check.finding}{remedy}"


COMMAND = Command(DoctorOptions, run)

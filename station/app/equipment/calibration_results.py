"""What a measurement of latency found: as text, as a document, and as what is stored.

A row is one result: of an output, a kit, a pad, of equipment and habit together, of the equipment's share, or of the
habit. docs/calibration.md describes the document.
"""

from dataclasses import asdict, dataclass, replace
from datetime import date
from types import MappingProxyType

from station.core.labels import piece_name
from station.core.measured_latency import GROOVE, TAP, DeviceLatency, MeasuredLatency, StoredCalibration
from station.core.pieces import Piece, word
from station.engine.latency_measurement import Devices
from station.sound.calibration.latency_estimate import LatencyEstimate
from station.sound.calibration.stream_report import StreamReport
from station.sound.calibration.taps import Taps

SCHEMA = "drum-station/calibrate/1"
TAPPED = (TAP, GROOVE)
"""The ways of measuring in whose result kit, output and habit are one."""


@dataclass(frozen=True, slots=True)
class CalibrationResult:
    """One result: `what` it is of (output, kit, pad, together, equipment, habit), its device, and the estimate."""

    what: str
    device: str
    estimate: LatencyEstimate
    piece: Piece | None = None

    @property
    def storable(self) -> bool:
        """Whether judgement could subtract it."""
        return self.what in ("output", "kit", "pad", "equipment")


@dataclass(frozen=True, slots=True)
class CalibrationResults:
    """All that one measurement found."""

    devices: Devices
    rows: tuple[CalibrationResult, ...] = ()
    stream: StreamReport | None = None


def with_rows(before: StoredCalibration, rows: list[CalibrationResult], by: str, on: date) -> StoredCalibration:
    """What was known `before`, with `rows` as measured `by` a way `on` a day; pads go with their kit alone."""
    outputs = {name: known for name, known in before.outputs.items() if name not in outdated(before, rows)}
    after = replace(before, outputs=MappingProxyType(outputs))
    pads = {row.piece: _measured(row, by, on) for row in rows if row.piece is not None}
    for row in rows:
        if row.what in ("output", "equipment"):
            after = after.with_output(row.device, _measured(row, by, on))
        elif row.what == "kit":
            after = after.with_kit(row.device, DeviceLatency(_measured(row, by, on), MappingProxyType(pads)))
    return after


def outdated(before: StoredCalibration, rows: list[CalibrationResult]) -> list[str]:
    """The outputs whose latency was tapped, once a kit is measured: what they have was partly the kit's."""
    if not any(row.what == "kit" for row in rows):
        return []
    return [name for name, known in before.outputs.items() if known.by in TAPPED]


def _measured(row: CalibrationResult, by: str, on: date) -> MeasuredLatency:
    estimate = row.estimate
    doubts = "; ".join(estimate.doubts)
    return MeasuredLatency(round(estimate.value_ms, 3), round(estimate.half_ms, 3), by, on, doubts)


def rows_of_taps(
    found: Taps, piece: Piece, devices: Devices, before: StoredCalibration
) -> tuple[CalibrationResult, ...]:
    """What taps on `piece` say: what the kit is known to have is not the output's, what both have not the habit."""
    kit, output = before.kits.get(devices.kit or ""), before.outputs.get(devices.output or "")
    known_ms = kit.of_pad(piece).latency_ms if kit is not None else 0.0
    total = CalibrationResult("together", devices.kit or "", found.total)
    if kit is not None and output is not None and output.by not in TAPPED:
        return total, CalibrationResult("habit", devices.kit or "", found.habit(known_ms + output.latency_ms))
    return total, CalibrationResult("equipment", devices.output or "", found.equipment.less(known_ms))


# --- telling ---------------------------------------------------------------------------------------------------------


def document(by: str, findings: CalibrationResults, stored: bool) -> dict[str, object]:
    """What `--json` prints."""
    rows = [
        {
            "what": row.what,
            "device": row.device,
            "piece": None if row.piece is None else word(row.piece),
            "latency_ms": row.estimate.value_ms,
            "low_ms": row.estimate.low_ms,
            "high_ms": row.estimate.high_ms,
            "sd_ms": row.estimate.sd_ms,
            "count": row.estimate.count,
            "trusted": row.estimate.trusted,
            "doubts": list(row.estimate.doubts),
            "remarks": list(row.estimate.remarks),
        }
        for row in findings.rows
    ]
    stream = None if findings.stream is None else asdict(findings.stream)
    devices = asdict(findings.devices)
    return {"schema": SCHEMA, "by": by, **devices, "results": rows, "stream": stream, "stored": stored}


_NAMES = {
    "output": "sounds later than it reports by",
    "kit": "stamps strokes late by",
    "together": "equipment and your habit together",
    "equipment": "of that, the equipment's share may be",
    "habit": "of that, your own habit is",
}


def text(findings: CalibrationResults, before: StoredCalibration) -> str:
    """What a person reads; `before` is what was known of the devices."""
    lines = [_line(row) for row in findings.rows]
    if findings.stream is not None:
        lines.append(_stream_line(findings, before))
    return "".join(lines)


def _line(row: CalibrationResult) -> str:
    estimate = row.estimate
    name = _NAMES.get(row.what, "")
    head = f"{row.device}: {name}" if row.what in ("output", "kit") else name
    if row.piece is not None:
        head = f"  {piece_name(row.piece)}"
    figures = (
        f"{estimate.value_ms:+.1f} ms ({estimate.low_ms:+.1f} to {estimate.high_ms:+.1f}, {estimate.count} counted)"
    )
    doubts = "".join(f"\n    don't trust this: {doubt}" for doubt in estimate.doubts)
    remarks = "".join(f"\n    note: {remark}" for remark in estimate.remarks)
    return f"{head} {figures}{doubts}{remarks}\n"


def _stream_line(findings: CalibrationResults, before: StoredCalibration) -> str:
    stream, output = findings.stream, findings.devices.output or ""
    assert stream is not None, "asked for only where there is one"
    latency = "no latency" if not stream.latency_ms else f"a latency of {stream.latency_ms:.1f} ms"
    drift = "its drift is not known"
    if stream.drift_ppm is not None:
        drift = f"its clock runs {stream.drift_ppm:+.0f} ± {stream.drift_half_ppm:.0f} parts in a million fast"
    known = before.outputs.get(output)
    more = (
        f"measured {known.latency_ms:+.1f} ms more by {known.by}"
        if known is not None
        else "what it hides, --by loopback finds"
    )
    doubts = "".join(f"\n    don't trust this: {doubt}" for doubt in stream.doubts)
    return f"{output}: reports {latency}; {drift}; both are corrected already; {more}{doubts}\n"

"""What was measured of this user's devices: one TOML file beside the settings, read whole and written whole.

A table a sound output and a table a kit, by the device's name; a kit's pads have tables of their own within it. To
forget a measurement one deletes its table. Latencies are milliseconds, positive where a device is later than it
reports. A file that does not exist says nothing; a fault in it is named with its place.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import date
from pathlib import Path
from types import MappingProxyType
from typing import Any

from station.core.disk.files import NoSuchFile, write_whole
from station.core.pieces import Piece, word
from station.core.settings import settings_path
from station.core.toml.schema import (
    Field,
    Fields,
    Reader,
    day,
    key_of,
    list_of,
    members_by_label,
    needed,
    number,
    read,
    record,
    table_of,
    text,
)
from station.core.toml.toml_source import read_source
from station.core.toml.toml_write import toml_text, toml_value

FILE_NAME = "calibration.toml"
REPORT, LOOPBACK, STRIKE, TAP, GROOVE = "report", "loopback", "strike", "tap", "groove"
"""The ways to measure (docs/calibration.md)."""
MOST_MS = 1_000.0
"""No latency is greater (our choice: the settings' own bound)."""


@dataclass(frozen=True, slots=True)
class MeasuredLatency:
    """One latency: its value, half its 95 % interval, how (`by`) and when (`on`) it was measured, and any `doubts`."""

    latency_ms: float
    half_ms: float
    by: str
    on: date
    doubts: str = ""


@dataclass(frozen=True, slots=True)
class DeviceLatency:
    """A kit: the latency of its strokes, and of the pads that have one of their own."""

    kit: MeasuredLatency
    pads: Mapping[Piece, MeasuredLatency] = field(default_factory=lambda: MappingProxyType({}))

    def of_pad(self, piece: Piece) -> MeasuredLatency:
        """The pad's own latency, else the kit's."""
        return self.pads.get(piece, self.kit)


@dataclass(frozen=True, slots=True)
class StoredCalibration:
    """All that was measured, by the devices' names; a lag of those that are `left` counts as the student's."""

    outputs: Mapping[str, MeasuredLatency] = field(default_factory=lambda: MappingProxyType({}))
    kits: Mapping[str, DeviceLatency] = field(default_factory=lambda: MappingProxyType({}))
    left: frozenset[str] = frozenset()

    def with_output(self, name: str, measured: MeasuredLatency) -> "StoredCalibration":
        """The same with another latency for the output called `name`."""
        return replace(self, outputs=MappingProxyType({**self.outputs, name: measured}))

    def with_kit(self, name: str, measured: DeviceLatency) -> "StoredCalibration":
        """The same with other latencies for the kit called `name`; pads that were not measured now keep theirs."""
        pads = {**(self.kits[name].pads if name in self.kits else {}), **measured.pads}
        kit = replace(measured, pads=MappingProxyType(pads))
        return replace(self, kits=MappingProxyType({**self.kits, name: kit}))


def calibration_path() -> Path:
    """Where this user's measurements live on this system."""
    return settings_path().with_name(FILE_NAME)


# --- reading ---------------------------------------------------------------------------------------------------------


def load_calibration(path: Path | None = None) -> StoredCalibration:
    """What was measured, from `path` (this user's by default); raises `BadInput` for a file that is not ours."""
    path = path or calibration_path()
    if not path.parent.is_dir():  # no settings are there, either, and whoever reads those says so
        return StoredCalibration()
    try:
        source = read_source(path)
    except NoSuchFile:
        return StoredCalibration()
    return read(source, CALIBRATION)


def _kit(pads: Mapping[Piece, MeasuredLatency], **kit: Any) -> DeviceLatency:  # noqa: ANN401 - the fields of `MeasuredLatency`
    return DeviceLatency(MeasuredLatency(**kit), MappingProxyType(pads))


def _calibration(
    outputs: Mapping[str, MeasuredLatency], kits: Mapping[str, DeviceLatency], left: tuple[str, ...]
) -> StoredCalibration:
    return StoredCalibration(MappingProxyType(outputs), MappingProxyType(kits), frozenset(left))


_MEASURED: Fields = MappingProxyType(
    {
        "latency_ms": needed(number(-MOST_MS, MOST_MS)),
        "half_ms": needed(number(0.0, MOST_MS)),
        "by": needed(text),
        "on": needed(day),
        "doubts": Field(text, ""),
    }
)
_measured = record(MeasuredLatency, _MEASURED)
_pads = table_of(key_of(members_by_label(Piece), "piece"), _measured)
FIELDS: Fields = MappingProxyType(
    {
        "outputs": Field(table_of(text, _measured), {}),
        "kits": Field(table_of(text, record(_kit, {**_MEASURED, "pads": Field(_pads, {})})), {}),
        "left": Field(list_of(text, "names of devices"), ()),
    }
)
CALIBRATION: Reader[StoredCalibration] = record(_calibration, FIELDS, "table")
"""The schema of the file."""


# --- writing ---------------------------------------------------------------------------------------------------------


def save_calibration(calibration: StoredCalibration, path: Path | None = None) -> Path:
    """Write all to `path` (this user's by default) and return it; raises `DeviceError` if the disk refuses."""
    target = path or calibration_path()
    tables = [_table(f"outputs.{toml_text(name)}", each) for name, each in calibration.outputs.items()]
    for name, kit in calibration.kits.items():
        place = f"kits.{toml_text(name)}"
        tables.append(_table(place, kit.kit))
        tables += [_table(f"{place}.pads.{word(piece)}", pad) for piece, pad in kit.pads.items()]
    head = "# What was measured by `station devices calibrate`; delete a table to forget it.\n"
    if calibration.left:
        head += f"left = [{', '.join(toml_text(name) for name in sorted(calibration.left))}]\n"
    write_whole(target, "\n".join([head, *tables]).encode())
    return target


def _table(place: str, measured: MeasuredLatency) -> str:
    values = {key: getattr(measured, key) for key in _MEASURED}
    lines = [f"{key} = {toml_value(value)}\n" for key, value in values.items() if (key, value) != ("doubts", "")]
    return f"[{place}]\n{''.join(lines)}"

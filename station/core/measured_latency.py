"""What was measured of this user's devices: one TOML file beside the settings, read whole and written whole.

A table a sound output and a table a kit, by the device's name; a kit's pads have tables of their own within it. To
forget a measurement one deletes its table. Latencies are milliseconds, positive where a device is later than it
reports. A file that does not exist says nothing; a fault in it is named with its place.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from datetime import date, datetime
from pathlib import Path
from types import MappingProxyType

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.files import write_whole
from station.core.pieces import Piece, word
from station.core.settings import settings_path
from station.core.toml_table import parse_toml
from station.core.toml_write import toml_text, toml_value

FILE_NAME = "calibration.toml"
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
    """All that was measured, by the devices' names."""

    outputs: Mapping[str, MeasuredLatency] = field(default_factory=lambda: MappingProxyType({}))
    kits: Mapping[str, DeviceLatency] = field(default_factory=lambda: MappingProxyType({}))

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
    source = path or calibration_path()
    try:
        data = source.read_bytes()
    except (FileNotFoundError, NotADirectoryError):
        return StoredCalibration()
    except OSError as fault:
        raise BadInput(source, "", fault.strerror or str(fault)) from fault
    raw = parse_toml(data, source)
    for key in raw:
        if key not in ("outputs", "kits"):
            raise BadInput(source, key, "no such table; there are outputs, kits")
    tables = _Tables(source)
    outputs = {name: tables.measured(table, f"outputs.{name}") for name, table in tables.of(raw, "outputs").items()}
    kits = {name: tables.kit(table, f"kits.{name}") for name, table in tables.of(raw, "kits").items()}
    return StoredCalibration(MappingProxyType(outputs), MappingProxyType(kits))


@dataclass(frozen=True, slots=True)
class _Tables:
    """Reads the tables of one file and names the place of a fault."""

    source: Path

    def of(self, raw: Mapping[str, object], key: str, place: str = "") -> dict[str, dict[str, object]]:
        found = raw.get(key, {})
        where = f"{place}.{key}" if place else key
        if not isinstance(found, dict):
            raise BadInput(self.source, where, "expected a table")
        for name, table in found.items():
            if not isinstance(table, dict):
                raise BadInput(self.source, f"{where}.{name}", "expected a table")
        return found

    def kit(self, table: Mapping[str, object], place: str) -> DeviceLatency:
        pads = {}
        for name, pad in self.of(table, "pads", place).items():
            if name not in _PIECES:
                raise BadInput(self.source, f"{place}.pads.{name}", f"no such piece{did_you_mean(name, _PIECES)}")
            pads[_PIECES[name]] = self.measured(pad, f"{place}.pads.{name}")
        rest = {key: value for key, value in table.items() if key != "pads"}
        return DeviceLatency(self.measured(rest, place), MappingProxyType(pads))

    def measured(self, table: Mapping[str, object], place: str) -> MeasuredLatency:
        for key in table:
            if key not in _KEYS:
                raise BadInput(self.source, f"{place}.{key}", f"no such key{did_you_mean(key, _KEYS)}")
        return MeasuredLatency(
            self._number(table, "latency_ms", place, -MOST_MS),
            self._number(table, "half_ms", place, 0.0),
            self._text(table, "by", place),
            self._day(table, "on", place),
            self._text({"doubts": "", **table}, "doubts", place),
        )

    def _number(self, table: Mapping[str, object], key: str, place: str, least: float) -> float:
        value = table.get(key)
        if not isinstance(value, int | float) or isinstance(value, bool) or not least <= value <= MOST_MS:
            raise BadInput(self.source, f"{place}.{key}", f"expected {least:g} to {MOST_MS:g}, found {value!r}")
        return float(value)

    def _text(self, table: Mapping[str, object], key: str, place: str) -> str:
        value = table.get(key)
        if not isinstance(value, str):
            raise BadInput(self.source, f"{place}.{key}", f"expected a text in quotes, found {value!r}")
        return value

    def _day(self, table: Mapping[str, object], key: str, place: str) -> date:
        value = table.get(key)
        if not isinstance(value, date) or isinstance(value, datetime):
            raise BadInput(self.source, f"{place}.{key}", f"expected a day such as 2026-01-31, found {value!r}")
        return value


_KEYS = tuple(each.name for each in fields(MeasuredLatency))
_PIECES = {word(piece): piece for piece in Piece}


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
    write_whole(target, "\n".join([head, *tables]).encode())
    return target


def _table(place: str, measured: MeasuredLatency) -> str:
    values = {key: getattr(measured, key) for key in _KEYS}
    lines = [f"{key} = {toml_value(value)}\n" for key, value in values.items() if (key, value) != ("doubts", "")]
    return f"[{place}]\n{''.join(lines)}"

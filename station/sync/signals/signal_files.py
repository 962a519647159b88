"""Which reader a signal's file has, by its ending."""

from collections.abc import Callable
from pathlib import Path

from station.core.errors import BadInput
from station.core.toml.schema import either
from station.sync.signals.amc import read_amc
from station.sync.signals.bvh_motion import read_bvh
from station.sync.signals.signal import Signal
from station.sync.signals.signal_csv import read_signal_csv

_READERS: dict[str, Callable[[Path], Signal]] = {
    ".csv": read_signal_csv,
    ".amc": read_amc,
    ".bvh": lambda path: read_bvh(path).signal,
}


def read_signal(path: Path) -> Signal:
    """The signal of a file; raises `BadInput` where it cannot be read, or nobody knows its ending."""
    read = _READERS.get(path.suffix.lower())
    if read is None:
        raise BadInput(path, "", f"expected a name that ends in {either(_READERS)}")
    return read(path)

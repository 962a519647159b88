"""Reads a JSON file that the station keeps for a student; what cannot be read is set aside, never written over."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from station.core.disk.files import NoSuchFile, read_regular
from station.core.errors import BadInput, DeviceError

MOST_BYTES = 4_000_000
"""Our choice: a hundred times what any of these files has."""
_SPARE_NAMES = 1000
_T = TypeVar("_T")


def recalled(path: Path, read: Callable[[object, str], _T], lost: str) -> tuple[_T | None, str | None]:
    """What the file holds, None where there is none; and a line that says what is `lost` where it cannot be read.

    Raises `DeviceError` where the file can neither be read nor set aside.
    """
    try:
        return read(kept_document(path), str(path)), None
    except NoSuchFile:
        return None, None
    except BadInput as fault:
        if isinstance(fault.__cause__, OSError) or path.is_dir():
            raise DeviceError(str(fault)) from fault
        return None, f"{fault}; {_set_aside(path)}, {lost}"


def kept_document(path: Path, most_bytes: int = MOST_BYTES) -> object:
    """What the JSON file at `path` says; raises `NoSuchFile`, or `BadInput` where it is none, too long or a pipe."""
    data = read_regular(path, most_bytes)
    try:
        return json.loads(data.decode("utf-8"))
    except (ValueError, RecursionError) as fault:
        raise BadInput(path, "", f"is no JSON document ({fault})") from None


def _set_aside(path: Path) -> str:
    for attempt in range(1, _SPARE_NAMES):
        spare = path.with_name(f"{path.name}.unread-{attempt}")
        if spare.exists():
            continue
        try:
            path.rename(spare)
        except OSError as fault:
            raise DeviceError(f"{path}: cannot be set aside: {fault.strerror or fault}") from fault
        return f"it is kept as {spare.name}"
    raise DeviceError(f"{path}: too many files that could not be read lie beside it")

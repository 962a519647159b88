"""Files that are written whole or not at all."""

import os
import tempfile
from contextlib import suppress
from pathlib import Path

from station.core.errors import DeviceError


def write_whole(path: Path, data: bytes) -> None:
    """Put `data` at `path` at once: whoever looks finds the old file or the new one, never a part.

    Raises `DeviceError` (disk full, no permission) and leaves the old file as it was.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    except OSError as fault:
        raise DeviceError(f"{path}: cannot be written: {fault.strerror or fault}") from fault
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        Path(name).replace(path)
    except OSError as fault:
        with suppress(OSError):
            Path(name).unlink()
        raise DeviceError(f"{path}: cannot be written: {fault.strerror or fault}") from fault

"""Files that are written whole or not at all."""

import os
import secrets
import stat
from contextlib import suppress
from pathlib import Path

from station.core.errors import DeviceError


def write_whole(path: Path, data: bytes) -> None:
    """Put `data` at `path` at once: whoever looks finds the old file or the new one, never a part.

    Links are followed and an old file keeps its mode. What is no plain file (`/dev/stdout`, a pipe) is written to as it
    stands. Raises `DeviceError` (disk full, no permission) and leaves the old file as it was.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        old_mode = path.stat().st_mode if path.exists() else None
        if old_mode is None or stat.S_ISREG(old_mode):
            _replace(path.resolve(), data, old_mode)
        else:
            path.write_bytes(data)
    except OSError as fault:
        raise DeviceError(f"{path}: cannot be written: {fault.strerror or fault}") from fault


def _replace(target: Path, data: bytes, old_mode: int | None) -> None:
    """Write a hidden file beside `target`, then give it that name; the hidden file never stays."""
    part = target.with_name(f".{secrets.token_hex(8)}.part")
    try:
        with part.open("xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        if old_mode is not None:
            part.chmod(stat.S_IMODE(old_mode))
        part.replace(target)
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)

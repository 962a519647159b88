"""Files that are read whole, and files that are written whole or not at all."""

import errno
import os
import secrets
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from station.core.errors import BadInput, DeviceError


class NoSuchFile(BadInput):
    """There is no file of that name."""

    def __init__(self, source: str | Path, place: str = "", fault: str = "no such file") -> None:
        super().__init__(source, place, fault)


def read_regular(path: Path, most_bytes: int) -> bytes:
    """What the file at `path` holds; raises `NoSuchFile`, or `BadInput` if it is too large or no regular file.

    A pipe or a terminal would make the reader wait for ever, `/dev/zero` never ends: none of them is opened.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            what = "Is a directory" if path.is_dir() else "not a regular file"
            raise BadInput(path, "", f"cannot be read: {what}")
        with path.open("rb") as file:
            data = file.read(most_bytes + 1)
    except (FileNotFoundError, ValueError):  # or a name that no file can have
        raise NoSuchFile(path) from None
    except OSError as fault:
        raise BadInput(path, "", f"cannot be read: {fault.strerror or fault}") from fault
    if len(data) > most_bytes:
        raise BadInput(path, "", f"longer than {most_bytes} bytes")
    return data


def write_whole(path: Path, data: bytes) -> None:
    """Put `data` at `path` at once: whoever looks finds the old file or the new one, never a part.

    Links are followed and an old file keeps its mode. What is no plain file (`/dev/stdout`, a pipe) is written to as it
    stands, but for what would make us wait for ever: a pipe that nobody reads, a terminal. Raises `DeviceError` (disk
    full, no permission) and leaves the old file as it was.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.exists() and not path.is_file():
            _write_as_it_stands(path, data)
            return
        with _part_of(_target(path)) as part, part.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
    except OSError as fault:
        raise _not_written(path, fault) from fault


def _write_as_it_stands(path: Path, data: bytes) -> None:
    """Write to what is no plain file, without waiting for somebody to come and read; raises `OSError`."""
    with open(os.open(path, os.O_WRONLY | getattr(os, "O_NONBLOCK", 0)), "wb") as stream:  # noqa: PTH123 - a descriptor
        if stream.isatty():
            raise OSError(errno.EINVAL, "a terminal, not a regular file")
        os.set_blocking(stream.fileno(), True)
        stream.write(data)


@contextmanager
def growing(path: Path) -> Iterator[Path]:
    """A hidden file beside `path` to write to bit by bit; it becomes `path` where the block ends, never where it fails.

    Links are followed and an old file keeps its mode. Raises `DeviceError` (disk full, no permission, `path` is no
    plain file) and leaves the old file as it was.
    """
    try:
        if path.exists() and not path.is_file():
            raise DeviceError(f"{path}: cannot be written: it is no plain file")
        path.parent.mkdir(parents=True, exist_ok=True)
        with _part_of(_target(path)) as part:
            yield part
            with part.open("rb+") as file:
                os.fsync(file.fileno())
    except OSError as fault:
        raise _not_written(path, fault) from fault


@contextmanager
def _part_of(target: Path) -> Iterator[Path]:
    """A new hidden file beside `target`, which takes that name if all went well; the hidden file never stays."""
    old_mode = target.stat().st_mode if target.exists() else None
    part = target.with_name(f".{secrets.token_hex(8)}.part")
    try:
        part.touch(exist_ok=False)
        yield part
        if old_mode is not None:
            part.chmod(stat.S_IMODE(old_mode))
        part.replace(target)
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def _target(path: Path) -> Path:
    """Where links lead; raises `OSError` for those that lead in a circle, for which `resolve` itself may not."""
    with suppress(FileNotFoundError):
        path.stat()
    return path.resolve()


def _not_written(path: Path, fault: OSError) -> DeviceError:
    return DeviceError(f"{path}: cannot be written: {fault.strerror or fault}")

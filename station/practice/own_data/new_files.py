"""A folder or a ZIP archive of new files that is there whole or not at all."""

import os
import secrets
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from pathlib import Path
from typing import IO
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from station.core.disk.files import growing
from station.core.errors import BadInput, DeviceError

ARCHIVE = ".zip"
NewFile = Callable[[str], AbstractContextManager[IO[bytes]]]
"""Opens a new file by its name, whose parts `/` keeps apart."""


def check_free(out: Path) -> None:
    """Raises `BadInput` where something is at `out` already, but for an empty folder."""
    is_empty = out.is_dir() and out.suffix.lower() != ARCHIVE and not any(out.iterdir())
    if os.path.lexists(out) and not is_empty:
        raise BadInput(out, "", "is there already: choose another name")


@contextmanager
def new_files(out: Path) -> Iterator[NewFile]:
    """Makes the files of `out`: an archive where its name ends in .zip, else a folder; raises `DeviceError`."""
    with (_archive if out.suffix.lower() == ARCHIVE else _folder)(out) as new:
        yield new


@contextmanager
def _archive(out: Path) -> Iterator[NewFile]:
    now = time.localtime()[:6]

    with growing(out) as part, ZipFile(part, "w", ZIP_DEFLATED) as archive:

        @contextmanager
        def new(name: str) -> Iterator[IO[bytes]]:
            about = ZipInfo(name, now)
            about.compress_type = ZIP_DEFLATED
            with archive.open(about, "w", force_zip64=True) as stream:
                yield stream

        yield new


@contextmanager
def _folder(out: Path) -> Iterator[NewFile]:
    part = out.with_name(f".{secrets.token_hex(8)}.part")

    @contextmanager
    def new(name: str) -> Iterator[IO[bytes]]:
        path = part.joinpath(*name.split("/"))
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("xb") as stream:
            yield stream

    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        part.mkdir()
        yield new
        with suppress(FileNotFoundError):
            out.rmdir()  # an empty one may be there
        part.rename(out)
    except OSError as fault:
        raise DeviceError(f"{out}: cannot be written: {fault.strerror or fault}") from fault
    finally:
        shutil.rmtree(part, ignore_errors=True)

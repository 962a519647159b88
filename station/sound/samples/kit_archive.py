"""The files of a `.h2drumkit`, a tar that may be compressed by gzip, read into memory within limits.

Nothing is ever written to disk. A hostile archive is refused, not repaired: names that lead out of it, links, devices,
and more bytes than a drum kit has, whether in a file, in its headers or hidden by compression.
"""

import gzip
import tarfile
import zlib
from pathlib import Path, PurePosixPath
from typing import IO, Any, cast

from station.core.errors import BadInput

MAX_BYTES = 768 * 2**20
"""Unpacked (our choice): twice the largest kits that Hydrogen's users share."""
MAX_MEMBERS = 8192
_GZIP = b"\x1f\x8b"


class _Bounded:
    """A stream that ends in `BadInput` after `MAX_BYTES`: bombs hide in headers too, where no member's size tells."""

    def __init__(self, stream: IO[bytes], source: Path) -> None:
        self._stream = stream
        self._source = source
        self._left = MAX_BYTES

    def read(self, size: int) -> bytes:
        """The next `size` bytes, fewer at the end."""
        if size > self._left:
            raise BadInput(self._source, "", f"unpacks to more than {MAX_BYTES // 2**20} MB")
        data = self._stream.read(size)
        self._left -= len(data)
        return data


def unpacked(path: Path) -> dict[str, bytes]:
    """Every file of the archive by its name in it, with forward slashes; raises `BadInput` that names the member."""
    try:
        with path.open("rb") as raw:
            begin = raw.read(2)
            raw.seek(0)
            stream = cast("IO[bytes]", gzip.GzipFile(fileobj=raw)) if begin == _GZIP else raw
            return _members(_Bounded(stream, path), path)
    except (tarfile.TarError, zlib.error, EOFError, UnicodeError, ValueError) as fault:
        raise BadInput(path, "", f"is no drum kit's archive: {fault}") from fault
    except OSError as fault:
        raise BadInput(path, "", fault.strerror or str(fault)) from fault


def _members(stream: _Bounded, path: Path) -> dict[str, bytes]:
    files: dict[str, bytes] = {}
    with tarfile.open(fileobj=cast("Any", stream), mode="r|") as archive:
        for count, member in enumerate(archive):
            if count >= MAX_MEMBERS:
                raise BadInput(path, "", f"holds more than {MAX_MEMBERS} files")
            if member.isdir():
                continue
            _check(member, path)
            content = archive.extractfile(member)
            assert content is not None, "a plain file has a content"
            files[PurePosixPath(member.name).as_posix()] = content.read()
    return files


def _check(member: tarfile.TarInfo, path: Path) -> None:
    name = PurePosixPath(member.name.replace("\\", "/"))
    if name.is_absolute() or ".." in name.parts or ":" in member.name:
        raise BadInput(path, repr(member.name), "a file's name leads out of the archive")
    if not member.isreg() or member.issparse():
        raise BadInput(path, repr(member.name), "is a link, a device or a sparse file; a kit holds plain files")
    if member.size > MAX_BYTES:
        raise BadInput(path, repr(member.name), f"is larger than {MAX_BYTES // 2**20} MB")

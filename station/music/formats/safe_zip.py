"""Zip files of strangers: one member at a time, no larger than it may be, whatever the file's table claims."""

import io
import zipfile
import zlib

from station.core.errors import BadInput

_KNOWN_PACKINGS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
_MOST_MEMBERS = 1000
"""Our choice: a score with its pictures has a few."""


def is_zip(data: bytes) -> bool:
    """Whether `data` begins as zip files do."""
    return data.startswith(b"PK\x03\x04")


def zip_names(data: bytes, source: str) -> list[str]:
    """The names of the members; raises `BadInput` of `source`."""
    return [member.filename for member in _opened(data, source).infolist()]


def zip_member(data: bytes, source: str, name: str, most_bytes: int) -> bytes:
    """What the member `name` holds; raises `BadInput` where it is missing, damaged or larger than `most_bytes`."""
    archive = _opened(data, source)
    try:
        member = archive.getinfo(name)
    except KeyError as fault:
        raise BadInput(source, "", f"the zip file has no member {name}") from fault
    if member.compress_type not in _KNOWN_PACKINGS or member.flag_bits & 1:
        raise BadInput(source, name, "is encrypted or packed in a way that is not read")
    try:
        with archive.open(member) as stream:
            found = stream.read(most_bytes + 1)
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError, ValueError, NotImplementedError, RuntimeError) as fault:
        raise BadInput(source, name, f"damaged: {fault}") from fault
    if len(found) > most_bytes:
        raise BadInput(source, name, f"is larger than {most_bytes >> 20} MiB when unpacked")
    return found


def _opened(data: bytes, source: str) -> zipfile.ZipFile:
    try:
        archive = zipfile.ZipFile(io.BytesIO(data))
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, EOFError, UnicodeError) as fault:
        raise BadInput(source, "", f"no zip file: {fault}") from fault
    if len(archive.infolist()) > _MOST_MEMBERS:
        raise BadInput(source, "", f"a zip file of more than {_MOST_MEMBERS} members")
    return archive

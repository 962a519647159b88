"""Zip files of strangers: one member at a time, no larger than it may be, whatever the file's table claims.

The table at a zip file's end is read into memory whole, some hundred times its size; so its size is looked at first
(PKWARE APPNOTE 6.3.10, 4.3.16: the record at the end says it).
"""

import io
import struct
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass

from station.core.errors import BadInput

_KNOWN_PACKINGS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
_MOST_MEMBERS = 1000
"""Our choice: a score with its pictures has a few."""
_MOST_TABLE_BYTES = 1 << 18
"""Of the table of all members: 46 bytes each and their names (our choice: 200 letters for each of so many)."""
_END = struct.Struct("<4s4H2LH")
_END_MARK = b"PK\x05\x06"
_LOCATOR64_MARK, _LOCATOR64_BYTES = b"PK\x06\x07", 20
"""What stands before it in a file of more members or bytes than 16 and 32 bits count (4.3.15)."""
_LONGEST_COMMENT = 0xFFFF


def is_zip(data: bytes) -> bool:
    """Whether `data` begins as zip files do."""
    return data.startswith(b"PK\x03\x04")


@dataclass(frozen=True, slots=True, eq=False)
class SafeZip:
    """A zip file whose table was read, called `source` in faults; `members` by their names."""

    source: str
    archive: zipfile.ZipFile
    members: Mapping[str, zipfile.ZipInfo]

    @classmethod
    def of(cls, data: bytes, source: str) -> "SafeZip":
        """That in `data`; raises `BadInput` where there is none, or one that is not read."""
        _check_table(data, source)
        try:
            archive = zipfile.ZipFile(io.BytesIO(data))
        except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, EOFError, UnicodeError) as fault:
            raise BadInput(source, "", f"no zip file: {fault}") from fault
        table = archive.infolist()
        if len(table) > _MOST_MEMBERS:
            raise BadInput(source, "", f"a zip file of more than {_MOST_MEMBERS} members")
        return cls(source, archive, {member.filename: member for member in table})

    @property
    def has_twins(self) -> bool:
        """Whether two members have one name."""
        return len(self.members) < len(self.archive.infolist())

    def read(self, name: str, most_bytes: int) -> bytes:
        """What the member `name` holds; raises `BadInput` where it is missing, damaged or larger than `most_bytes`."""
        member = self.members.get(name)
        if member is None:
            raise BadInput(self.source, "", f"the zip file has no member {name}")
        if member.compress_type not in _KNOWN_PACKINGS or member.flag_bits & 1:
            raise BadInput(self.source, name, "is encrypted or packed in a way that is not read")
        try:
            with self.archive.open(member) as stream:
                found = stream.read(most_bytes + 1)
        except (
            zipfile.BadZipFile,
            zlib.error,
            EOFError,
            OSError,
            ValueError,
            NotImplementedError,
            RuntimeError,
        ) as bad:
            raise BadInput(self.source, name, f"damaged: {bad}") from bad
        if len(found) > most_bytes:
            raise BadInput(self.source, name, f"is larger than {_sized(most_bytes)} when unpacked")
        return found


def zip_names(data: bytes, source: str) -> list[str]:
    """The names of the members; raises `BadInput` of `source`."""
    return [member.filename for member in SafeZip.of(data, source).archive.infolist()]


def zip_member(data: bytes, source: str, name: str, most_bytes: int) -> bytes:
    """What the member `name` holds; raises as `SafeZip.read` does."""
    return SafeZip.of(data, source).read(name, most_bytes)


def _sized(count: int) -> str:
    return f"{count >> 20} MiB" if count >= 1 << 20 else f"{count} bytes"


def _check_table(data: bytes, source: str) -> None:
    """Raises `BadInput` where the table of members is larger than any that is read."""
    last = len(data) - _END.size
    found = data.rfind(_END_MARK, max(last - _LONGEST_COMMENT, 0))
    for at in {last, found}:  # `zipfile` takes the first of them that is one
        if not 0 <= at <= last or not data.startswith(_END_MARK, at):
            continue
        size = _END.unpack_from(data, at)[5]
        if size > _MOST_TABLE_BYTES or data.startswith(_LOCATOR64_MARK, max(at - _LOCATOR64_BYTES, 0)):
            raise BadInput(source, "", f"a zip file of more than {_MOST_MEMBERS} members")

"""The container of assignments, returns and notes: a zip file with a table of what it holds.

    manifest.json   the table: `schema`, what the kind says (`assignment_file` and its like), `members`, `checksum`
    README.txt      the same for people; nobody reads it back
    lessons/1.toml …  the members that the kind allows, each with its size and SHA-256 in the table

`checksum` is the SHA-256 of the table without it, keys sorted, without blanks; so that all that was damaged or changed
on the way shows. It is no signature: whoever changes a file on purpose can write a new one. Nothing is unpacked to a
member's name: members come out as bytes, and whoever keeps them names the files.
"""

import hashlib
import io
import json
import re
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from types import MappingProxyType
from typing import TypeVar

from station.core.disk.files import read_regular
from station.core.errors import BadInput
from station.core.toml.schema import Field, Fields, Reader, list_of, needed, record, shown, text, whole
from station.core.toml.toml_faults import wrong
from station.music.formats.safe_zip import SafeZip, is_zip
from station.practice.exchange.parcel_json import MOST_JSON_BYTES, meaning, read_json

T = TypeVar("T")
MANIFEST_NAME, README_NAME = "manifest.json", "README.txt"
_VERSION = 1
_SCHEMA = re.compile(r"drum-station/([a-z]{1,20})/([0-9]{1,6})")
_SHA256 = re.compile(r"[0-9a-f]{64}")
_FIRST_DAY = (1980, 1, 1, 0, 0, 0)
"""The time of every member: the same content makes the same file (the earliest day that a zip file can say)."""
_SHARED_KEYS = ("schema", "members", "checksum")


@dataclass(frozen=True, slots=True)
class _Shape:
    """The word in the `schema`, what the file is called, how its name ends, its members, how long it may be in bytes.

    `most_bytes` holds of the file and of its members unpacked, both together.
    """

    word: str
    noun: str
    ending: str
    members: re.Pattern[str]
    most_bytes: int


class Kind(Enum):
    """What a parcel is."""

    ASSIGNMENT = _Shape(
        "assignment", "an assignment", ".drum-assignment", re.compile(r"lessons/[1-9][0-9]?\.toml"), 4 << 20
    )
    RETURN = _Shape(
        "return",
        "a return",
        ".drum-return",
        re.compile(r"sessions/[1-9][0-9]?/(session\.capture|report\.json|pairs\.csv|lesson\.toml)"),
        64 << 20,
    )
    NOTE = _Shape("note", "a note", ".drum-note", re.compile(r"(?!)"), 2 << 20)

    @property
    def ending(self) -> str:
        """How the names of such files end."""
        return self.value.ending

    @property
    def noun(self) -> str:
        """What people call it, with its article."""
        return self.value.noun

    @property
    def schema(self) -> str:
        """What the table calls it."""
        return f"drum-station/{self.value.word}/{_VERSION}"


KINDS: Mapping[str, Kind] = MappingProxyType({kind.value.word: kind for kind in Kind})


def kind_by_name(name: str) -> Kind | None:
    """The kind of a file by how its name ends; None of another file."""
    return next((kind for kind in Kind if name.lower().endswith(kind.ending)), None)


@dataclass(frozen=True, slots=True, eq=False)
class Parcel:
    """A parcel that was checked: what its table says beside what all share, and its `members`' bytes by their names."""

    kind: Kind
    source: str
    table: Mapping[str, object]
    members: Mapping[str, bytes]

    def meaning(self, reader: Reader[T]) -> T:
        """What the table means; raises `BadInput`."""
        return meaning(dict(self.table), reader, self.source, MANIFEST_NAME)

    def fault(self, place: str, text: str) -> BadInput:
        """That something in it is wrong."""
        return BadInput(self.source, place, text)


# --- writing ----------------------------------------------------------------------------------------------------------


def packed(kind: Kind, table: Mapping[str, object], readme: str, members: Mapping[str, bytes]) -> bytes:
    """A parcel of `kind`; raises `BadInput` where it would be longer than such a file may be."""
    all_members = {README_NAME: readme.encode(), **members}
    listed = [_row(name, data) for name, data in all_members.items()]
    whole_table = {"schema": kind.schema, **table, "members": listed}
    whole_table["checksum"] = _checksum(whole_table)
    manifest = json.dumps(whole_table, ensure_ascii=False, allow_nan=False, indent=2).encode()
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in {MANIFEST_NAME: manifest, **all_members}.items():
            member = zipfile.ZipInfo(name, _FIRST_DAY)
            member.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(member, content)
    size = max(len(data.getvalue()), sum(map(len, all_members.values())))
    if size > kind.value.most_bytes or len(manifest) > MOST_JSON_BYTES:
        raise BadInput(kind.noun, "", f"would be longer than {kind.value.most_bytes >> 20} MiB: put less into it")
    return data.getvalue()


def _row(name: str, data: bytes) -> dict[str, object]:
    return {"name": name, "bytes": len(data), "sha256": hashlib.sha256(data).hexdigest()}


def _checksum(table: Mapping[str, object]) -> str:
    body = {key: value for key, value in table.items() if key != "checksum"}
    plain = json.dumps(body, ensure_ascii=True, allow_nan=False, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(plain.encode()).hexdigest()


# --- reading ----------------------------------------------------------------------------------------------------------


def read_parcel(path: Path, kind: Kind) -> Parcel:
    """The parcel in the file at `path`; raises `BadInput`."""
    return parse_parcel(read_regular(path, kind.value.most_bytes), str(path), kind)


def parse_parcel(data: bytes, source: str, kind: Kind) -> Parcel:
    """The parcel of `kind` in `data`, every member checked by its size and SHA-256; raises `BadInput` of `source`."""
    if not is_zip(data):
        raise BadInput(source, "", f"is not {kind.noun}: such a file is a zip file with a {MANIFEST_NAME}")
    archive = SafeZip.of(data, source)
    if archive.has_twins:
        raise BadInput(source, "", "two of its members have one name")
    table = _table(archive, kind)
    rows = _members(table, source)
    _check_names(archive, rows, kind)
    members = {row.name: _checked(archive, row) for row in rows}
    if _checksum(table) != table.get("checksum"):
        raise BadInput(source, MANIFEST_NAME, "does not fit its checksum: it was damaged or changed on the way")
    own = {key: value for key, value in table.items() if key not in _SHARED_KEYS}
    return Parcel(kind, source, MappingProxyType(own), MappingProxyType(members))


def _table(archive: SafeZip, kind: Kind) -> dict[str, object]:
    raw = read_json(archive.read(MANIFEST_NAME, MOST_JSON_BYTES), archive.source, MANIFEST_NAME)
    found = _SCHEMA.fullmatch(str(raw.get("schema"))) if isinstance(raw, dict) else None
    if not isinstance(raw, dict) or found is None or found[1] not in KINDS:
        raise BadInput(archive.source, MANIFEST_NAME, f"is not the table of {kind.noun}")
    if KINDS[found[1]] is not kind:
        raise BadInput(archive.source, "", f"is {KINDS[found[1]].noun}, not {kind.noun}")
    if int(found[2]) != _VERSION:
        told = f"is {kind.noun} of version {found[2]}, and this station reads version {_VERSION}"
        raise BadInput(archive.source, "", f"{told}: a later station reads it")
    return raw


@dataclass(frozen=True, slots=True)
class _Member:
    name: str
    size: int
    sha256: str


def _digest(value: object) -> str:
    if not _SHA256.fullmatch(text(value)):
        raise wrong(f"expected 64 hexadecimal digits, found {shown(value)}")
    return text(value)


_MEMBER: Fields = {
    "name": needed(text),
    "bytes": Field(whole(0, Kind.RETURN.value.most_bytes), 0, "", "size"),
    "sha256": needed(_digest),
}


def _members(table: Mapping[str, object], source: str) -> tuple[_Member, ...]:
    rows = list_of(record(_Member, _MEMBER), "a list of members")
    return meaning(table.get("members"), rows, source, f"{MANIFEST_NAME}, members")


def _check_names(archive: SafeZip, rows: tuple[_Member, ...], kind: Kind) -> None:
    """Raises `BadInput` unless the table and the zip file name the same members, all of them such as `kind` has."""
    listed = [row.name for row in rows]
    shape = kind.value
    strange = next((name for name in listed if name != README_NAME and not shape.members.fullmatch(name)), None)
    if strange is not None:
        raise BadInput(archive.source, MANIFEST_NAME, f"{shape.noun} has no member {shown(strange)}")
    if len(set(listed)) < len(listed):
        raise BadInput(archive.source, MANIFEST_NAME, "names a member twice")
    odd = next(iter(archive.members.keys() ^ {MANIFEST_NAME, *listed}), None)
    if odd is not None:
        which = "is in the file, but not in its table" if odd in archive.members else "is missing"
        raise BadInput(archive.source, shown(odd), which)
    if sum(row.size for row in rows) > shape.most_bytes:
        raise BadInput(archive.source, "", f"holds more than {shape.most_bytes >> 20} MiB")


def _checked(archive: SafeZip, row: _Member) -> bytes:
    data = archive.read(row.name, row.size)
    if len(data) != row.size or hashlib.sha256(data).hexdigest() != row.sha256:
        raise BadInput(archive.source, row.name, "does not fit its checksum: it was damaged or changed on the way")
    return data

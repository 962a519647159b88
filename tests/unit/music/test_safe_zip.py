"""Zip files of strangers."""

import io
import zipfile

import pytest

from station.core.errors import BadInput
from station.music.formats.safe_zip import SafeZip, is_zip, zip_member, zip_names


def _zip(packing: int = zipfile.ZIP_DEFLATED, **members: bytes) -> bytes:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", packing) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return data.getvalue()


def test_a_member_is_read() -> None:
    data = _zip(score=b"music", other=b"picture")
    assert is_zip(data)
    assert not is_zip(b"<xml/>")
    assert zip_names(data, "a.zip") == ["score", "other"]
    assert zip_member(data, "a.zip", "score", 100) == b"music"


def test_a_bomb_is_not_unpacked() -> None:
    with pytest.raises(BadInput, match="unpacked"):
        zip_member(_zip(score=bytes(5 << 20)), "a.zip", "score", 1 << 20)


def test_damage_is_said() -> None:
    data = _zip(score=b"music" * 100)
    broken = data.replace(data[40:50], bytes(10))
    for wrong, name in ((b"PK\x03\x04", "score"), (data, "missing"), (data[:-30], "score"), (broken, "score")):
        with pytest.raises(BadInput):
            zip_member(wrong, "a.zip", name, 1000)
    with pytest.raises(BadInput, match="packed"):
        zip_member(_zip(zipfile.ZIP_LZMA, score=b"music"), "a.zip", "score", 1000)


def _end_at(data: bytes) -> int:
    return data.rindex(b"PK\x05\x06")


def test_a_table_of_a_million_members_is_not_read() -> None:
    """The size that the end says is believed before the table is read; a mark within the end hides nothing."""
    end = _end_at(data := _zip(score=b"music"))
    row = data[data.index(b"PK\x01\x02") : end]
    table = bytes(len(row) * 20_000)  # who reads it says that it is none
    for counts in (data[end + 8 : end + 12], b"PK\x05\x06"):
        huge = data[: end - len(row)] + table + data[end : end + 8] + counts
        huge += len(table).to_bytes(4, "little") + data[end + 16 :]
        with pytest.raises(BadInput, match="more than 1000 members"):
            zip_names(huge, "a.zip")


def test_a_file_of_64_bits_is_refused() -> None:
    end = _end_at(data := _zip(score=b"music"))
    with pytest.raises(BadInput, match="more than 1000 members"):
        zip_names(data[:end] + b"PK\x06\x07" + bytes(16) + data[end:], "a.zip")


def test_two_members_of_one_name_are_seen() -> None:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        archive.writestr("a", b"1")
        with pytest.warns(UserWarning, match="Duplicate"):
            archive.writestr("a", b"2")
    assert SafeZip.of(data.getvalue(), "a.zip").has_twins
    assert not SafeZip.of(_zip(a=b"1"), "a.zip").has_twins

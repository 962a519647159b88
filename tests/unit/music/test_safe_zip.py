"""Zip files of strangers."""

import io
import zipfile

import pytest

from station.core.errors import BadInput
from station.music.formats.safe_zip import is_zip, zip_member, zip_names


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

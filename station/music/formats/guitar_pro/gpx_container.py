"""The container of Guitar Pro 6's `.gpx`: `BCFS`, a little file system of sectors, and `BCFZ`, the same compressed.

Compressed data are bits, the first the highest of its byte. A 1 copies: 4 bits say how long two numbers are, then come
how far back and how much, each with its lowest bit first. A 0 is followed by 2 bits, lowest first, for how many bytes
stand here as they are. Source: the container as alphaTab and TuxGuitar describe it.
"""

from collections.abc import Iterator

from station.core.errors import BadInput

MOST_GPX_BYTES = 512 << 10
"""Our choice: each bit costs; songs have some hundred kilobytes."""
_MOST_EMPTY = 1000
"""Steps that add nothing, which no program writes (our choice)."""
_SECTOR = 0x1000
_FILE = 2
_NAME_AT, _NAME_BYTES, _SIZE_AT, _SECTORS_AT = 0x04, 127, 0x8C, 0x94


def is_gpx(data: bytes) -> bool:
    """Whether `data` begins as these containers do."""
    return data[:4] in (b"BCFS", b"BCFZ")


def gpx_member(data: bytes, source: str, name: str, most_bytes: int) -> bytes:
    """What the file `name` of a container holds; raises `BadInput` where there is none, or larger than `most_bytes`."""
    if len(data) > MOST_GPX_BYTES:
        raise BadInput(source, "", f"is larger than {MOST_GPX_BYTES >> 10} KiB, which no .gpx file is")
    sectors = data if data[:4] == b"BCFS" else _unpacked(data, source, most_bytes)
    for found, content in _files(sectors[4:], most_bytes):
        if found == name:
            return content
    raise BadInput(source, "", f"its container has no {name}")


def _unpacked(data: bytes, source: str, most_bytes: int) -> bytes:
    size = int.from_bytes(data[4:8], "little")
    if len(data) < 8 or size > most_bytes + most_bytes // 4:  # room for the other files and for tables
        raise BadInput(source, "byte 4", f"{size} bytes when unpacked; expected at most {most_bytes >> 20} MiB")
    bits = _Bits(data, 8)
    out = bytearray()
    empty = 0
    while len(out) < size and bits.are_left and empty < _MOST_EMPTY:
        before = len(out)
        if bits.read(1):
            width = bits.read(4)
            back, count = bits.read_reversed(width), bits.read_reversed(width)
            if back > len(out):
                raise BadInput(source, f"byte {bits.at >> 3}", "copies from before its beginning")
            out += out[len(out) - back : len(out) - back + min(back, count)]
        else:
            out += bytes(bits.read(8) for _ in range(bits.read_reversed(2)))
        empty += len(out) == before
    if not out.startswith(b"BCFS"):
        raise BadInput(source, "byte 8", "is no container of files when unpacked")
    return bytes(out[:size])


class _Bits:
    """Reads bits, the highest of a byte first; zeros follow the end."""

    def __init__(self, data: bytes, start: int) -> None:
        self._data, self.at = data, 8 * start

    @property
    def are_left(self) -> bool:
        return self.at < 8 * len(self._data)

    def read(self, count: int) -> int:
        first = self.at >> 3
        window = int.from_bytes(self._data[first : first + 4].ljust(4, b"\0"), "big")
        value = window >> (32 - (self.at & 7) - count) & ((1 << count) - 1)
        self.at += count
        return value

    def read_reversed(self, count: int) -> int:
        value = self.read(count)
        return int(f"{value:0{count}b}"[::-1], 2) if count else 0


def _files(data: bytes, most_bytes: int) -> Iterator[tuple[str, bytes]]:
    """Names and contents; a sector that two files claim, or that is not there, ends its file."""
    at = _SECTOR
    while at + _SECTORS_AT < len(data):
        following = at + _SECTOR
        if _number(data, at) == _FILE:
            name = data[at + _NAME_AT : at + _NAME_AT + _NAME_BYTES].split(b"\0")[0].decode("latin-1")
            parts: list[bytes] = []
            for sector in _sectors_of(data, at):
                parts.append(data[sector * _SECTOR : (sector + 1) * _SECTOR])
                following = max(following, (sector + 1) * _SECTOR)
            size = min(_number(data, at + _SIZE_AT), most_bytes)
            yield name, b"".join(parts)[:size]
        at = following


def _sectors_of(data: bytes, at: int) -> Iterator[int]:
    """The sectors of the file whose entry is at `at`, in order."""
    for place in range(at + _SECTORS_AT, min(at + _SECTOR, len(data)), 4):
        sector = _number(data, place)
        if not sector or sector * _SECTOR >= len(data):
            return
        yield sector


def _number(data: bytes, at: int) -> int:
    return int.from_bytes(data[at : at + 4], "little")

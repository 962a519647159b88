"""Standard MIDI Files put together byte by byte, right or wrong as a test needs them (RP-001)."""


def number(value: int) -> bytes:
    """A variable-length quantity."""
    groups = [value & 0x7F]
    while value := value >> 7:
        groups.append(value & 0x7F | 0x80)
    return bytes(reversed(groups))


def chunk(kind: bytes, content: bytes) -> bytes:
    return kind + len(content).to_bytes(4, "big") + content


def header(form: int = 0, tracks: int = 1, division: int = 96) -> bytes:
    return chunk(b"MThd", b"".join(word.to_bytes(2, "big") for word in (form, tracks, division)))


def event(delta: int, *message: int) -> bytes:
    return number(delta) + bytes(message)


def meta(delta: int, kind: int, content: bytes = b"") -> bytes:
    return number(delta) + bytes([0xFF, kind]) + number(len(content)) + content


END = meta(0, 0x2F)


def tempo(delta: int, us_per_quarter: int) -> bytes:
    return meta(delta, 0x51, us_per_quarter.to_bytes(3, "big"))


def meter(delta: int, beats: int, power: int) -> bytes:
    return meta(delta, 0x58, bytes([beats, power, 24, 8]))


def track(*events: bytes, end: bytes = END) -> bytes:
    return chunk(b"MTrk", b"".join(events) + end)


def file(*events: bytes, division: int = 96) -> bytes:
    """A format 0 file of one track."""
    return header(division=division) + track(*events)

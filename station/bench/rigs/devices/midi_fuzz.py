"""Hostile MIDI bytes, and what they may at most mean: for soaks and tests of everything between wire and hit.

`notes_in` says which notes a stream of bytes holds, by the grammar of MIDI alone and not by our tokenizer: without its
real-time bytes a stream is a row of status bytes, each with the data that follow it, and a run of data after a
note-on status is pairs of note and velocity (MIDI 1.0 Detailed Specification 4.2, "Data format").
"""

import random
import re

_REAL_TIME = bytes(range(0xF8, 0x100))
_NOTE_RUN = re.compile(rb"[\x90-\x9f]([\x00-\x7f]*)")
_STATUSES = (0x80, 0x89, 0x90, 0x99, 0x99, 0x99, 0xA9, 0xB9, 0xB9, 0xC9, 0xD9, 0xE9)
_SYSTEM = bytes((0xF0, 0xF1, 0xF2, 0xF3, 0xF4, 0xF5, 0xF6, 0xF7))
_CONTROLLERS = (4, 16, 17, 18, 19, 88, 123)
LONGEST = 64
"""Bytes an input: room for a dozen messages and for a fault to have consequences (our choice)."""


def notes_in(data: bytes) -> list[tuple[int, int]]:
    """Note and velocity (1–127) of every note-on that `data` holds, in order."""
    runs = (match[1] for match in _NOTE_RUN.finditer(data.translate(None, _REAL_TIME)))
    pairs = (run[at : at + 2] for run in runs for at in range(0, len(run) - 1, 2))
    return [(pair[0], pair[1]) for pair in pairs if pair[1]]


def hostile_bytes(chance: random.Random) -> bytes:
    """An input: noise, a row of messages, or a row of messages that was damaged as lines and senders do."""
    size = chance.randrange(LONGEST)
    if chance.random() < 0.25:
        return chance.randbytes(size)
    data = bytearray()
    while len(data) < size:
        data += _message(chance)
    if chance.random() < 0.5 and data:
        _damage(data, chance)
    return bytes(data)


def _message(chance: random.Random) -> bytes:
    kind = chance.random()
    if kind < 0.1:
        return bytes((chance.choice(_REAL_TIME),))
    if kind < 0.2:
        return bytes((chance.choice(_SYSTEM), *chance.randbytes(chance.randrange(4))))
    status = chance.choice(_STATUSES)
    first = chance.choice(_CONTROLLERS) if status == 0xB9 else chance.randrange(128)
    message = bytes((status, first, chance.randrange(128)))
    return message[1:] if chance.random() < 0.3 else message  # as a sender that uses running status


def _damage(data: bytearray, chance: random.Random) -> None:
    at = chance.randrange(len(data))
    match chance.randrange(4):
        case 0:
            data[at] ^= 1 << chance.randrange(8)  # a bit on the wire
        case 1:
            del data[at]  # an overrun
        case 2:
            data.insert(at, chance.randrange(256))  # a spike that looks like a byte
        case _:
            del data[at:]  # the plug


def cut_anywhere(data: bytes, chance: random.Random) -> list[bytes]:
    """`data` in pieces, as a driver may hand it on."""
    pieces = []
    while data:
        size = chance.randint(1, len(data))
        pieces.append(data[:size])
        data = data[size:]
    return pieces


def invented(hits: list[tuple[int, int]], notes: list[tuple[int, int]]) -> bool:
    """Whether `hits` holds a note that `notes` does not hold in that order."""
    rest = iter(notes)
    return not all(hit in rest for hit in hits)

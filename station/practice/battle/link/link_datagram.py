"""The bytes on the network: one table of layouts, written and read; whatever does not fit has a reason.

All integers are big-endian. A datagram begins with `MAGIC`, the wire's version and its kind. Only `CARRY` travels once
a session is open, and it ends with a keyed BLAKE2b (RFC 7693, 2.9) of all before it: who does not know the session's
key can neither write one nor change one. docs/battle-network.md has the table for readers.
"""

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, IntEnum
from hashlib import blake2b
from hmac import compare_digest

MAGIC = b"DSB"
WIRE_VERSION = 1
"""Raised whenever a layout here or a message changes: stations of different versions refuse each other by name."""
MOST_BYTES = 1200
"""Of a datagram: what crosses every network unbroken with room to spare (IPv6 asks for 1280, RFC 8200, 5)."""
HALF_BYTES = 16
"""Of the random half of a key that each end brings."""
MAC_BYTES = 16
"""128 bits of BLAKE2b: nobody guesses one."""


class Kind(IntEnum):
    """What a datagram is; the numbers are on the wire."""

    ASK = 1
    HERE = 2
    JOIN = 3
    WELCOME = 4
    KNOCK = 5
    REFUSED = 6
    CARRY = 7


class Drop(Enum):
    """Why a datagram was thrown away; the words are for reports."""

    FOREIGN = "not of this station's protocol"
    VERSION = "of another version"
    LENGTH = "of a wrong length"
    KIND = "not awaited here"
    SESSION = "of another session"
    MAC = "with a wrong signature"
    REPLAY = "come before"
    RANGE = "out of the window"
    MALFORMED = "not to be understood"
    FLOOD = "more than is taken"


@dataclass(frozen=True, slots=True)
class SessionKey:
    """What both ends of an open session know: its id of 8 bytes, the key of its signatures, and which end this is."""

    session: bytes
    secret: bytes
    is_host: bool


@dataclass(frozen=True, slots=True)
class Carry:
    """One datagram of an open session.

    `count` grows with every datagram of an end. `expected` is the fragment that the sender awaits next, bit `i` of
    `beyond` says that it has `expected + 1 + i` already. `fragment` is None in one that only acknowledges; a message
    ends with the fragment that `is_last`.
    """

    count: int
    expected: int
    beyond: int
    sequence: int = 0
    is_last: bool = False
    fragment: bytes | None = None


_HEAD = struct.Struct(">3sBB")
_CARRY = struct.Struct(">8sBQIQIB")
_HAS_FRAGMENT, _IS_LAST = 1, 2
HEAD_BYTES = _HEAD.size
FRAGMENT_BYTES = MOST_BYTES - HEAD_BYTES - _CARRY.size - MAC_BYTES
"""What of a message fits into one datagram."""
MOST_COUNT, MOST_SEQUENCE = (1 << 64) - 1, (1 << 32) - 1


def headed(kind: Kind, *parts: bytes) -> bytes:
    """A datagram of `kind`: its head, then `parts`."""
    return _HEAD.pack(MAGIC, WIRE_VERSION, kind) + b"".join(parts)


def kind_of(data: bytes) -> Kind | Drop:
    """What a datagram says that it is."""
    if len(data) < HEAD_BYTES or data[: len(MAGIC)] != MAGIC:
        return Drop.FOREIGN
    if len(data) > MOST_BYTES:
        return Drop.LENGTH
    _, version, kind = _HEAD.unpack_from(data)
    if version != WIRE_VERSION:
        return Drop.VERSION
    return Kind(kind) if kind in set(Kind) else Drop.KIND


def body(data: bytes, lengths: Sequence[int]) -> tuple[bytes, ...] | Drop:
    """The parts behind the head, of these lengths; what comes after them is padding."""
    if len(data) < HEAD_BYTES + sum(lengths):
        return Drop.LENGTH
    parts, at = [], HEAD_BYTES
    for length in lengths:
        parts.append(data[at : at + length])
        at += length
    return tuple(parts)


def signature(secret: bytes, *parts: bytes) -> bytes:
    """The keyed BLAKE2b of `parts`."""
    return blake2b(b"".join(parts), digest_size=MAC_BYTES, key=secret).digest()


def is_signed(secret: bytes, said: bytes, *parts: bytes) -> bool:
    """Whether `said` is the signature of `parts`, in a time that tells nothing."""
    return compare_digest(said, signature(secret, *parts))


def packed(carry: Carry, key: SessionKey) -> bytes:
    """The datagram of `carry`, signed."""
    flags = (_HAS_FRAGMENT if carry.fragment is not None else 0) | (_IS_LAST if carry.is_last else 0)
    fields = _CARRY.pack(key.session, not key.is_host, carry.count, carry.expected, carry.beyond, carry.sequence, flags)
    data = headed(Kind.CARRY, fields, carry.fragment or b"")
    return data + signature(key.secret, data)


def opened(data: bytes, key: SessionKey) -> Carry | Drop:
    """What the other end of the session carries in `data`, whose kind is `CARRY`; the signature is looked at first."""
    if not HEAD_BYTES + _CARRY.size + MAC_BYTES <= len(data) <= MOST_BYTES:
        return Drop.LENGTH
    session, sender, count, expected, beyond, sequence, flags = _CARRY.unpack_from(data, HEAD_BYTES)
    if session != key.session:
        return Drop.SESSION
    if not is_signed(key.secret, data[-MAC_BYTES:], data[:-MAC_BYTES]):
        return Drop.MAC
    fragment = data[HEAD_BYTES + _CARRY.size : -MAC_BYTES]
    if sender != int(key.is_host):  # one of our own, sent back to us
        return Drop.REPLAY
    if flags > (_HAS_FRAGMENT | _IS_LAST) or (not flags & _HAS_FRAGMENT and (fragment or flags)):
        return Drop.MALFORMED
    carried = fragment if flags & _HAS_FRAGMENT else None
    return Carry(count, expected, beyond, sequence, bool(flags & _IS_LAST), carried)

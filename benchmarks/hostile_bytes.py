"""Ways to break a file that know how files are built: elements of XML, chunks and events of MIDI, words, encodings.

Each takes the bytes of a file, those of other files, and a source of chance, and gives other bytes.
"""

import codecs
import random
import re
import struct
from collections.abc import Callable, Sequence

Way = Callable[[bytes, Sequence[bytes], random.Random], bytes]

NUMBERS = (
    *(b"0", b"-0", b"-1", b"1", b"2", b"7", b"127", b"128", b"255", b"999", b"32768", b"65536", b"1000000"),
    *(b"2147483647", b"2147483648", b"-2147483649", b"1000000000", b"99999999999999999999", b"9" * 5000),
    *(b"1e308", b"1e-308", b"-1e9", b"1e400", b"NaN", b"-inf", b"Infinity", b"0.0000001", b"0.333333333333", b"1/3"),
    *(b"", b" ", b"1_0", b"0x10", b"+4", b"\xd9\xa3", b"\xc2\xb2", b"3+2+", b"1,2,3"),
)
"""What no programmer thought of where a number was meant; two of them are digits to `str.isdigit` alone."""
_INTEGERS = (-1, 0, 1, 127, 255, 256, 32767, 65535, 0x7FFFFFFF, -0x80000000, 0x00FFFFFF)
_MOST_BYTES = 2_000_000
"""No input is longer (our choice)."""
_ELEMENT = re.compile(rb"<([A-Za-z_][\w.-]*)(?:\s[^<>]*)?>([^<]*)</\1>|<([A-Za-z_][\w.-]*)(?:\s[^<>]*)?/>")
_BLOCK = re.compile(
    rb"<(note|measure|group|pattern|instrument|barline|direction|attributes|Bar|Beat|MasterBar)\b.*?</\1>", re.S
)
_LOUD_EVENTS = (
    *(bytes([0xFF, 0x51, 3]) + us.to_bytes(3, "big") for us in (0, 1, 100, 0xFFFFFF)),
    *(bytes([0xFF, 0x58, 4, beats, power, 24, 8]) for beats, power in ((0, 2), (255, 6), (1, 7), (4, 255), (255, 0))),
    *(
        bytes([0xFF, 0x2F, 0]),
        bytes([0xFF, 0x54, 5, 255, 99, 99, 255, 255]),
        b"\xff\x03\x0aPART DRUMS",
        b"\xff\x59\x02\x80\x09",
    ),
    *(b"\xf0\xff\xff\xff\x7f", b"\xf7\x00", b"\xff\x7f\x80\x80\x80\x00", b"\x99\x26\x64", b"\x26\x64", b"\xb9\x04\x7f"),
)


def number(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    """A number in a text becomes one that no music has, sometimes everywhere."""
    places = list(re.finditer(rb"-?[0-9]+(?:\.[0-9]+)?", data[:200_000]))
    if not places:
        return data + rng.choice(NUMBERS)
    at, new = rng.choice(places), rng.choice(NUMBERS)
    if rng.random() < 0.1:
        return data.replace(at[0], new, _MOST_BYTES // (len(new) + 1))[:_MOST_BYTES]
    return data[: at.start()] + new + data[at.end() :]


def element(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    """An element of XML is emptied, told a hostile number, doubled, taken out, renamed or put where another stood."""
    found = list(_ELEMENT.finditer(data[:200_000]))
    if not found:
        return number(data, (), rng)
    one, other = rng.choice(found), rng.choice(found)
    name = one[1] or one[3]
    ways = (b"", one[0] * 2, _many(one[0], rng.choice((50, 2000))), other[0], b"<%s/>" % name)
    ways += (b"<%s>%s</%s>" % (name, rng.choice(NUMBERS), name), b"<%s>%s</%s>" % (name, one[0], name))
    return _put(data, one.start(), one.end(), rng.choice(ways))


def block(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    """A whole note, measure or pattern again and again, within another, or gone."""
    found = list(_BLOCK.finditer(data[:200_000]))
    if not found:
        return lines_again(data, (), rng)
    one, other = rng.choice(found), rng.choice(found)
    inside = other[0].find(b">") + 1
    ways = (b"", _many(one[0], rng.choice((2, 30, 500))), other[0], other[0][:inside] + one[0] + other[0][inside:])
    return _put(data, one.start(), one.end(), rng.choice(ways))


def deep(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    """A word or a bracket of the file as often and as deep as a parser's stack bears, or does not."""
    words = re.findall(rb"<[A-Za-z][\w-]*>|[\[\]{}()|:%&#=;,-]|[A-Za-z]{1,8}", data[:20_000]) or [b"("]
    at = rng.randrange(len(data) + 1)
    return _put(data, at, at, _many(rng.choice(words), rng.choice((65, 1000, 100_000))))


def lines_again(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    """Some lines again and again, or in another order."""
    lines = data.split(b"\n")
    a = rng.randrange(len(lines))
    b = min(a + rng.choice((1, 1, 3, 10)), len(lines))
    length = sum(len(line) + 1 for line in lines[a:b])
    some = lines[a:b] * min(rng.choice((2, 100, 3000)), _MOST_BYTES // length + 1)
    some = rng.sample(some, len(some)) if rng.random() < 0.3 else some
    return b"\n".join(lines[:a] + some + lines[b:])[:_MOST_BYTES]


def encoded(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    """The text in another encoding, with another mark of it, other line ends, or zeros between."""
    text = data.decode("utf-8", "replace")
    other = rng.choice(("utf-16", "utf-16-be", "utf-32", "cp037", "shift_jis", "utf-7"))
    marks = (codecs.BOM_UTF8, codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE, codecs.BOM_UTF32_LE)
    ways = (text.encode(other, "replace"), rng.choice(marks) + data, data.replace(b"\n", b"\r"))
    return rng.choice((*ways, data.replace(b" ", "\u2028\u00a0\u202e".encode()), data.replace(b"\n", b"\0")))


def event(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    """Events of MIDI that few programs send, once or very often, at any place of a track."""
    at = rng.randrange(14, len(data) + 1) if len(data) > 14 else len(data)
    delta = rng.choice((b"\0", b"\0", b"\x01", b"\x83\x60", b"\xff\xff\xff\x7f", b"\x80\x80\x80\x00"))
    return _put(data, at, at, (delta + rng.choice(_LOUD_EVENTS)) * rng.choice((1, 1, 4, 3000)))


def chunk(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    """The head of a MIDI file or the length of a track says what is not so; or one track comes many times."""
    tracks = [m.start() for m in re.finditer(b"MTrk", data)]
    if not tracks or len(data) < 14:
        return integer(data, (), rng)
    if rng.random() < 0.4:
        at, words = rng.choice((8, 10, 12)), (0, 1, 2, 65535, 32767, 0xE728, 0xE700, 0x8001, 0x80FF)
        return data[:at] + struct.pack(">H", rng.choice(words)) + data[at + 2 :]
    at = rng.choice(tracks)
    if rng.random() < 0.5:
        return data[: at + 4] + struct.pack(">i", rng.choice(_INTEGERS)) + data[at + 8 :]
    return data[:at] + (data[at:][:5000] * rng.choice((2, 300)))[:_MOST_BYTES]


def integer(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    """Four bytes become a count that cannot be, as Guitar Pro's files have it."""
    at = rng.randrange(max(len(data) - 4, 1))
    return data[:at] + struct.pack("<i", rng.choice(_INTEGERS)) + data[at + 4 :]


def _many(data: bytes, times: int) -> bytes:
    return data * min(times, _MOST_BYTES // len(data) + 1)


def _put(data: bytes, start: int, end: int, new: bytes) -> bytes:
    return data[:start] + new[: max(_MOST_BYTES - len(data), 0)] + data[end:]


def ways_for(data: bytes) -> tuple[Way, ...]:
    """The ways that fit what the file seems to be."""
    if data[:4] == b"MThd":
        return (event, event, chunk)
    if b"<" in data[:400] and b">" in data[:2000]:
        return (element, element, block, number, deep, encoded)
    if b"\0" in data[:2000]:
        return (integer, integer, integer)
    return (number, number, lines_again, deep, encoded)

"""Expected messages are read off the MIDI 1.0 specification by hand."""

import pytest

from station.devices.midi.midi_tokens import LONGEST_SYSEX, MidiTokenizer


def messages(data: str) -> list[str]:
    return [message.hex(" ") for message in MidiTokenizer().feed(bytes.fromhex(data))]


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        pytest.param("99 26 64", ["99 26 64"], id="note on"),
        pytest.param("99 26 64 2a 50 26 00", ["99 26 64", "99 2a 50", "99 26 00"], id="running status"),
        pytest.param("c9 05 06 d9 40", ["c9 05", "c9 06", "d9 40"], id="one data byte"),
        pytest.param("99 f8 26 fe 64", ["f8", "fe", "99 26 64"], id="real time inside a message"),
        pytest.param("f0 7e f8 01 f7 ", ["f8", "f0 7e 01 f7"], id="real time inside system exclusive"),
        pytest.param("99 26 64 f8 2a 50", ["99 26 64", "f8", "99 2a 50"], id="real time keeps running status"),
        pytest.param("99 26 64 f2 01 02 2a 50", ["99 26 64", "f2 01 02"], id="system common ends running status"),
        pytest.param("99 26 64 f6 2a 50", ["99 26 64", "f6"], id="tune request ends running status"),
        pytest.param("99 26 64 f4 2a 50", ["99 26 64"], id="an undefined status ends running status"),
        pytest.param("f1 11 22", ["f1 11"], id="system common has no running status"),
        pytest.param("99 26 64 f0 01 f7 2a 50", ["99 26 64", "f0 01 f7"], id="system exclusive ends running status"),
        pytest.param("f0 01 02 99 26 64", ["99 26 64"], id="a status ends system exclusive, which is dropped"),
        pytest.param("f7 26 64", [], id="a stray end of exclusive"),
        pytest.param("26 64 99 26 64", ["99 26 64"], id="data without a status"),
        pytest.param("99 26 89 26 40", ["89 26 40"], id="a message cut short"),
        pytest.param("99 26 99 2a 50", ["99 2a 50"], id="a lost byte costs one message"),
        pytest.param("f9 fd 99 f9 26 64", ["99 26 64"], id="undefined real time"),
        pytest.param("", [], id="nothing"),
    ],
)
def test_a_stream_falls_into_its_messages(data: str, expected: list[str]) -> None:
    assert messages(data) == expected


def test_a_message_may_come_byte_by_byte() -> None:
    tokens = MidiTokenizer()
    assert [tokens.feed(bytes((byte,))) for byte in (0x99, 0x26)] == [[], []]
    assert tokens.feed(b"\x64") == [b"\x99\x26\x64"]


def test_reset_forgets_half_a_message_and_the_running_status() -> None:
    tokens = MidiTokenizer()
    tokens.feed(bytes.fromhex("99 26"))
    tokens.reset()
    assert tokens.feed(bytes.fromhex("64 26 64")) == []


def test_endless_system_exclusive_is_dropped_and_does_not_fill_the_memory() -> None:
    tokens = MidiTokenizer()
    assert tokens.feed(b"\xf0" + b"\x01" * (LONGEST_SYSEX + 1) + b"\xf7") == []
    assert tokens.feed(bytes.fromhex("99 26 64")) == [b"\x99\x26\x64"]
    assert len(tokens.unfinished()) < 4

"""Properties of the way from bytes to hits, on streams built from known messages.

The expected value is the list of messages that a stream was built from: the builder below writes them as a sender may
(running status, real-time bytes anywhere), and knows nothing of the tokenizer.
"""

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from station.core.events import Hit
from station.devices.mapping.presets import PRESETS, preset_named
from station.devices.midi.midi_decoder import MidiDecoder
from station.devices.midi.midi_tokens import MidiTokenizer

DATA = st.integers(0, 0x7F)
REAL_TIME = st.sampled_from([0xF8, 0xFA, 0xFB, 0xFC, 0xFE, 0xFF])
PRESET = st.sampled_from(sorted(PRESETS))
HOSTILE = st.one_of(
    st.binary(max_size=300), st.lists(st.sampled_from([0x99, 0xB9, 0xA9, 0xF0, 0xF7, 4, 38]), max_size=200).map(bytes)
)


@st.composite
def streams(draw: st.DrawFn) -> tuple[bytes, list[bytes]]:
    """A stream and its messages in the order of completion."""
    data = bytearray()
    messages: list[bytes] = []
    running = 0
    for _ in range(draw(st.integers(0, 20))):
        kind = draw(st.sampled_from(["channel", "channel", "channel", "sysex", "common", "stray"]))
        if kind == "channel":
            status = draw(st.integers(0x80, 0xEF))
            message = bytes((status, *(draw(DATA) for _ in range(1 if status >> 4 in (0xC, 0xD) else 2))))
            written = message[1:] if status == running and draw(st.booleans()) else message
            running = status
        elif kind == "sysex":
            message = written = bytes((0xF0, *draw(st.lists(DATA, max_size=8)), 0xF7))
            running = 0
        elif kind == "common":
            message = written = draw(st.sampled_from([b"\xf1\x01", b"\xf2\x01\x02", b"\xf3\x05", b"\xf6"]))
            running = 0
        else:  # what no status explains: an undefined status, then data that must be dropped
            written, message = bytes((0xF5, *draw(st.lists(DATA, max_size=4)))), b""
            running = 0
        for index, byte in enumerate(written):
            if draw(st.integers(0, 9)) == 0:
                real_time = draw(REAL_TIME)
                data.append(real_time)
                messages.append(bytes((real_time,)))
            data.append(byte)
            if message and index == len(written) - 1:
                messages.append(message)
    return bytes(data), messages


def cut(data: bytes, places: list[int]) -> list[bytes]:
    edges = [0, *sorted(place % (len(data) + 1) for place in places), len(data)]
    return [data[a:b] for a, b in pairwise(edges)]


@given(streams(), st.lists(st.integers(0, 10_000), max_size=8))
def test_any_division_of_a_stream_gives_the_messages_it_was_built_from(
    stream: tuple[bytes, list[bytes]], places: list[int]
) -> None:
    data, messages = stream
    tokens = MidiTokenizer()
    assert [message for part in cut(data, places) for message in tokens.feed(part)] == messages


@given(streams(), st.integers(0, 10_000), PRESET)
def test_hits_are_the_notes_that_were_sent(stream: tuple[bytes, list[bytes]], place: int, preset: str) -> None:
    data, messages = stream
    sent = [(m[1], m[2]) for m in messages if m[0] >> 4 == 0x9 and m[2] > 0]
    decoder = MidiDecoder(preset_named(preset))
    events = [event for part in cut(data, [place]) for event in decoder.feed(part, 0)]
    assert [(hit.midi_note, hit.velocity) for hit in events if isinstance(hit, Hit)] == sent


@given(HOSTILE, st.lists(st.integers(0, 10_000), max_size=8), PRESET)
def test_any_division_of_any_bytes_gives_the_same_events(data: bytes, places: list[int], preset: str) -> None:
    whole = MidiDecoder(preset_named(preset)).feed(data, 0)
    divided = MidiDecoder(preset_named(preset))
    assert [event for part in cut(data, places) for event in divided.feed(part, 0)] == whole


@given(HOSTILE, PRESET)
def test_hostile_bytes_neither_crash_nor_leave_the_ranges(data: bytes, preset: str) -> None:
    for event in MidiDecoder(preset_named(preset)).feed(data, 0):
        if isinstance(event, Hit):
            assert 1 <= event.velocity <= 127
            assert event.openness is None or 0.0 <= event.openness <= 1.0


@given(st.lists(st.integers(0, 255).filter(lambda byte: byte >> 4 != 0x9), max_size=300).map(bytes), PRESET)
def test_without_a_note_on_there_is_no_hit(data: bytes, preset: str) -> None:
    assert not any(isinstance(event, Hit) for event in MidiDecoder(preset_named(preset)).feed(data, 0))


@given(HOSTILE, HOSTILE, PRESET)
def test_a_new_decoder_takes_over_where_another_stands(before: bytes, after: bytes, preset: str) -> None:
    """What a capture begins with, so that its replay decodes as the engine did."""
    first, heir = MidiDecoder(preset_named(preset)), MidiDecoder(preset_named(preset))
    first.feed(before, 0)
    heir.feed(first.restart_state(), 0)
    assert heir.feed(after, 1) == first.feed(after, 1)

"""Any bytes: a MIDI file is read or refused in one line, in bounded memory; and it is read as mido reads it."""

import io
import tracemalloc
from pathlib import Path

import mido
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.music.formats.smf.standard_midi import MidiFile, parse_midi, performance_from_midi, score_from_midi
from tests.fakes.smf_bytes import END, chunk, event, header, meta, meter, number, tempo, track
from tests.real_data import real_files

NAME = "fuzz.mid"

SMALL_FILE = (
    header(1, 2, 480)
    + track(meta(0, 3, b"Song"), meter(0, 6, 3), tempo(0, 400_000), tempo(960, 300_000))
    + track(
        event(0, 0x99, 36, 100),
        event(120, 36, 0),
        event(0, 0xB9, 4, 90),
        *[event(i, 0x99, 42, 1 + i) for i in range(40)],
        event(0, 0xA9, 49, 127),
        event(0, 0xC9, 3),
        event(0, 0xF0, 3, 0x7E, 0x7F, 0xF7),
        event(0x3FFF, 0x89, 42, 0),
    )
)


def read_or_refuse(data: bytes) -> MidiFile | None:
    """Read, convert both ways; None if it was refused, and then in one line that names the file."""
    try:
        midi = parse_midi(data, NAME)
        score_from_midi(midi)
        performance_from_midi(midi)
    except BadInput as fault:
        line = str(fault)
        assert line.startswith(f"{NAME}: ")
        assert line.splitlines() == [line]
        return None
    return midi


@given(st.binary(max_size=400))
def test_any_bytes(data: bytes) -> None:
    assert read_or_refuse(data) is None, "nothing that random bytes hold is a MIDI file"


@given(
    st.sampled_from([0, 1, 2]),
    st.integers(0, 3),
    st.integers(0, 0xFFFF),
    st.lists(st.binary(max_size=200), max_size=3),
)
def test_any_content_of_well_formed_chunks(form: int, tracks: int, division: int, contents: list[bytes]) -> None:
    read_or_refuse(header(form, tracks, division) + b"".join(chunk(b"MTrk", content) for content in contents))


@given(st.lists(st.tuples(st.integers(0, len(SMALL_FILE) - 1), st.integers(0, 255)), min_size=1, max_size=6))
def test_any_bytes_changed_in_a_good_file(changes: list[tuple[int, int]]) -> None:
    data = bytearray(SMALL_FILE)
    for at, byte in changes:
        data[at] = byte
    read_or_refuse(bytes(data))


@pytest.mark.parametrize("cut", range(len(SMALL_FILE)))
def test_a_file_cut_anywhere_is_refused(cut: int) -> None:
    assert read_or_refuse(SMALL_FILE[:cut]) is None


def test_the_file_that_is_cut_is_good() -> None:
    assert read_or_refuse(SMALL_FILE) is not None


@pytest.mark.parametrize(
    "path", real_files("gmd/drummer1/eval_session/1_*.mid", "midi/jazzsoft/test-multichannel-chords-1.mid")
)
def test_a_real_file_cut_at_any_byte_is_refused(path: Path) -> None:
    data = path.read_bytes()
    for cut in range(len(data)):
        with pytest.raises(BadInput):
            parse_midi(data[:cut], NAME)


# --- as mido reads it -------------------------------------------------------------------------------------------------

data_byte = st.integers(0, 127)
delta = st.sampled_from([0, 0, 1, 96, 127, 128, 0x3FFF, 0x4000, 0xFFFFF])
channel_message = st.one_of(
    st.tuples(st.integers(0x80, 0xBF), data_byte, data_byte),
    st.tuples(st.sampled_from([0x99, 0x99, 0x89, 0xB9, 0xA9]), data_byte, data_byte),
    st.tuples(st.integers(0xC0, 0xDF), data_byte),
    st.tuples(st.integers(0xE0, 0xEF), data_byte, data_byte),
)
metas = st.one_of(
    st.builds(tempo, delta, st.integers(1, 0xFFFFFF)),
    st.builds(meter, delta, st.integers(1, 16), st.integers(0, 5)),
    st.builds(meta, delta, st.sampled_from([1, 3, 6]), st.text("abc äö", max_size=5).map(str.encode)),
)


@st.composite
def tracks(draw: st.DrawFn) -> bytes:
    """A good track in which status bytes are left out wherever they may be, in segments short and long."""
    parts, running = [], None
    for _ in range(draw(st.integers(0, 4))):
        messages = draw(st.lists(st.tuples(delta, channel_message), max_size=30))
        for gap, message in messages:
            leave_out = message[0] == running and draw(st.booleans())
            parts.append(event(gap, *message[1:] if leave_out else message))
            running = message[0]
        parts.append(draw(metas))
        running = None  # RP-001: a meta event ends running status
    return track(*parts)


@given(st.lists(tracks(), min_size=1, max_size=2), st.sampled_from([24, 96, 480, 999]))
@settings(deadline=None)
def test_good_files_read_as_mido_reads_them(content: list[bytes], division: int) -> None:
    data = header(1, len(content), division) + b"".join(content)
    theirs = mido.MidiFile(file=io.BytesIO(data))
    for ours, track_ in zip(parse_midi(data, NAME).tracks, theirs.tracks, strict=True):
        tick, notes, controllers, pressures = 0, [], [], []
        for message in track_:
            tick += message.time
            if message.type == "note_on" and message.velocity:
                notes.append((tick, message.channel, message.note, message.velocity))
            elif message.type == "control_change":
                controllers.append((tick, message.channel, message.control, message.value))
            elif message.type == "polytouch":
                pressures.append((tick, message.channel, message.note, message.value))
        assert ours.notes[["tick", "channel", "number", "velocity"]].tolist() == notes
        assert ours.controllers[["tick", "channel", "number", "value"]].tolist() == controllers
        assert ours.aftertouch[["tick", "channel", "number", "value"]].tolist() == pressures
        assert ours.end_tick == tick


# --- bounds -----------------------------------------------------------------------------------------------------------

MEBIBYTE = 1 << 20
WORST = {
    "notes": event(0, 0x99, 38, 1),
    "running status": event(0, 38, 1),
    "one data byte": event(0, 0xD9, 1),
    "texts": meta(0, 1),
    "tempos": tempo(1, 500_000),
    "meters": meter(1, 1, 2),
    "system messages": event(0, 0xF8),
    "short segments": event(0, 0x99, 38, 1) * 8 + event(0, 0xD9, 1),
    "chokes": event(1, 0xA9, 49, 127) + event(1, 0xA9, 49, 0),
    "deltas": number(0x7F) + bytes([0xB9, 4, 5]),
}


@pytest.mark.parametrize("unit", WORST.values(), ids=WORST.keys())
def test_memory_stays_within_eighty_times_the_file(unit: bytes) -> None:
    """128 kB of the same event over and over."""
    start = event(0, 0x99, 38, 1)
    data = header(division=96) + chunk(b"MTrk", start + unit * (MEBIBYTE // 8 // len(unit)) + END)
    tracemalloc.start()
    try:
        assert read_or_refuse(data) is not None
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 80 * len(data)


@pytest.mark.parametrize("lie", [0xFFFF_FFFF, 0x7FFF_FFFF, 0x0010_0000])
def test_a_chunk_that_lies_about_its_length_takes_no_memory(lie: int) -> None:
    data = header(1, 0xFFFF) + b"MTrk" + lie.to_bytes(4, "big") + END
    tracemalloc.start()
    try:
        assert read_or_refuse(data) is None
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < MEBIBYTE

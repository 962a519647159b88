"""A capture gives the same hits again, to the nanosecond, whatever cut the engine's time and bytes into pieces.

Real playing: recordings of the Groove MIDI Dataset (Roland TD-11). mido's account of the same files (another
implementation) says which notes the engine must have heard.
"""

from pathlib import Path

import mido
import pytest

from station.core.events import DeviceEvent, Hit
from station.core.units import NS_PER_S
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay
from station.engine.engine import Engine
from station.engine.messages import RecordCapture
from tests.real_data import DATA, real_files

DEVICE = "TD-11"
SHORT = DATA / "gmd/drummer3/session1/10_rock_105_beat_4-4.mid"
TAKES = real_files("gmd/**/*.mid")[::6]


def messages_of(path: Path) -> list[tuple[int, mido.Message]]:
    """The file's channel messages, each with its time in nanoseconds."""
    at_s = 0.0
    found = []
    for message in mido.MidiFile(path):
        at_s += message.time
        if not message.is_meta:
            found.append((round(at_s * NS_PER_S), message))
    return found


def play(messages: list[tuple[int, mido.Message]], capture: Path, steps_per_s: int, piece: int) -> list[DeviceEvent]:
    """Let an engine hear `messages`, in pieces of `piece` bytes, advanced `steps_per_s` times a second."""
    engine = Engine()
    engine.device_found(DEVICE, 0)
    engine.handle(RecordCapture(capture))
    step_ns = NS_PER_S // steps_per_s
    now_ns = 0
    told: list[object] = []
    for at_ns, message in messages:
        while now_ns + step_ns <= at_ns:
            now_ns += step_ns
            told += engine.advance(now_ns)
        data = message.bin()
        for begin in range(0, len(data), piece):
            engine.feed(DEVICE, bytes(data[begin : begin + piece]), at_ns)
    told += engine.advance(now_ns + step_ns)
    engine.close()
    return [event for event in told if isinstance(event, DeviceEvent)]


@pytest.mark.parametrize("take", TAKES)
def test_real_playing_is_heard_and_replayed_alike(take: Path, tmp_path: Path) -> None:
    messages = messages_of(take)
    runs = []
    for number, (steps_per_s, piece) in enumerate([(1, 3), (60, 1), (1000, 2)]):
        told = play(messages, tmp_path / f"{number}.cap", steps_per_s, piece)
        replayed = list(replay(read_capture(tmp_path / f"{number}.cap")))
        assert replayed == told[1:]  # that the kit was found is older than the capture
        runs.append(replayed)
    assert runs[0] == runs[1] == runs[2]
    sent = [(at_ns, m.note, m.velocity) for at_ns, m in messages if m.type == "note_on" and m.velocity]
    assert [(hit.at_ns, hit.midi_note, hit.velocity) for hit in runs[0] if isinstance(hit, Hit)] == sent


def test_a_capture_cut_anywhere_replays_up_to_there(tmp_path: Path) -> None:
    path = tmp_path / "take.cap"
    told = play(messages_of(SHORT), path, 60, 3)[1:]
    data = path.read_bytes()
    for length in range(100, len(data), len(data) // 200):
        path.write_bytes(data[:length])
        replayed = list(replay(read_capture(path)))
        assert replayed == told[: len(replayed)]

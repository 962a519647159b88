"""Real processes, real ports, real bytes: a fake kit plays through JACK into the engine, and JACK records the sound.

The expected values are the fake kit's own: what it sent and when. The machine may be shared, so single events may come
late; none may be lost, and the many must be in time.
"""

import time
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.events import Choke, DeviceFound, DeviceLost, Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay, transport_zeros_ns
from station.devices.device_ports import DeviceRequest
from station.engine.engine_config import EngineConfig
from station.engine.engine_process import EngineProcess
from station.engine.messages import EngineEvent, KeyHit, Notice, Play, Ready, RecordCapture, Started
from tests.fakes.cues import clicks
from tests.fakes.engine_listener import EngineListener
from tests.fakes.jack_recorder import JackRecorder, Recording
from tests.fakes.jack_server import JackServer
from tests.fakes.kit_player import KitPlayer, Stroke
from tests.fakes.stillness import Stillness

pytestmark = pytest.mark.jack

Times = NDArray[np.int64]

KIT = "TD-17 fake kit"
CONFIG = EngineConfig(kits=(DeviceRequest(KIT),), midi_driver="jack", output="jack")
OUTPUTS = "PortAudio:.*"
LEAD_NS = 300 * NS_PER_MS
CLICKS_NS = np.arange(9) * 125 * NS_PER_MS
DROPOUTS = 3
MOST = 0.75
"""The machine may be shared: so many swallowed blocks do not count, and this share must be in time."""

FEWEST = 4
"""Of fewer moments in which the machine ran nothing is said."""
AROUND_NS = 300 * NS_PER_MS
"""So long before and after it stood still a machine catches up."""

NOTES = [  # a TD-17's numbers, and the least and greatest spectral centroid that a drummer would grant the piece
    (36, Piece.KICK, 30.0, 450.0),
    (38, Piece.SNARE, 500.0, 4_000.0),
    (42, Piece.HIHAT, 4_000.0, 20_000.0),
    (43, Piece.FLOOR_TOM_1, 50.0, 450.0),
]


def stands(stillness: Stillness, at_ns: int) -> bool:
    """Whether the machine stood still about a moment: what was due then could not be heard then."""
    return stillness.stood(at_ns - AROUND_NS, at_ns + AROUND_NS)


def is_trouble(event: EngineEvent) -> bool:
    """A notice of anything but that the kit is made, as on a computer's first day."""
    return isinstance(event, Notice) and "is being made" not in event.text


def notes(strokes: list[Stroke]) -> list[Stroke]:
    """The strokes alone: notes with a velocity."""
    return [stroke for stroke in strokes if stroke.data[0] == 0x99 and stroke.data[2]]


def groove(count: int, every_ns: int) -> list[Stroke]:
    """Strokes in turn on four pieces at velocities 60–124, each hi-hat after its pedal, and the note off of each."""
    strokes = []
    for index in range(count):
        note = NOTES[index % len(NOTES)][0]
        at_ns = index * every_ns
        if note == 42:
            strokes.append(Stroke(at_ns - NS_PER_MS, bytes((0xB9, 4, 127))))
        strokes.append(Stroke(at_ns, bytes((0x99, note, 60 + (index * 8) % 65))))
        strokes.append(Stroke(at_ns + 10 * NS_PER_MS, bytes((0x89, note, 64))))
    return strokes


def test_a_kit_in_another_process_is_heard_and_sounds(jack_server: JackServer, tmp_path: Path) -> None:
    strokes = [*groove(24, 150 * NS_PER_MS), Stroke(3_700 * NS_PER_MS, bytes.fromhex("a9 31 7f"))]
    with (
        KitPlayer(jack_server, KIT, strokes, tmp_path) as kit,
        EngineProcess(CONFIG) as engine,
        JackRecorder(jack_server, tmp_path) as recorder,
        Stillness() as stillness,
    ):
        listener = EngineListener(engine)
        ready = listener.until(lambda event: isinstance(event, Ready))
        assert isinstance(ready, Ready)
        assert ready.output == "system"
        listener.until(lambda event: isinstance(event, DeviceFound))
        recorder.connect(OUTPUTS)
        engine.send(RecordCapture(tmp_path / "take.cap"))
        engine.send(Play(clicks(CLICKS_NS), LEAD_NS))
        started = listener.until(lambda event: isinstance(event, Started))
        assert isinstance(started, Started)
        kit.play(started.zero_ns + 1_500 * NS_PER_MS)
        sent = kit.truth()
        listener.until(lambda event: isinstance(event, Choke))
        engine.send(RecordCapture(None))
        listener.until_after(sent[-1].at_ns + NS_PER_S // 2)
        heard = recorder.stop()

    assert not [event for event in listener.events if isinstance(event, DeviceLost) or is_trouble(event)]
    period_ns = NS_PER_S * jack_server.period_frames / jack_server.rate_hz
    check_hits(listener.hits(), notes(sent), period_ns)
    click_onsets = [frame for frame in heard.onsets() if heard.at_ns[frame] < started.zero_ns + 1_250 * NS_PER_MS]
    still_clicks_ns = [at for at in CLICKS_NS.tolist() if not stands(stillness, started.zero_ns + at)]
    if len(still_clicks_ns) >= FEWEST:
        check_clicks(heard.at_ns[click_onsets] - started.zero_ns, np.array(still_clicks_ns), period_ns)
    still_strokes = [stroke for stroke in notes(sent) if not stands(stillness, stroke.at_ns)]
    if len(still_strokes) >= FEWEST:
        check_sounds(heard, still_strokes, period_ns)
        if len(still_strokes) == len(notes(sent)):
            assert np.count_nonzero(heard.at_ns[heard.onsets()] >= sent[0].at_ns) - len(notes(sent)) <= DROPOUTS
    capture = read_capture(tmp_path / "take.cap")
    assert capture.complete
    assert [event for event in replay(capture) if isinstance(event, Hit)] == listener.hits()


def test_a_kit_that_is_unplugged_and_plugged_in_again_plays_on(jack_server: JackServer, tmp_path: Path) -> None:
    with EngineProcess(CONFIG) as engine:
        listener = EngineListener(engine)
        listener.until(lambda event: isinstance(event, Ready))
        for kind in ("first", "second"):
            (tmp_path / kind).mkdir()
            with KitPlayer(jack_server, KIT, groove(8, 20 * NS_PER_MS), tmp_path / kind) as kit:
                plugged_ns = time.monotonic_ns()
                listener.events.clear()
                found = listener.until(lambda event: isinstance(event, DeviceFound))
                assert isinstance(found, DeviceFound)
                assert found.at_ns - plugged_ns < 10 * NS_PER_S  # 1 s, and what a busy machine adds
                kit.play(time.monotonic_ns() + 100 * NS_PER_MS)
                sent = notes(kit.truth())
                listener.until_after(sent[-1].at_ns)
            assert [hit.midi_note for hit in listener.hits()] == [stroke.data[1] for stroke in sent]
            lost = listener.until(lambda event: isinstance(event, DeviceLost))
            assert isinstance(lost, DeviceLost)
            assert lost.device == f"{KIT}:out"


def test_a_sound_server_that_ends_leaves_a_silent_engine(jack_server: JackServer, tmp_path: Path) -> None:
    """JACK takes card and kit along; the transport runs on, keys still play, and the capture is whole."""
    with KitPlayer(jack_server, KIT, [], tmp_path), EngineProcess(CONFIG) as engine:
        listener = EngineListener(engine)
        listener.until(lambda event: isinstance(event, Ready))
        listener.until(lambda event: isinstance(event, DeviceFound))
        engine.send(RecordCapture(tmp_path / "take.cap"))
        jack_server.stop()
        listener.until(lambda event: isinstance(event, DeviceLost))
        listener.until(lambda event: isinstance(event, Notice) and "silent" in event.text)
        engine.send(Play(clicks([0]), LEAD_NS))
        started = listener.until(lambda event: isinstance(event, Started))
        engine.send(KeyHit(5, Piece.KICK, Zone.HEAD, 90))
        listener.until(lambda event: isinstance(event, Hit))
    assert isinstance(started, Started)
    capture = read_capture(tmp_path / "take.cap")
    assert capture.complete
    assert transport_zeros_ns(capture) == [started.zero_ns]
    assert [type(event) for event in replay(capture)] == [DeviceLost, Hit]


def in_ms(times_ns: Times) -> list[float]:
    return [round(time_ns / NS_PER_MS, 1) for time_ns in times_ns.tolist()]


def check_hits(hits: list[Hit], sent: list[Stroke], period_ns: float) -> None:
    """Every stroke once, as it was sent; stamped within two periods and what a busy machine adds."""
    pieces = {note: piece for note, piece, _, _ in NOTES}
    assert [(hit.midi_note, hit.velocity) for hit in hits] == [(stroke.data[1], stroke.data[2]) for stroke in sent]
    assert [hit.piece for hit in hits] == [pieces[stroke.data[1]] for stroke in sent]
    assert {hit.openness for hit in hits if hit.piece is Piece.HIHAT} == {0.0}
    assert {hit.device for hit in hits} == {f"{KIT}:out"}
    late_ns = np.array([hit.at_ns - stroke.at_ns for hit, stroke in zip(hits, sent, strict=True)])
    assert late_ns.min() > -0.3 * NS_PER_MS
    assert np.median(late_ns) < 2 * period_ns, in_ms(late_ns)
    assert np.mean(late_ns < 2 * period_ns + 10 * NS_PER_MS) >= MOST, in_ms(late_ns)


def check_clicks(onset_ns: Times, clicks_ns: Times, period_ns: float) -> None:
    """Every click where its cue says, taken by JACK a few periods before it is heard."""
    nearest = np.abs(onset_ns[:, None] - clicks_ns).argmin(axis=0)
    offset_ns = onset_ns[nearest] - clicks_ns
    assert -6 * period_ns < np.median(offset_ns) < period_ns, in_ms(offset_ns)
    assert np.mean(np.abs(offset_ns - np.median(offset_ns)) < 1.5 * NS_PER_MS) >= MOST, in_ms(offset_ns)
    if len(clicks_ns) == len(CLICKS_NS):
        assert abs(len(onset_ns) - len(CLICKS_NS)) <= DROPOUTS


def check_sounds(heard: Recording, sent: list[Stroke], period_ns: float) -> None:
    """One onset a stroke, nearly all of them soon after it, each with the sound of its piece.

    A stalled machine may swallow a block here and there; where a drum rang on, that too looks like an onset.
    """
    onsets = np.array(heard.onsets())
    onset_ns = heard.at_ns[onsets]
    first_after = np.searchsorted(onset_ns, [stroke.at_ns for stroke in sent])
    assert first_after.max() < len(onsets), "a stroke at the end was not heard"
    late_ns = onset_ns[first_after] - np.array([stroke.at_ns for stroke in sent])
    assert np.median(late_ns) < 4 * period_ns, in_ms(late_ns)
    assert np.mean(late_ns < 4 * period_ns + 10 * NS_PER_MS) >= MOST, in_ms(late_ns)
    limits = {note: (lowest_hz, highest_hz) for note, _, lowest_hz, highest_hz in NOTES}
    centroids_hz = [heard.centroid_hz(int(onsets[index])) for index in first_after]
    strange = [
        (stroke.data[1], round(hz))
        for stroke, hz in zip(sent, centroids_hz, strict=True)
        if not limits[stroke.data[1]][0] < hz < limits[stroke.data[1]][1]
    ]
    assert len(strange) <= DROPOUTS, strange

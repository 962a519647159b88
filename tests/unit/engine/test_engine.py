"""The engine with a fake card and a clock moved by hand; expected frames and times are worked out beside each test."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeVar

import numpy as np
import pytest

from station.core.clock import ManualClock
from station.core.events import Choke, DeviceFound, DeviceLost, Hit, PedalMoved
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay, transport_zeros_ns
from station.devices.mapping.device_map import Pad
from station.devices.mapping.presets import preset_named
from station.engine.engine import KEYBOARD, Engine, OutputState
from station.engine.messages import (
    AddCues,
    Bus,
    CaptureSaved,
    EngineEvent,
    KeyHit,
    Notice,
    Play,
    Quit,
    RawBytes,
    RecordCapture,
    ReloadDevice,
    Resume,
    SetLevel,
    SetPiece,
    Started,
    Status,
    Stop,
    WatchRawBytes,
)
from tests.fakes.audio_sink import AudioSink
from tests.fakes.cues import clicks, stroke_cue
from tests.fakes.impulse_kit import LEVEL, impulse_mixer

E = TypeVar("E")

KIT = "TD-17"
SNARE = bytes.fromhex("99 26 7f")
FRAME_NS = NS_PER_S / 48_000


@dataclass
class Rig:
    """An engine that sounds through a fake card."""

    drift: float = 0.0
    block_frames: int = 64
    ring_frames: int = 1
    clock: ManualClock = field(default_factory=lambda: ManualClock(100 * NS_PER_S))

    def __post_init__(self) -> None:
        self.engine = Engine(impulse_mixer(ring_frames=self.ring_frames))
        self.engine.advance(self.clock.now_ns())
        self.sink = AudioSink(self.engine, self.clock, block_frames=self.block_frames, drift=self.drift)

    def run_ms(self, milliseconds: float) -> list[EngineEvent]:
        return self.sink.run(round(milliseconds * NS_PER_MS))


def only(events: list[EngineEvent], kind: type[E]) -> E:
    (event,) = [event for event in events if isinstance(event, kind)]
    return event


# --- strokes ---------------------------------------------------------------------------------------------------------


def test_a_stroke_sounds_from_the_next_blocks_first_frame() -> None:
    rig = Rig()
    rig.run_ms(10)
    before = len(rig.sink.sound)
    rig.engine.feed(KIT, SNARE, rig.clock.now_ns())
    rig.run_ms(2)
    assert np.flatnonzero(rig.sink.sound[:, 0]).tolist() == [before]


def test_a_velocity_between_two_numbers_sounds_between_them() -> None:
    """Controller 88 says 64 of 128: 100.5. The sound is LEVEL·(100.5/127)² loud."""
    rig = Rig()
    rig.engine.feed(KIT, bytes.fromhex("b9 58 40 99 26 64"), 0)
    rig.run_ms(5)
    assert rig.sink.sound.max() == pytest.approx(LEVEL * (100.5 / 127) ** 2, rel=1e-4)


def test_a_stroke_is_told_with_its_own_time() -> None:
    rig = Rig()
    rig.engine.feed(KIT, SNARE, 12_345)
    assert only(rig.run_ms(0), Hit) == Hit(12_345, Piece.SNARE, Zone.HEAD, 127, midi_note=38, device=KIT)


def test_pedal_and_choke_are_told_and_the_choke_silences_the_cymbal() -> None:
    rig = Rig(ring_frames=48_000)
    rig.engine.feed(KIT, bytes.fromhex("99 31 7f"), 0)
    rig.run_ms(20)
    rig.engine.feed(KIT, bytes.fromhex("b9 04 7f a9 31 7f"), 1)
    events = rig.run_ms(200)
    assert only(events, PedalMoved).openness == 0.0
    assert only(events, Choke) == Choke(1, Piece.CRASH_1, KIT)
    assert not rig.sink.sound[-64:].any()


def test_a_key_is_a_stroke_that_sounds() -> None:
    rig = Rig()
    rig.engine.handle(KeyHit(9, Piece.KICK, Zone.HEAD, 100))
    assert only(rig.run_ms(2), Hit) == Hit(9, Piece.KICK, Zone.HEAD, 100, device=KEYBOARD)
    assert len(rig.sink.onsets_ns()) == 1


def test_the_students_sound_can_be_muted_apart() -> None:
    rig = Rig()
    rig.engine.handle(SetLevel(Bus.STUDENT, 0.0))
    rig.run_ms(50)
    rig.engine.feed(KIT, SNARE, 0)
    rig.engine.handle(Play(clicks([0]), 0))
    rig.run_ms(10)
    assert np.flatnonzero(rig.sink.sound[:, 0]).size == 1  # the click


@pytest.mark.parametrize("level", [SetLevel(Bus.STUDENT, 0.0), SetPiece(Piece.SNARE, 0.0)])
def test_a_level_outlives_the_card(level: SetLevel | SetPiece) -> None:
    rig = Rig()
    rig.engine.handle(level)
    rig.run_ms(5)
    rig.engine.attach(None)
    rig.engine.attach(impulse_mixer())
    rig.run_ms(50)
    rig.engine.feed(KIT, SNARE, 0)
    rig.run_ms(5)
    assert not rig.sink.sound.any()


def test_a_preset_can_be_chosen_for_a_kit() -> None:
    rig = Rig()
    rig.engine.use_preset("my kit", preset_named("yamaha-dtxplorer"))
    rig.engine.feed("my kit", bytes.fromhex("99 21 7f"), 0)
    assert only(rig.run_ms(0), Hit).piece is Piece.KICK


# --- the transport ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("block_frames", [16, 64, 333, 1024])
def test_cues_fall_on_their_frames_whatever_the_block(block_frames: int) -> None:
    rig = Rig(block_frames=block_frames)
    times_ns = [0, 1_000_000, 20_833_333, 500_000_000]
    rig.engine.handle(Play(clicks(times_ns), 100 * NS_PER_MS))
    started = only(rig.run_ms(800), Started)
    assert started.zero_ns == 100 * NS_PER_S + 100 * NS_PER_MS
    heard = np.array(rig.sink.onsets_ns())
    assert np.abs(heard - started.zero_ns - times_ns).max() <= FRAME_NS / 2 + 1


def test_a_card_that_drifts_moves_no_cue() -> None:
    """100 parts in a million are 6 ms after a minute."""
    rig = Rig(drift=1e-4, block_frames=1024)
    times_ns = [beat * NS_PER_S // 2 for beat in range(120)]
    rig.engine.handle(Play(clicks(times_ns), 10 * NS_PER_MS))
    started = only(rig.run_ms(60_100), Started)
    heard = np.array(rig.sink.onsets_ns())
    assert np.abs(heard - started.zero_ns - times_ns).max() <= FRAME_NS


def test_a_start_that_comes_too_late_for_its_block_begins_with_the_next() -> None:
    rig = Rig()
    rig.run_ms(10)
    rig.engine.handle(Play(clicks([0]), 0))
    started = only(rig.run_ms(10), Started)
    assert rig.sink.onsets_ns() == [pytest.approx(started.zero_ns, abs=1)]


def test_an_engine_goes_on_where_another_one_ended(tmp_path: Path) -> None:
    rig = Rig()
    zero_ns = rig.clock.now_ns() - 100 * NS_PER_MS
    rig.engine.handle(RecordCapture(tmp_path / "take.cap"))
    rig.engine.handle(Resume(clicks([0, 50 * NS_PER_MS, 110 * NS_PER_MS, 130 * NS_PER_MS]), zero_ns))
    events = rig.run_ms(1000)
    rig.engine.close()
    assert rig.sink.onsets_ns() == pytest.approx([zero_ns + 110 * NS_PER_MS, zero_ns + 130 * NS_PER_MS], abs=FRAME_NS)
    assert only(events, Status).late_cues == 0
    assert not [event for event in events if isinstance(event, Started)]  # that has been said
    assert transport_zeros_ns(read_capture(tmp_path / "take.cap")) == []  # and recorded


def test_stop_drops_what_was_to_sound() -> None:
    rig = Rig()
    rig.engine.handle(Play(clicks([0, 50 * NS_PER_MS]), 0))
    rig.run_ms(20)
    rig.engine.handle(Stop())
    rig.run_ms(100)
    assert len(rig.sink.onsets_ns()) == 1


def test_playing_again_begins_anew() -> None:
    rig = Rig()
    rig.engine.handle(Play(clicks([0, 50 * NS_PER_MS]), 0))
    rig.run_ms(20)
    rig.engine.handle(Play(clicks([0]), 10 * NS_PER_MS))
    started = only(rig.run_ms(100), Started)
    assert rig.sink.onsets_ns()[1:] == [pytest.approx(started.zero_ns, abs=FRAME_NS)]


def test_a_cue_of_velocity_0_grabs_the_cymbal() -> None:
    rig = Rig(ring_frames=48_000)
    cues = np.concatenate([stroke_cue(0, Piece.CRASH_1), stroke_cue(100 * NS_PER_MS, Piece.CRASH_1, 0)])
    rig.engine.handle(Play(cues, 0))
    rig.run_ms(300)
    level = np.abs(rig.sink.sound[:, 0])
    assert level[48 * 90] == pytest.approx(LEVEL)
    assert level[-1] == 0.0


def test_cues_may_be_given_in_any_order() -> None:
    rig = Rig()
    rig.engine.handle(Play(clicks([30 * NS_PER_MS, 0, 10 * NS_PER_MS]), 0))
    rig.run_ms(50)
    assert np.diff(rig.sink.onsets_ns()) == pytest.approx([10 * NS_PER_MS, 20 * NS_PER_MS], abs=FRAME_NS)


# --- without a card --------------------------------------------------------------------------------------------------


def test_a_silent_engine_keeps_time_by_the_clock_it_is_told() -> None:
    engine = Engine()
    engine.advance(NS_PER_S)
    engine.handle(Play(clicks([0]), 300 * NS_PER_MS))
    assert engine.advance(NS_PER_S + 1) == [Started(1_300 * NS_PER_MS)]


def test_a_card_lost_before_its_first_block_starts_no_transport_in_the_past() -> None:
    rig = Rig()
    rig.engine.handle(Play(clicks([0]), 300 * NS_PER_MS))
    rig.engine.attach(None)
    now_ns = rig.clock.now_ns() + 3 * NS_PER_S
    assert only(rig.engine.advance(now_ns), Started).zero_ns == now_ns


def test_a_silent_engine_tells_strokes() -> None:
    engine = Engine()
    engine.feed(KIT, SNARE, 5)
    assert only(engine.advance(10), Hit).at_ns == 5


def test_cues_that_a_gap_between_blocks_swallowed_are_dropped_and_counted() -> None:
    rig = Rig()
    rig.engine.handle(Play(clicks([0, 20 * NS_PER_MS, 200 * NS_PER_MS]), 0))
    rig.run_ms(10)
    rig.engine.render(64, rig.clock.now_ns() + 100 * NS_PER_MS)
    assert only(rig.engine.advance(rig.clock.now_ns() + NS_PER_S), Status).late_cues == 1


def test_a_transport_outlives_the_card() -> None:
    rig = Rig()
    rig.engine.handle(Play(clicks([0, 30 * NS_PER_MS, 60 * NS_PER_MS]), 0))
    rig.run_ms(10)
    rig.engine.attach(None)
    rig.clock.advance_to(rig.clock.now_ns() + 40 * NS_PER_MS)
    assert not [event for event in rig.engine.advance(rig.clock.now_ns()) if isinstance(event, Started)]
    rig.engine.attach(impulse_mixer())
    sink = AudioSink(rig.engine, rig.clock)
    sink.run(50 * NS_PER_MS)
    assert len(sink.onsets_ns()) == 1


# --- status, devices, capture ----------------------------------------------------------------------------------------


def test_status_comes_once_a_second_with_the_cards_figures() -> None:
    engine = Engine()
    engine.output = OutputState(underflows=3, latency_ms=5.5, load=0.1)
    statuses = [(at_ms, event) for at_ms in range(0, 3_500, 10) for event in engine.advance(at_ms * NS_PER_MS)]
    assert [at_ms for at_ms, _ in statuses] == [1000, 2000, 3000]
    assert statuses[0][1] == Status(NS_PER_S, 3, 0, 5.5, 0.1)


def test_a_kit_that_comes_and_goes_is_told() -> None:
    engine = Engine()
    engine.device_found(KIT, 1)
    engine.feed(KIT, bytes.fromhex("99 26"), 2)
    engine.device_lost(KIT, 3)
    engine.device_found(KIT, 4)
    engine.feed(KIT, bytes.fromhex("7f"), 5)  # the other half of another stroke
    assert engine.advance(6) == [DeviceFound(1, KIT), DeviceLost(3, KIT), DeviceFound(4, KIT)]


def test_a_capture_replays_what_the_engine_told(tmp_path: Path) -> None:
    path = tmp_path / "take.cap"
    engine = Engine()
    engine.device_found(KIT, 0)
    engine.feed(KIT, bytes.fromhex("b9 04 40"), 0)  # the pedal's place is known before the capture begins
    engine.advance(NS_PER_S)
    engine.handle(RecordCapture(path))
    engine.handle(Play(clicks([0]), 0))
    told = engine.advance(NS_PER_S)
    engine.feed(KIT, bytes.fromhex("99 2e 50 2e"), 1_100_000_001)
    engine.feed(KIT, bytes.fromhex("60 a9 31 7f"), 1_100_000_777)
    engine.handle(KeyHit(1_200_000_000, Piece.HIHAT, Zone.BOW, 64, openness=0.25))
    engine.feed("another kit", SNARE, 1_250_000_000)
    engine.device_lost(KIT, 1_300_000_000)
    engine.device_found(KIT, 1_400_000_000)
    told += engine.advance(1_500_000_000)
    engine.handle(RecordCapture(None))
    capture = read_capture(path)
    assert capture.complete
    events = [event for event in told if not isinstance(event, Started | CaptureSaved)]
    assert list(replay(capture)) == [PedalMoved(NS_PER_S, 63 / 127, KIT), *events]
    assert transport_zeros_ns(capture) == [NS_PER_S]


def test_a_capture_that_begins_in_mid_session_knows_the_transport(tmp_path: Path) -> None:
    engine = Engine()
    engine.handle(Play(clicks([0]), 700))
    engine.advance(0)
    engine.handle(RecordCapture(tmp_path / "take.cap"))
    engine.close()
    assert transport_zeros_ns(read_capture(tmp_path / "take.cap")) == [700]


def test_a_capture_that_cannot_begin_is_told_and_playing_goes_on(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    engine = Engine()
    engine.handle(RecordCapture(tmp_path / "file" / "take.cap"))
    engine.feed(KIT, SNARE, 5)
    events = engine.advance(10)
    recorded = only(events, CaptureSaved)
    assert recorded.path == tmp_path / "file" / "take.cap"
    assert recorded.fault is not None
    assert "take.cap" in recorded.fault
    assert only(events, Hit).at_ns == 5


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_a_full_disk_is_told_once_and_playing_goes_on() -> None:
    engine = Engine()
    engine.handle(RecordCapture(Path("/dev/full")))
    engine.feed(KIT, SNARE, 5)
    engine.close()
    events = engine.advance(10)
    assert "No space left" in only(events, Notice).text
    assert only(events, Hit).at_ns == 5


def test_the_end_of_a_capture_comes_after_all_that_is_in_it(tmp_path: Path) -> None:
    engine = Engine()
    engine.handle(RecordCapture(tmp_path / "take.cap"))
    engine.feed(KIT, SNARE, 5)
    engine.handle(RecordCapture(None))
    events = engine.advance(10)
    assert [type(event) for event in events] == [CaptureSaved, Hit, CaptureSaved]
    assert events[-1] == CaptureSaved(None, None)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_a_capture_that_lacks_hits_says_so_at_its_end() -> None:
    engine = Engine()
    engine.handle(RecordCapture(Path("/dev/full")))
    engine.feed(KIT, SNARE, 5)
    engine.handle(RecordCapture(None))
    fault = engine.advance(10)[-1]
    assert isinstance(fault, CaptureSaved)
    assert fault.fault is not None
    assert "No space left" in fault.fault


def test_a_transport_that_has_played_out_is_none_of_the_next_captures(tmp_path: Path) -> None:
    engine = Engine()
    engine.advance(0)
    engine.handle(Play(clicks([0, 500]), 100))
    engine.advance(0)
    engine.advance(NS_PER_S)
    engine.handle(RecordCapture(tmp_path / "take.cap"))
    engine.close()
    assert transport_zeros_ns(read_capture(tmp_path / "take.cap")) == []


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_what_a_capture_lacks_is_told_when_the_next_one_begins(tmp_path: Path) -> None:
    engine = Engine()
    engine.handle(RecordCapture(Path("/dev/full")))
    engine.handle(RecordCapture(tmp_path / "take.cap"))
    assert "No space left" in only(engine.advance(0), Notice).text
    engine.close()


def test_quit_is_remembered() -> None:
    engine = Engine()
    engine.handle(Quit())
    assert engine.quitting


def test_every_byte_is_told_besides_while_somebody_looks() -> None:
    rig = Rig()
    rig.engine.device_found(KIT, rig.clock.now_ns())
    rig.engine.handle(WatchRawBytes(True))
    rig.engine.feed(KIT, b"\xfe", 7)
    rig.engine.feed(KIT, SNARE, 8)
    told = [event for event in rig.engine.advance(rig.clock.now_ns()) if isinstance(event, RawBytes | Hit)]
    assert told[:2] == [RawBytes(7, KIT, b"\xfe"), RawBytes(8, KIT, SNARE)]
    assert isinstance(told[2], Hit)
    rig.engine.handle(WatchRawBytes(False))
    rig.engine.feed(KIT, SNARE, 9)
    assert not [event for event in rig.engine.advance(rig.clock.now_ns()) if isinstance(event, RawBytes)]


def test_a_kit_that_was_changed_is_taken_at_once() -> None:
    plain = preset_named("roland-td-17")
    kits = [plain]
    engine = Engine(own_kit=lambda _: kits[-1])
    engine.device_found(KIT, 0)
    kits.append(replace(plain, pads={Piece.SNARE: Pad(threshold=100)}))
    engine.feed(KIT, bytes.fromhex("99 26 40"), 1)
    engine.handle(ReloadDevice(KIT))
    engine.feed(KIT, bytes.fromhex("99 26 40"), 1_000_000_000)
    hits = [event.at_ns for event in engine.advance(2_000_000_000) if isinstance(event, Hit)]
    assert hits == [1], "64 is softer than 100"


def test_added_cues_fall_on_their_frames_without_a_restart() -> None:
    rig = Rig()
    rig.engine.handle(Play(clicks([0]), 10 * NS_PER_MS))
    started = only(rig.run_ms(200), Started)
    rig.engine.handle(AddCues(stroke_cue(300 * NS_PER_MS, Piece.SNARE)))
    assert not [event for event in rig.run_ms(300) if isinstance(event, Started)]
    heard = np.array(rig.sink.onsets_ns())
    assert np.abs(heard - started.zero_ns - [0, 300 * NS_PER_MS]).max() <= FRAME_NS / 2 + 1

"""Sensors beside kits: what a bank makes of their bytes, and that a capture gives the same again."""

import random
from collections.abc import Iterable
from pathlib import Path

from station.core.events import (
    DeviceFound,
    DeviceLost,
    Hit,
    SensorEvent,
    SensorLost,
    SensorMounted,
    SensorSamples,
    SensorStatus,
)
from station.core.imu import ImuSample, Mounting
from station.core.pieces import Limb
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import CaptureRecord, RecordKind, read_capture
from station.devices.capture.capture_writer import CaptureFile
from station.devices.capture.replay import replay, replay_all
from station.devices.decoders import DecoderBank
from station.engine.capture_recorder import CaptureOpening, RunningCapture
from tests.fakes.imu_speech import PROTOCOLS, csv_line, ramp, ramp_index, rvc, x_imu3, x_imu3_binary

STICK = Mounting(Limb.LEFT_HAND, (0.5, -0.5, 0.5, 0.5), 0.31, 0.09, learnt=True)


def samples_of(events: Iterable[object]) -> list[ImuSample]:
    return [sample for event in events if isinstance(event, SensorSamples) for sample in event.samples]


def test_a_sensor_says_first_how_it_is_mounted() -> None:
    bank = DecoderBank()
    bank.add_sensor("stick", STICK)
    assert bank.mounting_of("stick") == STICK
    assert bank.found("stick", 5) == [SensorMounted(5, "stick", STICK)]
    assert not any(isinstance(event, SensorMounted) for event in bank.feed("stick", csv_line(ramp(1)[0]), 7).sensed)
    assert bank.lost("stick", 9) == [SensorLost(9, "stick")]


def test_a_sensor_that_was_not_found_says_so_with_its_first_bytes() -> None:
    bank = DecoderBank()
    bank.add_sensor("stick", STICK)
    first, *others = bank.feed("stick", csv_line(ramp(1)[0]), 7).sensed
    assert first == SensorMounted(7, "stick", STICK)
    assert not any(isinstance(event, SensorMounted) for event in others)
    assert bank.mounting_of("kit") is None


def test_no_sample_is_lost_before_the_protocol_is_known() -> None:
    for name, speak in PROTOCOLS.items():
        bank, count = DecoderBank(), 60
        bank.add_sensor("stick", Mounting())
        events = [
            event
            for index, measured in enumerate(ramp(count))
            for event in bank.feed("stick", speak(index, measured), round(measured.t_s * NS_PER_S)).sensed
        ]
        told = [ramp_index(sample.acceleration_m_s2[1]) for sample in samples_of(events)]
        assert told == list(range(count)), name


def test_status_comes_once_a_second_and_tells_what_was_lost() -> None:
    bank = DecoderBank()
    bank.add_sensor("stick", Mounting())
    statuses: list[SensorStatus] = []
    for index, measured in enumerate(ramp(1000)):
        if index % 100 == 50:
            continue
        said = x_imu3(measured) + (x_imu3_binary("B", 0, [75.0, 3.9, 0.0]) if index == 30 else b"")
        said += b"\xc9 damaged\n" if index == 40 else b""
        heard = bank.feed("stick", said, round(measured.t_s * NS_PER_S))
        statuses += [event for event in heard.sensed if isinstance(event, SensorStatus)]
    assert [status.at_ns // NS_PER_S for status in statuses] == [2, 3, 4, 5]
    last = statuses[-1]
    assert (last.protocol, last.battery, last.temperature_c) == ("x-imu3", 0.75, None)
    assert last.rate_hz is not None
    assert abs(last.rate_hz - 200.0) < 0.1
    assert 0 < last.lost <= 10
    assert last.bad_bytes == len(b"\xc9 damaged\n")


def test_nothing_readable_is_said() -> None:
    bank, noise = DecoderBank(), random.Random(3)
    bank.add_sensor("stick", Mounting())
    events: list[SensorEvent] = []
    for at_ms in range(0, 3000, 10):
        events += bank.feed("stick", noise.randbytes(40), at_ms * NS_PER_MS).sensed
    assert samples_of(events) == []
    assert [event.protocol for event in events if isinstance(event, SensorStatus)] == ["", ""]


def test_a_sensor_that_changes_its_protocol_is_understood_anew() -> None:
    bank = DecoderBank()
    bank.add_sensor("stick", Mounting())
    events: list[SensorEvent] = []
    for index, measured in enumerate(ramp(1500)):
        said = csv_line(measured) if index < 300 else rvc(index, measured.g)
        events += bank.feed("stick", said, round(measured.t_s * NS_PER_S)).sensed
    assert [e.protocol for e in events if isinstance(e, SensorStatus)][-1] == "bno085-rvc"


def test_a_capture_gives_the_same_to_the_nanosecond(tmp_path: Path) -> None:
    """Begun while the sensor already sends, with a kit beside it, a loss of the sensor and its return."""
    bank = DecoderBank()
    capture = RunningCapture(CaptureFile, bank)
    noise, live, stream = random.Random(5), list[object](), b""
    bank.add_sensor("stick", STICK)
    begun_ns = 1500 * NS_PER_MS
    for index, measured in enumerate(ramp(1200, 400.0)):
        at_ns = round((measured.t_s + noise.uniform(0, 0.005)) * NS_PER_S)
        stream += b"" if 700 <= index < 760 else x_imu3(measured)
        if noise.random() < 0.3 and index not in (260, 700, 760):
            continue
        if index == 260:
            capture.begin(tmp_path / "take.cap", begun_ns, CaptureOpening(["stick"], None, None))
            live.clear()
        if index in (700, 760):
            event = (DeviceLost if index == 700 else DeviceFound)(at_ns, "stick")
            capture.device_changed(event)
            live += (bank.lost if index == 700 else bank.found)("stick", at_ns)
        if 700 <= index < 760:
            continue
        cut = noise.randrange(len(stream))
        chunk, stream = stream[:cut], stream[cut:]
        capture.bytes_came("stick", chunk, at_ns, bank.overtaken_ns("stick", at_ns))
        live += bank.feed("stick", chunk, at_ns).sensed
        if index % 50 == 0:
            stroke = bytes((0x99, 38, 60 + index // 50))
            capture.bytes_came("TD-17", stroke, at_ns, None)
            live += bank.feed("TD-17", stroke, at_ns).certain
    capture.end(10 * NS_PER_S)
    told = [entry for entry in replay_all(read_capture(tmp_path / "take.cap")) if hasattr(entry, "device")]
    assert told == live
    assert sum(isinstance(event, SensorMounted) for event in told) == 2
    assert len(samples_of(told)) > 700
    hits = [event for event in live if isinstance(event, Hit)]
    assert [event for event in replay(read_capture(tmp_path / "take.cap")) if isinstance(event, Hit)] == hits


def test_bytes_of_a_sensor_that_nobody_announced_are_a_kit_s(tmp_path: Path) -> None:
    """As in captures from before sensors were known."""
    path = tmp_path / "old.cap"
    sink = CaptureFile(path, 0)
    sink.append(CaptureRecord(RecordKind.BYTES, 1, 5, bytes((0x99, 38, 60))))
    sink.close(9)
    assert [type(event) for event in replay(read_capture(path))] == [Hit]

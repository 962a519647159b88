"""Benchmarks of motion sensors: what a sample costs from its bytes on, and that none is lost on a busy line."""

import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import partial
from math import degrees
from pathlib import Path
from statistics import median

from station.bench.harness.benchmark import Benchmark, Measurement
from station.bench.rigs.devices.imu_line import SPEECH, x_imu3_measured
from station.core.events import SensorMounted, SensorSamples, StickStroke
from station.core.imu import STANDARD_GRAVITY_M_S2, Mounting
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.imu.imu_sensor import ImuSensor
from station.devices.serial.serial_names import serial_port
from station.devices.serial.serial_ports import SerialDirectory
from station.devices.transport import Transport
from station.simulation.sticks.stick_swing import HANDS, SimulatedSticks, StickPair, play
from station.simulation.sticks.swing_sensor import SensorSpec
from station.simulation.sticks.swing_spec import StickStrokeSpec
from station.sync.sticks import Sticks

_SAMPLES = 4_000
_TIMES = 5
_RATE_HZ = 1_000
_POLL_NS = NS_PER_MS // 2
"""The engine's pace: so often a port is read."""
_BAUD = 921_600
_LINE_S = {False: 10.0, True: 600.0}
"""How long the line sends: in the ordinary run, and in the soak."""
_POLL_S = 0.0004
_FAST = StickPair(dict.fromkeys(HANDS, SensorSpec(rate_hz=_RATE_HZ)))


def _fed(protocol: str) -> None:
    """Two seconds of a sensor that sends one packet in each chunk."""
    sensor, speak = ImuSensor("stick", Mounting()), SPEECH[protocol]
    for index in range(_SAMPLES):
        sensor.feed(speak(index, index * 5_000), index * 5 * NS_PER_MS)


def _spoken(protocol: str) -> None:
    """The same without a station: what the sensor's own side costs."""
    for index in range(_SAMPLES):
        SPEECH[protocol](index, index * 5_000)


def _cost(protocol: str) -> Measurement:
    taken_s = _cpu_s(partial(_fed, protocol)) - _cpu_s(partial(_spoken, protocol))
    return Measurement(taken_s / _SAMPLES * 1e6, note="decoded and timed, one packet a chunk")


def _cpu_s(work: Callable[[], None]) -> float:
    """The processor's time of `work`, the median of several."""
    taken_s = []
    for _ in range(_TIMES):
        begun = time.process_time()
        work()
        taken_s.append(time.process_time() - begun)
    return median(taken_s)


def _share() -> Measurement:
    """Two x-IMU3 at 1 kHz for ten seconds of their time, read every half millisecond."""
    packets = [SPEECH["x-imu3"](index, index * NS_PER_S // _RATE_HZ // 1_000) for index in range(10 * _RATE_HZ)]
    sensors = [ImuSensor(name, Mounting()) for name in ("right", "left")]
    begun = time.process_time()
    for index, packet in enumerate(packets):
        for sensor in sensors:
            sensor.feed(packet, index * NS_PER_S // _RATE_HZ + _POLL_NS)
    return Measurement(
        (time.process_time() - begun) / 10.0 * 100.0, note="decoding and sample clocks; no port, no strokes"
    )


def _whole_share() -> Measurement:
    """Two sticks that play, with an x-IMU3 at 1 kHz each: from their bytes to strokes and poses, as the engine does."""
    played = play([StickStrokeSpec(1.0 + 0.125 * index, HANDS[index % 2]) for index in range(72)], pair=_FAST)
    packets = sorted(_packets(played), key=lambda packet: packet[0])
    sensors = {stick.device: ImuSensor(stick.device, stick.mounting) for stick in played.sticks.values()}
    sticks, strokes = Sticks(), 0
    for stick in played.sticks.values():
        sticks.handle(SensorMounted(0, stick.device, stick.mounting))
    begun = time.process_time()
    for at_ns, device, data in packets:
        for event in sensors[device].feed(data, at_ns):
            strokes += sum(isinstance(told, StickStroke) for told in sticks.handle(event))
    taken_s = time.process_time() - begun
    lasts_s = (packets[-1][0] - packets[0][0]) / NS_PER_S
    return Measurement(
        taken_s / lasts_s * 100.0, note=f"decode, clock, orientation, strokes ({strokes} in {lasts_s:.0f} s); no port"
    )


def _packets(played: SimulatedSticks) -> Iterator[tuple[int, str, bytes]]:
    """When each packet of either stick came, whose it was, and its bytes."""
    for stick in played.sticks.values():
        for at_ns, sample in zip(stick.arrival_ns.tolist(), stick.samples, strict=True):
            p, q, r = map(degrees, sample.rate_rad_s or (0.0, 0.0, 0.0))
            x, y, z = (each / STANDARD_GRAVITY_M_S2 for each in sample.acceleration_m_s2)
            t_us = (sample.at_ns - int(stick.stamp_ns[0])) // 1_000
            yield at_ns, stick.device, x_imu3_measured(t_us, (p, q, r), (x, y, z))


def _lost(is_soak: bool) -> Measurement:
    """Samples that were sent down a pty and did not come, or came wrong."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "ttyIMU"
        words = [
            sys.executable,
            "-m",
            "station.bench.rigs.devices.imu_line",
            str(path),
            str(_BAUD),
            str(_LINE_S[is_soak]),
        ]
        with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as child:
            assert child.stdin is not None
            assert child.stdout is not None
            _await(path.exists)
            port = SerialDirectory(_BAUD, str(path), in_chunks=True).open(serial_port(str(path)))
            child.stdin.write("\n")
            child.stdin.flush()
            heard, wrong = _heard(port, _LINE_S[is_soak])
            sent = int(child.stdout.readline())
            child.stdin.close()
            port.close()
    return Measurement(
        sent - heard + wrong, note=f"{sent} sent in {_LINE_S[is_soak]:.0f} s at {_BAUD} baud; {wrong} came wrong"
    )


def _heard(port: Transport, seconds: float) -> tuple[int, int]:
    """How many samples came until the line fell silent, and how many were not the next."""
    sensor, heard, wrong = ImuSensor("stick", Mounting()), 0, 0
    over_s = time.monotonic() + seconds + 1.0
    while time.monotonic() < over_s:
        for packet in port.read():
            over_s = max(over_s, time.monotonic() + 1.0)
            for event in sensor.feed(packet.data, packet.at_ns):
                for sample in event.samples if isinstance(event, SensorSamples) else ():
                    told = round(sample.acceleration_m_s2[0] / STANDARD_GRAVITY_M_S2 * 1_000)
                    wrong += told != heard % 1_000
                    heard += 1
        time.sleep(_POLL_S)
    return heard, wrong


def _await(there: Callable[[], bool]) -> None:
    give_up_s = time.monotonic() + 20.0
    while not there() and time.monotonic() < give_up_s:
        time.sleep(0.01)


BENCHMARKS = (
    *(
        Benchmark(f"imu_sample_{name.replace('-', '_')}", "us", 25.0, "lower", None, partial(_cost, name))
        for name in SPEECH
    ),
    Benchmark("imu_two_at_1khz", "% of a core", 5.0, "lower", None, _share),
    Benchmark("imu_two_at_1khz_whole", "% of a core", 10.0, "lower", None, _whole_share),
    Benchmark("imu_line_lost_samples", "samples", 0.0, "lower", None, partial(_lost, False)),
    Benchmark("imu_line_lost_samples_10_min", "samples", 0.0, "lower", None, partial(_lost, True), True, 900.0),
)

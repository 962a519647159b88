"""Sensors' bytes cut, dropped, flipped and mixed with noise: the same samples, no crash, back within 3 good packets."""

import random
from collections.abc import Callable, Iterator
from itertools import pairwise

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from station.core.events import SensorSamples
from station.core.imu import ImuSample, Mounting
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.imu.detect_protocol import DetectingDecoder
from station.devices.imu.imu_protocols import PROTOCOLS
from station.devices.imu.imu_reading import Heard, ImuDecoder, Reading
from station.devices.imu.imu_sensor import ImuSensor
from tests.fakes import imu_speech
from tests.fakes.imu_speech import ramp, ramp_index

SPEECH = pytest.mark.parametrize("name", imu_speech.PROTOCOLS)


def packets(name: str, count: int) -> list[bytes]:
    return [imu_speech.PROTOCOLS[name](index, measured) for index, measured in enumerate(ramp(count))]


def decoder_of(name: str) -> ImuDecoder:
    return PROTOCOLS[name.split(maxsplit=1)[0]].decoder()


def values(decoder: Callable[[bytes, int], list[Heard]], chunks: Iterator[bytes]) -> list[Reading]:
    heard = [each for chunk in chunks for each in decoder(chunk, 0)]
    return [each for each in heard if isinstance(each, Reading)]


def cut(stream: bytes, sizes: list[int]) -> Iterator[bytes]:
    at = 0
    for size in sizes:
        yield stream[at : at + size]
        at += size
    yield stream[at:]


@SPEECH
@given(sizes=st.lists(st.integers(0, 40), max_size=60))
@example(sizes=[1] * 400)
def test_any_chunks_give_the_same_samples(name: str, sizes: list[int]) -> None:
    stream = b"".join(packets(name, 20))
    whole = decoder_of(name).feed(stream, 0)
    assert len(whole) >= 18
    assert values(decoder_of(name).feed, cut(stream, sizes)) == whole
    assert values(DetectingDecoder().feed, cut(stream, sizes)) == whole


@SPEECH
@given(
    sizes=st.lists(st.integers(0, 40), max_size=30),
    noise=st.lists(st.binary(max_size=30), min_size=1, max_size=8),
    at=st.integers(0, 10_000),
)
def test_after_any_noise_it_is_back_within_three_good_packets(
    name: str, sizes: list[int], noise: list[bytes], at: int
) -> None:
    """Noise may look like the beginning of a packet, and swallows the packets that then lie within it."""
    good = packets(name, 30)
    before, after = b"".join(good[:10]), good[10:]
    longest = max(map(len, good))
    cut_off = before[: len(before) - at % longest]  # the last packet may be half
    decoder = decoder_of(name)
    values(decoder.feed, cut(cut_off + b"".join(noise), sizes))
    told = [ramp_index(each.acceleration_m_s2[1]) for each in values(decoder.feed, iter(after))]
    assert list(range(13, 30)) == [index for index in told if 13 <= index < 30][-17:]


@SPEECH
def test_bytes_that_are_dropped_inserted_and_flipped_cost_only_their_packets(name: str) -> None:
    """One byte in 500 is damaged: what comes out is what was sent, but for a few in protocols without a checksum."""
    rng, good = random.Random(17), packets(name, 3000)
    damaged, hurt = bytearray(), 0
    for packet in good:
        before = len(damaged)
        for byte in packet:
            fate = rng.random() * 500
            if fate < 1 / 3:
                continue
            if fate < 2 / 3:
                damaged.append(rng.randrange(256))
            damaged.append(byte ^ (1 << rng.randrange(8)) if 2 / 3 <= fate < 1 else byte)
        hurt += bytes(damaged[before:]) != packet
    stream, chunks = bytes(damaged), []
    while stream:
        size = rng.randrange(1, 200)
        chunks.append(stream[:size])
        stream = stream[size:]
    found = values(DetectingDecoder().feed, iter(chunks))
    true = {each.acceleration_m_s2: index for index, each in enumerate(values(decoder_of(name).feed, iter(good)))}
    told = [each for each in found if each.acceleration_m_s2 in true]
    assert len(told) >= len(good) - 3 * hurt
    is_checked = name in ("csv checked", "bno085-rvc", "witmotion", "witmotion timed")
    assert len(found) - len(told) <= (2 if is_checked else hurt)


@given(st.lists(st.tuples(st.binary(max_size=300), st.integers(0, 50)), max_size=40))
def test_no_bytes_crash_a_sensor_nor_turn_its_clock_back(chunks: list[tuple[bytes, int]]) -> None:
    sensor, at_ns, samples = ImuSensor("stick", Mounting()), NS_PER_S, list[ImuSample]()
    for data, wait_ms in chunks:
        at_ns += wait_ms * NS_PER_MS
        for event in sensor.feed(data, at_ns):
            samples += event.samples if isinstance(event, SensorSamples) else ()
    times = [sample.at_ns for sample in samples]
    assert times == sorted(times)


PIECES = [
    b"U",
    b"UQ",
    b"Uaa",
    b"\xaa\xaa",
    b"\xc9",
    b"I,",
    b"$IMU,",
    b"1,2,3,4,5,6,7\n",
    b"\n",
    b"*00\n",
    b"\xdb",
    b"^A",
    b"{",
]


@pytest.mark.parametrize("name", list(PROTOCOLS))
def test_a_megabyte_of_likely_nonsense_is_neither_kept_nor_believed(name: str) -> None:
    """Made of the beginnings of packets and of noise; each decoder alone must swallow it."""
    rng, decoder = random.Random(23), PROTOCOLS[name].decoder()
    fed = 0
    for _ in range(4_000):
        chunk = b"".join(
            rng.choice(PIECES) if rng.random() < 0.3 else rng.randbytes(rng.randrange(60)) for _ in range(8)
        )
        decoder.feed(chunk, fed)
        fed += len(chunk)
    accounted = decoder.good_bytes + decoder.bad_bytes
    assert fed - 5_000 <= accounted <= fed  # what waits is no more than one line


def test_another_protocol_turns_no_time_back() -> None:
    """The sensor's settings are changed while it sends: samples go on from where they were."""
    sensor, samples = ImuSensor("stick", Mounting()), list[ImuSample]()
    stream = [*packets("csv", 100), *packets("x-imu3", 400), *packets("witmotion", 400), *packets("csv", 200)]
    for index, packet in enumerate(stream):
        clump_ns = (index + 399) // 400 * 2 * NS_PER_S  # we look every two seconds
        for event in sensor.feed(packet, clump_ns):
            samples += event.samples if isinstance(event, SensorSamples) else ()
    assert len(samples) > 600
    assert all(later.at_ns > earlier.at_ns for earlier, later in pairwise(samples))

"""Recovered times against the truth of simulated arrivals: jitter, clumps, drift, losses, resets.

The truth is when a sample was measured; it arrives later, never earlier, and in order. Errors are counted from the
least delay, which nobody can know.
"""

import random
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import pytest

from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.imu.imu_reading import Reading, Ticks
from station.devices.imu.sample_clock import SampleClock

Delay = Callable[[random.Random, float], float]


def uniform(rng: random.Random, _: float) -> float:
    """Up to 5 ms."""
    return rng.uniform(0, 0.005)


def exponential(rng: random.Random, _: float) -> float:
    """5 ms on average, now and then 30."""
    return rng.expovariate(200.0)


def half_normal(rng: random.Random, _: float) -> float:
    """SD 5 ms before its lower half is folded up."""
    return abs(rng.gauss(0, 0.005))


def clumps(_: random.Random, t_s: float) -> float:
    """As a radio whose turn comes every 25 times 1.25 ms (Bluetooth Core 5.4, vol. 6, part B, § 4.5.1)."""
    return -t_s % 0.03125


class Sent(NamedTuple):
    """When it was measured, and the reading with its arrival; both from the start of the session."""

    true_s: float
    reading: Reading


def sent(
    ticks: Callable[[int, float], int | None],
    delay: Delay,
    rate_hz: float = 200.0,
    seconds: float = 30.0,
    loss: float = 0.0,
    ppm: float = 0.0,
) -> list[Sent]:
    """What arrives; `ppm` is how much faster the device's clock runs than the session's."""
    rng, came_s, found = random.Random(11), 0.0, []
    for index in range(round(rate_hz * seconds)):
        device_s = index / rate_hz
        true_s = device_s / (1 + ppm * 1e-6)
        came_s = max(came_s, true_s + delay(rng, true_s))
        if rng.random() >= loss:
            at_ns = 5_000 * NS_PER_S + round(came_s * NS_PER_S)
            found.append(Sent(true_s, Reading(at_ns, (0, 0, 9.8), ticks=ticks(index, device_s))))
    return found


def errors_ms(clock: SampleClock, stream: list[Sent], from_s: float = 2.0) -> np.ndarray:
    """The error of each sample after `from_s`, in ms; what came at one time is given at once."""
    errors, batch = [], list[Sent]()
    for one, following in [*pairwise(stream), (stream[-1], None)]:
        batch.append(one)
        if following is not None and following.reading.at_ns == one.reading.at_ns:
            continue
        times = clock.stamps([each.reading for each in batch])
        for each, at_ns in zip(batch, times, strict=True):
            assert at_ns is not None
            assert at_ns <= each.reading.at_ns or each.true_s < 1.0  # then still being found out, and never going back
            if each.true_s >= from_s:
                errors.append((at_ns - 5_000 * NS_PER_S - each.true_s * NS_PER_S) / NS_PER_MS)
        batch = []
    return np.asarray(errors)


def by_micros(_: int, device_s: float) -> int:
    return 1_000 + round(device_s * 1e6)


def by_millis(_: int, device_s: float) -> int:
    return round(device_s * 1e3)


def by_index(index: int, _: float) -> int:
    return index % 256


def by_nothing(_: int, __: float) -> None:
    return None


@pytest.mark.parametrize("ppm", [-1000.0, -200.0, 0.0, 200.0, 1000.0])
@pytest.mark.parametrize("delay", [uniform, exponential, half_normal])
def test_five_milliseconds_of_jitter_are_removed_and_drift_is_followed(delay: Delay, ppm: float) -> None:
    stream, clock = sent(by_micros, delay, loss=0.02, ppm=ppm), SampleClock(Ticks.MICROSECONDS)
    errors = errors_ms(clock, stream)
    assert np.std(errors) < 0.1  # of 5 ms
    assert np.max(np.abs(errors)) < 0.5
    assert clock.rate_hz == pytest.approx(200.0 * (1 + ppm * 1e-6), rel=5e-5)
    assert clock.samples == len(stream)
    assert clock.lost == pytest.approx(6000 - len(stream), abs=3)  # those before the rate is known are not counted


@pytest.mark.parametrize(("ticks", "kind"), [(by_millis, Ticks.MILLISECONDS), (by_index, Ticks.INDEX_OF_256)])
@pytest.mark.parametrize("delay", [uniform, exponential])
def test_coarse_counters_do_as_well(ticks: Callable[[int, float], int], kind: Ticks, delay: Delay) -> None:
    stream, clock = sent(ticks, delay, loss=0.02, ppm=200.0), SampleClock(kind, (100, 200))
    errors = errors_ms(clock, stream)
    assert np.std(errors) < 0.3
    assert clock.lost == pytest.approx(6000 - len(stream), abs=3)


def test_the_first_two_seconds_are_within_the_jitter() -> None:
    errors = errors_ms(SampleClock(Ticks.MICROSECONDS), sent(by_micros, uniform, seconds=2.0), from_s=0.0)
    assert np.max(np.abs(errors)) < 5.0
    assert np.std(errors[100:]) < 0.5


@pytest.mark.parametrize(("ticks", "kind"), [(by_micros, Ticks.MICROSECONDS), (by_nothing, Ticks.NOTHING)])
def test_clumps_of_a_radio_are_spread(ticks: Callable[[int, float], int | None], kind: Ticks) -> None:
    """The radio's turns and the samples beat: every 1.25 ms that both clocks drift apart one comes without delay again.

    That saw-tooth of the least delay has an SD of 1.25 ms / √12 = 0.36 ms, and nobody can tell it from the samples.
    """
    errors = errors_ms(SampleClock(kind, (100, 200)), sent(ticks, clumps, ppm=50.0, rate_hz=200.0))
    assert np.std(errors) < 0.45  # of 31 ms


def test_samples_that_can_only_be_counted() -> None:
    stream, clock = sent(by_nothing, uniform, ppm=100.0), SampleClock(Ticks.NOTHING, (100, 200))
    assert np.std(errors_ms(clock, stream)) < 0.3
    assert clock.lost == 0


def test_losses_show_in_late_arrivals_where_nothing_is_counted() -> None:
    stream, clock = sent(by_nothing, uniform, loss=0.001), SampleClock(Ticks.NOTHING, (100, 200))
    errors = errors_ms(clock, stream)
    assert clock.lost == pytest.approx(6000 - len(stream), abs=1)
    assert np.median(np.abs(errors)) < 0.1
    assert np.std(errors) < 1.5  # a loss is known after some ten samples, and these are a whole one off


def test_a_clock_that_warms_up_is_followed() -> None:
    """From 0 to 100 ppm within a minute, far more than a crystal does."""
    stream = sent(lambda _, t: round((t + 100e-6 * t * t / 120) * 1e6), uniform, seconds=60.0)
    errors = errors_ms(SampleClock(Ticks.MICROSECONDS), stream)
    assert np.std(errors) < 0.5


@pytest.mark.parametrize("lasts_s", [0.3, 3.0])
def test_a_stall_of_our_own_moves_nothing(lasts_s: float) -> None:
    """What waited comes at once, and none of it is lost; its times are those of before."""

    def stall(rng: random.Random, t_s: float) -> float:
        return 10.0 + lasts_s - t_s if 10.0 < t_s < 10.0 + lasts_s else rng.uniform(0, 0.001)

    errors = errors_ms(SampleClock(Ticks.MICROSECONDS), sent(by_micros, stall))
    assert np.max(np.abs(errors)) < 0.2
    counted = errors_ms(SampleClock(Ticks.NOTHING, (100, 200)), sent(by_nothing, stall))
    assert np.max(np.abs(counted)) < 0.2


def test_the_count_of_microseconds_begins_again() -> None:
    stream = sent(lambda _, t: (2**32 - 10_000_000 + round(t * 1e6)) % 2**32, uniform, loss=0.02)
    clock = SampleClock(Ticks.MICROSECONDS)
    assert np.std(errors_ms(clock, stream)) < 0.1
    assert clock.samples == len(stream)


def test_a_sensor_that_restarts_costs_one_sample() -> None:
    stream = sent(lambda _, t: round((t if t < 10 else t - 9.5) * 1e6), uniform)
    clock = SampleClock(Ticks.MICROSECONDS)
    times = [clock.stamps([each.reading])[0] for each in stream]
    assert [index for index, at_ns in enumerate(times) if at_ns is None] == [2000]
    found = [at_ns for at_ns in times if at_ns is not None]
    assert all(later > earlier for earlier, later in pairwise(found))
    assert clock.lost == 1
    late = [(times[i] or 0) - 5_000 * NS_PER_S - stream[i].true_s * NS_PER_S for i in range(2400, 6000)]
    assert np.std(late) < 0.2 * NS_PER_MS


@pytest.mark.parametrize("damage", [2**40, -(2**20), 2**62])
def test_a_damaged_time_costs_one_sample(damage: int) -> None:
    stream = sent(by_micros, uniform, seconds=4.0)
    reading = stream[400].reading
    stream[400] = Sent(stream[400].true_s, reading._replace(ticks=abs((reading.ticks or 0) + damage)))
    clock = SampleClock(Ticks.MICROSECONDS)
    times = [clock.stamps([each.reading])[0] for each in stream]
    assert [index for index, at_ns in enumerate(times) if at_ns is None] == [400]
    assert clock.lost == 1


def test_a_sample_that_comes_too_late_is_counted_once() -> None:
    """Two that change places: the time of the first has passed, and it had been counted as missing."""
    stream, clock = sent(by_micros, uniform, seconds=4.0), SampleClock(Ticks.MICROSECONDS)
    first, second = stream[400].reading, stream[401].reading
    changed = [each.reading for each in stream]
    changed[400:402] = [second._replace(at_ns=first.at_ns), first._replace(at_ns=second.at_ns)]
    times = [clock.stamps([reading])[0] for reading in changed]
    assert [index for index, at_ns in enumerate(times) if at_ns is None] == [401]
    assert clock.lost == 1


def test_a_packet_that_comes_twice_counts_once() -> None:
    stream = sent(by_index, uniform, seconds=4.0)
    clock = SampleClock(Ticks.INDEX_OF_256)
    twice = [reading for each in stream for reading in (each.reading, each.reading)]
    times = [clock.stamps([reading])[0] for reading in twice]
    assert sum(at_ns is not None for at_ns in times) == len(stream)
    assert clock.lost == 0


def test_an_index_that_went_round_unseen_is_told_by_the_time() -> None:
    """Of 100 samples a second 1,000 are missing: the index went round three times and 232 further."""
    stream = sent(by_index, uniform, rate_hz=100.0)
    kept, clock = stream[:1000] + stream[2000:], SampleClock(Ticks.INDEX_OF_256)
    errors = errors_ms(clock, kept)
    assert clock.lost == 1000
    assert np.max(np.abs(errors)) < 5.0  # where the line had to be drawn on for ten seconds
    assert np.max(np.abs(errors[-900:])) < 0.3

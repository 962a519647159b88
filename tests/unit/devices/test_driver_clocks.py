"""A simulated driver with known true times is the expected value."""

import random
import statistics

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, NS_PER_S, NS_PER_US
from station.devices.driver_clocks import CREEP_NS_PER_S, DriverClock, WireClock

Times = NDArray[np.int64]


def errors_ns(true_ns: Times, delay_ns: Times, driver_rate: float = 1.0) -> Times:
    """Stamp − truth of messages at `true_ns` that are polled `delay_ns` later, by a driver's clock of `driver_rate`."""
    clock = DriverClock()
    deltas_s = np.diff(true_ns, prepend=true_ns[0]) * driver_rate / NS_PER_S
    stamps = [
        clock.stamps([(float(delta), int(at + delay))], int(at))[0]
        for delta, at, delay in zip(deltas_s, true_ns, delay_ns, strict=True)
    ]
    errors: Times = np.array(stamps) - true_ns
    return errors


def test_stamps_do_not_take_over_the_polls_jitter() -> None:
    rng = np.random.default_rng(1)
    true_ns = np.cumsum(rng.integers(20, 400, 2000) * NS_PER_MS)
    delay_ns = rng.integers(0, 500, 2000) * NS_PER_US
    delay_ns[rng.random(2000) < 0.02] += 60 * NS_PER_MS  # stalls
    settled = errors_ns(true_ns, delay_ns)[100:]
    assert settled.std() < 0.1 * NS_PER_MS
    assert settled.max() < 0.5 * NS_PER_MS  # one prompt poll, however long the stalls
    assert settled.min() >= 0


def test_a_slow_drivers_clock_is_followed() -> None:
    true_ns = np.arange(0, 600 * NS_PER_S, NS_PER_S // 4)
    delay_ns = np.full(len(true_ns), 200 * NS_PER_US)
    assert np.abs(errors_ns(true_ns, delay_ns, driver_rate=1 - 50e-6)).max() < 0.3 * NS_PER_MS


def test_a_fast_drivers_clock_is_followed() -> None:
    true_ns = np.arange(0, 600 * NS_PER_S, NS_PER_S // 4)
    delay_ns = np.full(len(true_ns), 200 * NS_PER_US)
    assert np.abs(errors_ns(true_ns, delay_ns, driver_rate=1 + 50e-6)).max() < 0.3 * NS_PER_MS


def test_the_hits_of_a_stall_keep_their_spacing() -> None:
    clock = DriverClock()
    clock.stamps([(0.0, NS_PER_S)], 0)
    polled_ns = 1 * NS_PER_S + 300 * NS_PER_MS
    late = clock.stamps([(0.1, polled_ns), (0.1, polled_ns)], NS_PER_S)
    creep_ns = CREEP_NS_PER_S // 5
    assert abs(late[0] - (1 * NS_PER_S + 100 * NS_PER_MS)) <= creep_ns
    assert abs(late[1] - (1 * NS_PER_S + 200 * NS_PER_MS)) <= creep_ns


def test_a_long_stall_of_ours_makes_no_hit_late() -> None:
    """The sound card took 2.5 s to open; strokes came 0, 0.5, … 2 s into it."""
    clock = DriverClock()
    clock.stamps([(0.0, NS_PER_S)], NS_PER_S)
    begun_ns, polled_ns = 2 * NS_PER_S, 4_500 * NS_PER_MS
    stamps = clock.stamps([(delta_s, polled_ns) for delta_s in (1.0, 0.5, 0.5, 0.5, 0.5)], begun_ns)
    true_ns = [begun_ns + stroke * 500 * NS_PER_MS for stroke in range(5)]
    creep_ns = 3 * CREEP_NS_PER_S
    assert all(0 <= stamp - at <= creep_ns for stamp, at in zip(stamps, true_ns, strict=True))


def test_a_stamp_is_never_later_than_the_poll() -> None:
    clock = DriverClock()
    clock.stamps([(0.0, 0)], 0)
    assert clock.stamps([(1.0, NS_PER_MS)], 0) == [NS_PER_MS]


def test_dropped_messages_do_not_leave_the_stamps_in_the_past() -> None:
    clock = DriverClock()
    clock.stamps([(0.0, 0)], 0)
    assert clock.stamps([(0.001, 10 * NS_PER_S)], 10 * NS_PER_S - NS_PER_MS) == [10 * NS_PER_S]


def test_time_never_goes_back() -> None:
    clock = DriverClock()
    first = clock.stamps([(0.0, NS_PER_S)], 0)
    assert clock.stamps([(-3.0, NS_PER_S - NS_PER_MS)], 0) == first


def test_what_came_while_the_engine_was_waking_is_not_stamped_when_it_woke() -> None:
    """A second of strokes, 144 ms apart, came before the first poll, the last one 3 ms before it."""
    clock, opened_ns = DriverClock(), 7 * NS_PER_S
    true_ns = [opened_ns + 144 * NS_PER_MS * stroke for stroke in range(8)]
    polled_ns = true_ns[-1] + 3 * NS_PER_MS
    stamps = clock.stamps([(0.144 if stroke else 0.0, polled_ns) for stroke in range(8)], opened_ns)
    assert [stamp - at for stamp, at in zip(stamps, true_ns, strict=True)] == [3 * NS_PER_MS] * 8


def test_a_message_that_the_driver_dropped_leaves_the_stamps_early_for_a_moment_only() -> None:
    clock, errors = DriverClock(), []
    for stroke in range(60):
        at_ns = NS_PER_S + 100 * NS_PER_MS * stroke
        delta_s = 0.1 if stroke != 20 else 0.0  # the difference of one that was dropped went with it
        (stamp,) = clock.stamps([(delta_s, at_ns + NS_PER_US)], at_ns - 400 * NS_PER_US)
        errors.append((stamp - at_ns) / NS_PER_MS)
    assert max(errors) < 0.1
    assert min(errors[:20]) >= 0
    assert min(errors[40:]) > -0.1


@given(
    gaps_ms=st.lists(st.integers(0, 400), min_size=1, max_size=60),
    polls_ms=st.lists(st.sampled_from([1, 1, 1, 2, 150, 900]), min_size=1, max_size=60),
)
def test_no_stamp_is_later_than_the_best_known_message_waited(gaps_ms: list[int], polls_ms: list[int]) -> None:
    """Whatever stalls: a stamp errs by what the message waited that waited least so far, and by the creep."""
    true_ns = (NS_PER_S + np.cumsum(gaps_ms) * NS_PER_MS).tolist()
    clock, now_ns, sent, least_ns = DriverClock(), 0, 0, None
    emptied_ns, last_true_ns, step = 0, true_ns[0], 0
    while sent < len(true_ns):
        now_ns += polls_ms[step % len(polls_ms)] * NS_PER_MS
        step += 1
        came = [at_ns for at_ns in true_ns[sent:] if at_ns <= now_ns]
        found = []
        for at_ns in came:
            found.append(((at_ns - last_true_ns) / NS_PER_S, now_ns))
            last_true_ns = at_ns
        if came:
            least_ns = min(now_ns - came[-1], now_ns if least_ns is None else least_ns)
            creep_ns = (came[-1] - true_ns[0]) * CREEP_NS_PER_S // NS_PER_S + 1_000
            for stamp, at_ns in zip(clock.stamps(found, emptied_ns), came, strict=True):
                assert -1_000 <= stamp - at_ns <= least_ns + creep_ns
        sent += len(came)
        emptied_ns = now_ns


# --- a serial line: times by hand, from a byte's 0.32 ms at MIDI's rate ----------------------------------------------

US = 1_000


def wire_stamps(*polls: tuple[int, int, int]) -> list[list[int]]:
    """The stamps in µs of polls (count, begun, read) in µs on a line that was opened at 0."""
    clock = WireClock(31_250, 0)
    return [[at // US for at in clock.stamp(count, begun * US, read * US)] for count, begun, read in polls]


@pytest.mark.parametrize(
    ("polls", "expected"),
    [
        pytest.param([(3, 5_000, 5_010)], [[4_370, 4_690, 5_010]], id="read at once"),
        pytest.param([(1, 400, 410), (1, 800, 800), (1, 1_200, 1_200)], [[410], [730], [1_050]], id="right after each"),
        pytest.param([(1, 400, 410), (2, 5_000, 5_000)], [[410], [730, 1_050]], id="we were held up in mid-message"),
        pytest.param([(1, 400, 400), (0, 1_000, 1_000), (2, 1_400, 1_400)], [[400], [], [1_080, 1_400]], id="a pause"),
        pytest.param([(1, 800, 800), (2, 1_100, 1_100)], [[800], [800, 1_100]], id="sooner than the first was found"),
        pytest.param([(0, 400, 400)], [[]], id="nothing"),
    ],
)
def test_bytes_of_a_wire_are_stamped_by_polls_and_by_the_wire(
    polls: list[tuple[int, int, int]], expected: list[list[int]]
) -> None:
    assert wire_stamps(*polls) == expected


def test_the_bytes_of_a_message_tell_more_than_the_poll_that_ends_it() -> None:
    """Messages at random times, polled every 0.45 ms: closer than a poll alone, whose error is uniform (SD 0.13 ms)."""
    chance, clock = random.Random(1), WireClock(31_250, 0)
    begun_ns = [k * 20_000_000 + chance.randrange(450_000) for k in range(1, 400)]
    came_ns = [at + byte * 320_000 for at in begun_ns for byte in range(3)]
    stamps: list[int] = []
    for poll in range(450_000, came_ns[-1] + 1_000_000, 450_000):
        found = sum(at <= poll for at in came_ns[len(stamps) : len(stamps) + 8])
        stamps += clock.stamp(found, poll, poll)
    late_ns = [stamp - at for stamp, at in zip(stamps[2::3], came_ns[2::3], strict=True)]
    assert min(late_ns) >= 0
    assert statistics.pstdev(late_ns) < 0.6 * 450_000 / 12**0.5

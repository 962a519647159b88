import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.units import NS_PER_MS, NS_PER_S
from station.practice.control.tap_tempo import MAX_TAPS, PAUSE_NS, TapTempo, tapped_bpm


def taps_at(bpm: float, numbers: list[float]) -> list[int]:
    return [round(number * 60.0 / bpm * NS_PER_S) for number in numbers]


def after(taps_ns: list[int]) -> float | None:
    tempo = TapTempo()
    for tap_ns in taps_ns:
        tempo.tap(tap_ns)
    return tempo.bpm


def test_one_tap_says_nothing() -> None:
    assert after([]) is None
    assert after([5 * NS_PER_S]) is None


@given(bpm=st.floats(25.0, 400.0), count=st.integers(2, 12), start_ns=st.integers(0, 10**12))
def test_even_taps_give_their_tempo(bpm: float, count: int, start_ns: int) -> None:
    taps_ns = [start_ns + tap_ns for tap_ns in taps_at(bpm, list(range(count)))]
    assert after(taps_ns) == pytest.approx(bpm, rel=1e-4)


@pytest.mark.parametrize(
    "numbers",
    [
        [0, 1, 2, 4, 5, 6],  # one left out
        [0, 1, 2, 2.4, 3, 4, 5],  # a stray one between
        [0, 1, 1.7, 2, 3, 4],
        [0.35, 1, 2, 3, 4, 5],  # the first was a slip
        [0, 1, 2, 3, 4, 4.5],  # the last was
        [0, 1, 3, 4, 4.3, 5, 6, 8, 9],
    ],
)
def test_slips_do_not_count(numbers: list[float]) -> None:
    assert after(taps_at(120.0, numbers)) == pytest.approx(120.0, rel=1e-3)


def test_a_humans_scatter_averages_out() -> None:
    rng = np.random.default_rng(3)
    errors = []
    for _ in range(200):
        noise = rng.normal(0.0, 15.0 * NS_PER_MS, 8)
        taps_ns = [round(tap + off) for tap, off in zip(taps_at(100.0, list(range(8))), noise, strict=True)]
        bpm = tapped_bpm(taps_ns)
        assert bpm is not None
        errors.append(bpm - 100.0)
    # the slope of eight points, 15 ms each: 15/√42 = 2.3 ms a beat of 600, so 0.39 bpm
    assert np.std(errors) == pytest.approx(0.39, rel=0.25)
    assert abs(np.mean(errors)) < 0.1


def test_a_pause_starts_anew() -> None:
    first = taps_at(60.0, [0, 1, 2, 3])
    second = [first[-1] + PAUSE_NS + 1 + tap_ns for tap_ns in taps_at(180.0, [0, 1, 2, 3])]
    assert after(first + second) == pytest.approx(180.0, rel=1e-4)


def test_old_taps_no_longer_count() -> None:
    slow = taps_at(100.0, list(range(10)))
    fast = [slow[-1] + tap_ns for tap_ns in taps_at(120.0, list(range(1, MAX_TAPS + 1)))]
    assert after(slow + fast) == pytest.approx(120.0, rel=1e-3)


def test_a_tap_that_bounces_is_one() -> None:
    taps_ns = [tap for beat in taps_at(120.0, [0, 1, 2, 3]) for tap in (beat, beat + 15 * NS_PER_MS)]
    assert after(taps_ns) == pytest.approx(120.0, rel=1e-3)

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.sound.output.dac_clock import CLIP_NS, JUMP_BLOCKS, JUMP_NS, DacClock

START_NS = 5_000_000_000_000_000  # a computer that has been up for two months


@dataclass(frozen=True)
class Card:
    """A sound card whose crystal is off by `drift_ppm`, and a driver that reports with noise; all simulated."""

    rate_hz: int = 48_000
    frames: int = 64
    drift_ppm: float = 0.0
    sd_ns: float = 0.0
    late_share: float = 0.0
    late_ns: float = 0.0

    @property
    def frame_ns(self) -> float:
        return NS_PER_S / (self.rate_hz * (1.0 + 1e-6 * self.drift_ppm))

    def errors_ns(self, seconds: float, clock: DacClock, seed: int = 0) -> tuple[NDArray[np.float64], list[int]]:
        """What the clock says minus when each block is truly heard, and what it says."""
        rng = np.random.default_rng(seed)
        blocks = round(seconds * self.rate_hz / self.frames)
        true_ns = np.arange(blocks) * self.frames * self.frame_ns
        noise_ns = rng.normal(0.0, self.sd_ns, blocks) if self.sd_ns else np.zeros(blocks)
        noise_ns += (rng.random(blocks) < self.late_share) * rng.uniform(0.0, self.late_ns, blocks)
        said = [
            clock.block(self.frames, START_NS + round(true + noise))
            for true, noise in zip(true_ns.tolist(), noise_ns.tolist(), strict=True)
        ]
        return np.array([ns - START_NS for ns in said]) - true_ns, said


def test_exact_reports_are_passed_on() -> None:
    error_ns, _ = Card().errors_ns(2.0, DacClock(48_000))
    assert np.abs(error_ns).max() <= 2.0  # the reports themselves are rounded to whole ns


@pytest.mark.parametrize(("frames", "bound_ns"), [(16, 0.1e6), (64, 0.1e6), (256, 0.1e6), (1024, 0.2e6)])
@pytest.mark.parametrize("drift_ppm", [-200.0, 0.0, 200.0])
def test_jitter_and_drift_settle_within_the_stated_bounds(frames: int, bound_ns: float, drift_ppm: float) -> None:
    card = Card(frames=frames, drift_ppm=drift_ppm, sd_ns=0.5e6, late_share=0.01, late_ns=20e6)
    clock = DacClock(48_000)
    error_ns, _ = card.errors_ns(30.0, clock)
    settled = error_ns[round(10.0 * 48_000 / frames) :]
    assert np.abs(settled).max() <= bound_ns
    assert clock.frame_ns == pytest.approx(card.frame_ns, rel=60e-6)


def test_without_jitter_the_drift_is_found_exactly() -> None:
    card = Card(drift_ppm=150.0)
    clock = DacClock(48_000)
    error_ns, _ = card.errors_ns(60.0, clock)
    assert np.abs(error_ns[-1000:]).max() <= 200.0
    assert clock.frame_ns == pytest.approx(card.frame_ns, rel=1e-6)


def test_jitter_is_averaged_away_already_in_the_first_seconds() -> None:
    error_ns, _ = Card(sd_ns=0.5e6).errors_ns(3.0, DacClock(48_000))
    assert np.abs(error_ns[750:]).max() <= 0.35e6  # after one second; the reports themselves stray 1.5 ms


def test_blocks_follow_one_another_evenly() -> None:
    card = Card(sd_ns=0.3e6)
    _, said = card.errors_ns(20.0, DacClock(48_000))
    steps_ns = np.diff(said[7_500:])
    assert np.abs(steps_ns - card.frames * card.frame_ns).max() <= 3_000  # a seventh of a frame at most


def test_blocks_may_change_their_length() -> None:
    clock = DacClock(48_000)
    at_ns = START_NS
    for frames in [64, 256, 17, 1024, 64] * 50:
        assert abs(clock.block(frames, at_ns) - at_ns) <= 1_000
        at_ns += round(frames * NS_PER_S / 48_000)


def test_one_late_report_moves_it_hardly() -> None:
    clock = DacClock(48_000)
    card = Card()
    _, said = card.errors_ns(5.0, clock)
    expected = said[-1] + 64 * card.frame_ns
    assert clock.block(64, round(expected + 40e6)) == pytest.approx(expected, abs=10)
    after = clock.block(64, round(expected + 64 * card.frame_ns))
    assert abs(after - expected - 64 * card.frame_ns) <= 0.02 * CLIP_NS


@pytest.mark.parametrize("jump_ns", [-30_000_000, 10_000_000, 4 * NS_PER_S])
def test_a_jump_of_the_stream_is_followed_at_once(jump_ns: int) -> None:
    assert abs(jump_ns) > JUMP_NS
    clock = DacClock(48_000)
    card = Card()
    _, said = card.errors_ns(5.0, clock)
    first = said[-1] + 64 * card.frame_ns + jump_ns
    errors = [
        clock.block(64, round(first + k * 64 * card.frame_ns)) - first - k * 64 * card.frame_ns for k in range(20)
    ]
    assert max(map(abs, errors[JUMP_BLOCKS:])) <= 2_000


def test_resync_starts_from_the_next_report() -> None:
    clock = DacClock(48_000)
    Card().errors_ns(1.0, clock)
    clock.resync()
    assert clock.block(64, START_NS + 77 * NS_PER_S) == START_NS + 77 * NS_PER_S


@pytest.mark.parametrize("off_ns", [144_000_000, -144_000_000])
@pytest.mark.parametrize("frames", [32, 64, 256, 1024])
def test_one_wrong_report_after_an_underflow_is_over_with_the_blocks_of_a_jump(frames: int, off_ns: int) -> None:
    clock, step_ns = DacClock(48_000), frames * NS_PER_S / 48_000
    true_ns = [START_NS + round(block * step_ns) for block in range(100)]
    for at_ns in true_ns[:50]:
        clock.block(frames, at_ns)
    clock.resync()
    said = [clock.block(frames, true_ns[50] + off_ns)] + [clock.block(frames, at_ns) for at_ns in true_ns[51:]]
    errors_ns = np.abs(np.array(said) - np.array(true_ns[50:]))
    assert errors_ns[JUMP_BLOCKS:].max() < JUMP_NS

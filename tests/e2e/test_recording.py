"""The measuring instrument itself: frames get their true times, onsets are strokes; expected values by construction."""

import numpy as np
import pytest

from tests.fakes.jack_recorder import Recording, timed

RATE_HZ, BLOCK = 48_000, 48  # a block is a millisecond
MS = 1_000_000


def recording_of(sound_ms: list[float]) -> Recording:
    """A sound that holds each of `sound_ms` for a millisecond, alternating in sign at a quarter of the rate."""
    level = np.repeat(np.array(sound_ms, np.float32), BLOCK)
    tone = level * np.tile(np.array([1, 1, -1, -1], np.float32), len(level) // 4)
    at_ns = (np.arange(len(level)) * 1e9 / RATE_HZ).astype(np.int64)
    return Recording(np.column_stack([tone, tone]), at_ns, RATE_HZ, 0)


def test_callbacks_that_come_late_do_not_move_the_frames() -> None:
    rng = np.random.default_rng(1)
    first_frame = np.arange(0, 3_000 * BLOCK, BLOCK)
    begin_ns = 5_000 * MS + np.arange(3_000) * MS
    called_ns = begin_ns + rng.integers(0, 900_000, 3_000)
    heard = timed(np.zeros((3_000 * BLOCK, 2), np.float32), first_frame, called_ns, RATE_HZ)
    assert np.abs(heard.at_ns[::BLOCK] - begin_ns).max() < 0.05 * MS


@pytest.mark.parametrize("skipped_frames", [0, 30 * BLOCK])
def test_a_server_that_stalls_moves_what_follows_and_nothing_before(skipped_frames: int) -> None:
    first_frame = np.arange(0, 1_000 * BLOCK, BLOCK)
    first_frame[500:] += skipped_frames
    begin_ns = np.arange(1_000) * MS
    begin_ns[500:] += 30 * MS
    heard = timed(np.zeros((1_000 * BLOCK, 2), np.float32), first_frame, begin_ns, RATE_HZ)
    assert np.abs(heard.at_ns[::BLOCK] - begin_ns).max() < 0.001 * MS
    assert heard.lost_frames == skipped_frames


def test_strokes_are_onsets_also_over_a_ringing_drum() -> None:
    ring = [0.5 * 0.97**step for step in range(100)]
    sound = [0.0] * 50 + ring + [8 * ring[-1] * 0.97**step for step in range(100)]
    assert recording_of(sound).onsets() == [50 * BLOCK, 150 * BLOCK]


def test_a_missed_block_is_no_onset() -> None:
    ring = [0.5 * 0.99**step for step in range(200)]
    ring[60:64] = [0.0] * 4
    assert recording_of([0.0] * 50 + ring).onsets() == [50 * BLOCK]


def test_a_stroke_after_silence_is_an_onset() -> None:
    faded = [0.5 * 0.9**step for step in range(80)]
    assert recording_of([0.0] * 50 + faded + [0.0] * 20 + faded).onsets() == [50 * BLOCK, 150 * BLOCK]


def test_the_centroid_of_a_tone_is_its_pitch() -> None:
    time_s = np.arange(4_800) / RATE_HZ
    tone = np.sin(2 * np.pi * 3_000 * time_s).astype(np.float32)
    heard = Recording(np.column_stack([tone, tone]), np.zeros(4_800, np.int64), RATE_HZ, 0)
    assert heard.centroid_hz(0) == pytest.approx(3_000, abs=30)

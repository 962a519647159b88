"""The sound file by FFmpeg's own decoder: as long as what went in, and strokes where they were."""

import io

import av
import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.render.files import opus_file as module
from station.render.files.opus_file import RATE_HZ, opus_file

ONSETS_S = (0.02, 0.4, 0.4335, 1.25, 2.9)


def decoded(data: bytes) -> NDArray[np.float32]:
    """The frames (n, 2) as a player hears them: without what comes before the stream's time 0."""
    blocks = []
    with av.open(io.BytesIO(data)) as container:
        for frame in container.decode(audio=0):
            assert frame.sample_rate == RATE_HZ
            skipped = max(0, -round(float(frame.pts * frame.time_base) * RATE_HZ))
            blocks.append(frame.to_ndarray()[:, skipped:].T)
    return np.concatenate(blocks)


def strokes(length_s: float) -> NDArray[np.float32]:
    """Noise that begins at once and fades in 15 ms, at each of the onsets."""
    rng = np.random.default_rng(3)
    sound = np.zeros((round(length_s * RATE_HZ), 2), np.float32)
    for at_s in ONSETS_S:
        start = round(at_s * RATE_HZ)
        burst = 0.5 * np.exp(-np.arange(1200) / 500)[:, None] * rng.normal(size=(1200, 2)).clip(-2, 2)
        sound[start : start + 1200] += burst[: len(sound) - start]
    return sound


def test_it_lasts_as_long_and_strokes_are_where_they_were() -> None:
    sound = strokes(3.21)
    data = opus_file(np.array_split(sound, [700, 50_000, 50_001]))
    heard = decoded(data)
    assert len(heard) == pytest.approx(len(sound), abs=1)
    loud = np.abs(heard).max(axis=1)
    for at_s in ONSETS_S:
        start = round(at_s * RATE_HZ)
        before, after = loud[max(start - 240, 0) : start - 96], loud[start : start + 96]
        assert after.max() > 0.3, "within 2 ms it is there"
        if at_s != ONSETS_S[2]:  # the stroke before that still sounds
            assert before.max() < 0.1, "and 2 ms before it was not"
    away = np.correlate(heard[:24_000, 0], sound[:24_000, 0], "full").argmax() - 23_999
    assert abs(away) <= 12, "a quarter of a millisecond"


def test_it_is_ogg_with_opus_of_about_the_rate_that_was_asked_for() -> None:
    rng = np.random.default_rng(1)
    data = opus_file([(0.1 * rng.normal(size=(10 * RATE_HZ, 2))).astype(np.float32)])
    assert data[:4] == b"OggS"
    assert b"OpusHead" in data[:100]
    assert len(data) == pytest.approx(10 * 64_000 / 8, rel=0.35)


def test_a_library_without_the_encoder_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_ENCODER", "no such encoder")
    with pytest.raises(DeviceError, match="cannot encode Opus"):
        opus_file([np.zeros((10, 2), np.float32)])

"""The other synthesised kits, measured as recordings would be."""

from functools import lru_cache

import numpy as np
import pytest

from station.core.sound_names import SoundName
from station.sound.drum_kit import Frames
from station.sound.samples.recordings import loudness_of
from station.sound.synth.synth_kits import MODELS, synth_sound
from tests.unit.sound.kits import RATE_HZ

OTHERS = ["brushes", "electronic"]


@lru_cache
def hardest(model: str, name: SoundName) -> Frames:
    return synth_sound(name, RATE_HZ, model).layers[-1].takes[0]


def rises_within_s(sound: Frames) -> float:
    """When the envelope, over half a millisecond, first reaches 90 % of its peak."""
    window = round(0.0005 * RATE_HZ)
    envelope = np.sqrt(np.convolve(np.sum(sound.astype(np.float64) ** 2, axis=1), np.ones(window), "valid"))
    return float(np.argmax(envelope >= 0.9 * envelope.max())) / RATE_HZ


def falls_within_s(sound: Frames, by_db: float) -> float:
    """How long until less than `by_db` of the energy is left."""
    left = np.cumsum(np.sum(sound.astype(np.float64) ** 2, axis=1)[::-1])[::-1]
    return float(np.argmax(left < left[0] * 10 ** (-by_db / 10))) / RATE_HZ


def pitch_hz(sound: Frames, from_s: float, to_s: float) -> float:
    """By upward crossings of zero."""
    part = sound[round(from_s * RATE_HZ) : round(to_s * RATE_HZ), 0]
    crossings = np.flatnonzero((part[:-1] < 0.0) & (part[1:] >= 0.0))
    return RATE_HZ * (len(crossings) - 1) / float(crossings[-1] - crossings[0])


@pytest.mark.parametrize("model", OTHERS)
def test_every_kit_has_what_the_acoustic_has(model: str) -> None:
    assert set(MODELS[model]) >= set(MODELS["acoustic"])


@pytest.mark.parametrize("model", OTHERS)
@pytest.mark.parametrize(
    "name", [SoundName.KICK, SoundName.SNARE, SoundName.HIHAT_CLOSED, SoundName.RIDE_BOW, SoundName.TOM_1]
)
def test_a_sound_is_in_range_ends_in_silence_and_has_no_dc(model: str, name: SoundName) -> None:
    sound = hardest(model, name)
    assert 0.01 < np.abs(sound).max() < 1.0
    assert np.all(sound[-1] == 0.0)
    assert abs(float(sound.mean())) < 1e-4


@pytest.mark.parametrize("name", [SoundName.SNARE, SoundName.RIDE_BOW, SoundName.HIHAT_CLOSED, SoundName.CRASH_1])
def test_a_brush_is_slower_and_softer_than_a_stick(name: SoundName) -> None:
    brush, stick = hardest("brushes", name), hardest("acoustic", name)
    assert rises_within_s(brush) > rises_within_s(stick)
    assert loudness_of(brush, RATE_HZ) < 0.75 * loudness_of(stick, RATE_HZ)  # by 2.5 dB at least


def test_the_brushes_buzz_is_a_sweep() -> None:
    sweep = hardest("brushes", SoundName.SNARE_BUZZ)
    assert 0.03 < rises_within_s(sweep) < 0.2
    assert falls_within_s(sweep, 20.0) > 0.15


def test_the_electronic_kick_falls_in_pitch_and_rings() -> None:
    kick = hardest("electronic", SoundName.KICK)
    assert pitch_hz(kick, 0.0, 0.04) > 1.4 * pitch_hz(kick, 0.15, 0.4)
    assert pitch_hz(kick, 0.15, 0.4) == pytest.approx(47.0, rel=0.05)
    assert falls_within_s(kick, 30.0) > 1.4 * falls_within_s(hardest("acoustic", SoundName.KICK), 30.0)


def test_the_electronic_hihat_is_tight_and_opens() -> None:
    closed, opened = (hardest("electronic", name) for name in (SoundName.HIHAT_CLOSED, SoundName.HIHAT_OPEN))
    assert falls_within_s(closed, 40.0) < 0.1
    assert falls_within_s(opened, 40.0) > 4 * falls_within_s(closed, 40.0)

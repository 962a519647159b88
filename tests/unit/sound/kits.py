"""Kits whose sound is known by hand: constants, ramps and impulses instead of drums."""

import numpy as np

from station.core.sound_names import SoundName
from station.sound.buses import ClickVoice
from station.sound.drum_kit import DrumKit, Frames, Layer, Sound
from station.sound.mixer import Mixer

RATE_HZ = 48_000
ESSENTIAL = (SoundName.KICK, SoundName.SNARE, SoundName.HIHAT_CLOSED)


def constant(value: float, frames: int = 48_000) -> Frames:
    return np.full((frames, 2), value, np.float32)


def impulse(value: float = 0.5, frames: int = 100) -> Frames:
    sound = np.zeros((frames, 2), np.float32)
    sound[0] = value
    return sound


def sound_of(*takes: Frames) -> Sound:
    return Sound((Layer(127, takes),))


def kit_of(sounds: dict[SoundName, Frames] | None = None, default: Frames | None = None) -> DrumKit:
    """A kit of these sounds; the essential ones that are not given, and every other with `default`, sound alike."""
    given = sounds or {}
    names = set(ESSENTIAL) | set(given) | (set(SoundName) if default is not None else set())
    plain = constant(0.0, 10) if default is None else default
    return DrumKit("test", RATE_HZ, {name: sound_of(given.get(name, plain)) for name in names})


def mixer_of(sounds: dict[SoundName, Frames] | None = None, default: Frames | None = None, voices: int = 32) -> Mixer:
    clicks = {voice: impulse(0.1 * (voice + 1)) for voice in ClickVoice}
    return Mixer(kit_of(sounds, default), clicks, voices)

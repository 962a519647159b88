"""A kit of clicks one frame long, so that a test can read off the sound which stroke fell on which frame."""

import numpy as np

from station.core.sound_names import SoundName
from station.sound.buses import ClickVoice
from station.sound.drum_kit import DrumKit, Frames, Layer, Sound
from station.sound.mixer import Mixer

LEVEL = 0.25
"""Below the limiter's knee, so that sums stay sums."""


def impulse(level: float = LEVEL) -> Frames:
    return np.full((1, 2), level, np.float32)


def impulse_mixer(rate_hz: int = 48_000, ring_frames: int = 1) -> Mixer:
    """A mixer whose every sound is `ring_frames` long at one level."""
    frames = np.full((ring_frames, 2), LEVEL, np.float32)
    sounds = {name: Sound((Layer(127, (frames,)),)) for name in SoundName}
    return Mixer(DrumKit("impulses", rate_hz, sounds), {voice: impulse() for voice in ClickVoice})

"""The click: three short pitched blips above the drums' bodies, told apart by pitch and level.

A drum kit's loudest bodies lie below 500 Hz and its cymbals spread their noise; a pure tone of 1–2.5 kHz with one
partial stands out of both. A blip reaches its full level within `ATTACK_S`, so that its start is as sharp as a stick's.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from station.sound.buses import ClickVoice
from station.sound.drum_kit import Frames

ATTACK_S = 0.0008
_LENGTH_S = 0.09
_PARTIAL = 2.76
"""The second partial of a free wooden bar (Fletcher & Rossing, The Physics of Musical Instruments, § 2.16)."""
_PARTIAL_LEVEL = 0.35
_RELEASE_S = 0.01


@dataclass(frozen=True, slots=True)
class Blip:
    """A click voice: its pitch, its peak (1 is full scale) and the time in which it decays to 1/e."""

    pitch_hz: float
    peak: float
    decay_s: float


BLIPS: Mapping[ClickVoice, Blip] = MappingProxyType(
    {
        ClickVoice.ACCENT: Blip(pitch_hz=2349.3, peak=0.6, decay_s=0.016),  # D7
        ClickVoice.BEAT: Blip(pitch_hz=1568.0, peak=0.5, decay_s=0.014),  # G6, a fifth below
        ClickVoice.SUBDIVISION: Blip(pitch_hz=1046.5, peak=0.28, decay_s=0.010),  # C6, a fifth below that
    }
)


def click_sounds(rate_hz: int) -> dict[ClickVoice, Frames]:
    """The three clicks at `rate_hz`: float32 (n, 2), centred, the beat on frame 0."""
    return {voice: _frames(blip, rate_hz) for voice, blip in BLIPS.items()}


def _frames(blip: Blip, rate_hz: int) -> Frames:
    time_s = np.arange(round(_LENGTH_S * rate_hz)) / rate_hz
    phase = 2 * np.pi * blip.pitch_hz * time_s
    tone = np.sin(phase) * np.exp(-time_s / blip.decay_s)
    knock = _PARTIAL_LEVEL * np.sin(_PARTIAL * phase) * np.exp(-3 * time_s / blip.decay_s)
    attack = np.sin(0.5 * np.pi * np.minimum(1.0, time_s / ATTACK_S)) ** 2
    release = np.minimum(1.0, (time_s[-1] - time_s) / _RELEASE_S)
    mono = (tone + knock) * attack * release
    mono *= blip.peak / np.abs(mono).max()
    return np.column_stack([mono, mono]).astype(np.float32)

"""The click: short pitched blips above the drums' bodies, told apart by pitch and level; and the counted words.

A drum kit's loudest bodies lie below 500 Hz and its cymbals spread their noise; a tone of 1–2.5 kHz with one partial
stands out of both. A blip reaches its full level within `ATTACK_S`, so that its start is as sharp as a stick's.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from station.core.errors import BadInput
from station.sound.buses import ClickVoice
from station.sound.drum_kit import Frames
from station.sound.spoken_count import word_sounds

ATTACK_S = 0.0008
_LENGTH_S = 0.09
BAR_PARTIAL = 2.76
"""The second partial of a free wooden bar (Fletcher & Rossing, The Physics of Musical Instruments, § 2.16)."""
BELL_PARTIAL = 1.48
"""Between the two plates' modes of a small cowbell (540 and 800 Hz in the usual synthesis)."""
_RELEASE_S = 0.01


@dataclass(frozen=True, slots=True)
class Blip:
    """A click voice: its pitch, its peak (1 is full scale), the time in which it decays to 1/e, and a partial."""

    pitch_hz: float
    peak: float
    decay_s: float
    partial: float = BAR_PARTIAL
    partial_level: float = 0.35


DEFAULT_TIMBRE = "bar"
TIMBRES: Mapping[str, Mapping[ClickVoice, Blip]] = MappingProxyType(
    {
        DEFAULT_TIMBRE: MappingProxyType(
            {
                ClickVoice.ACCENT: Blip(pitch_hz=2349.3, peak=0.6, decay_s=0.016),  # D7
                ClickVoice.BEAT: Blip(pitch_hz=1568.0, peak=0.5, decay_s=0.014),  # G6, a fifth below
                ClickVoice.SUBDIVISION: Blip(pitch_hz=1046.5, peak=0.28, decay_s=0.010),  # C6, a fifth below that
            }
        ),
        "wood": MappingProxyType(
            {
                ClickVoice.ACCENT: Blip(1318.5, 0.6, 0.007, partial_level=0.6),  # E6
                ClickVoice.BEAT: Blip(987.8, 0.5, 0.007, partial_level=0.5),  # B5
                ClickVoice.SUBDIVISION: Blip(784.0, 0.3, 0.006, partial_level=0.4),  # G5
            }
        ),
        "beep": MappingProxyType(
            {
                ClickVoice.ACCENT: Blip(1760.0, 0.5, 0.030, partial_level=0.0),  # A6
                ClickVoice.BEAT: Blip(880.0, 0.5, 0.030, partial_level=0.0),  # A5
                ClickVoice.SUBDIVISION: Blip(880.0, 0.22, 0.018, partial_level=0.0),
            }
        ),
        "bell": MappingProxyType(
            {
                ClickVoice.ACCENT: Blip(1080.0, 0.6, 0.025, BELL_PARTIAL, 0.9),
                ClickVoice.BEAT: Blip(810.0, 0.5, 0.022, BELL_PARTIAL, 0.9),
                ClickVoice.SUBDIVISION: Blip(810.0, 0.25, 0.012, BELL_PARTIAL, 0.9),
            }
        ),
    }
)
"""The clicks to choose from, each with its three weights."""


def click_sounds(rate_hz: int, timbre: str = DEFAULT_TIMBRE) -> dict[ClickVoice, Frames]:
    """Every click and word at `rate_hz`: float32 (n, 2), centred; a click's beat is on frame 0.

    Raises `BadInput` for a timbre that there is not.
    """
    return {voice: _frames(blip, rate_hz) for voice, blip in blips_of(timbre).items()} | word_sounds(rate_hz)


def blips_of(timbre: str) -> Mapping[ClickVoice, Blip]:
    """What the click of that name is made of; raises `BadInput` for a name that is none."""
    if timbre not in TIMBRES:
        raise BadInput(timbre, "", f"no such click; there are {', '.join(TIMBRES)}")
    return TIMBRES[timbre]


def _frames(blip: Blip, rate_hz: int) -> Frames:
    time_s = np.arange(round(_LENGTH_S * rate_hz)) / rate_hz
    phase = 2 * np.pi * blip.pitch_hz * time_s
    tone = np.sin(phase) * np.exp(-time_s / blip.decay_s)
    knock = blip.partial_level * np.sin(blip.partial * phase) * np.exp(-3 * time_s / blip.decay_s)
    attack = np.sin(0.5 * np.pi * np.minimum(1.0, time_s / ATTACK_S)) ** 2
    release = np.minimum(1.0, (time_s[-1] - time_s) / _RELEASE_S)
    mono = (tone + knock) * attack * release
    mono *= blip.peak / np.abs(mono).max()
    return np.column_stack([mono, mono]).astype(np.float32)

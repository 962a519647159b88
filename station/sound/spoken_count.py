"""Counting aloud: "one e and a two", synthesised from formants, for those who count better than they listen to clicks.

Each word is a row of phones. Voiced ones are the harmonics of a falling voice weighed by four resonances that glide
from phone to phone (a cascade as in Klatt 1980, J. Acoust. Soc. Am. 67; vowels after Peterson & Barney 1952); hissed
ones are bands of noise. The vowel begins `SPOKEN_LEAD_S` after frame 0: there the ear hears the beat of a word, and the
cue is given that much earlier. Speech is made at 16 kHz, beyond which it has nothing to say, and brought to the card's
rate.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.sound.buses import SPOKEN_LEAD_S, ClickVoice
from station.sound.drum_kit import Frames
from station.sound.samples.audio_file import resampled

SPEECH_HZ = 16_000
PEAK = 0.6
"""As the click's accent, which it stands for."""
_VOICE_HZ = (132.0, 104.0)
"""The voice falls from one to the other within a word, as it does on a word alone."""
_HARMONICS_BELOW_HZ = 5000.0
_BANDWIDTHS_HZ = (70.0, 100.0, 140.0, 250.0)
_FOURTH_HZ = 3500.0
_GLIDE_S = 0.018
"""Formants move from one phone to the next within about twice this."""
_EDGE_S = 0.008
_CONTROL = 32
"""Samples between two settings of the resonances."""


@dataclass(frozen=True, slots=True)
class Voiced:
    """A phone that is sung: its first three formants in Hz and its level."""

    formants_hz: tuple[float, float, float]
    level: float = 1.0


@dataclass(frozen=True, slots=True)
class Hiss:
    """A phone that is breathed: its band in Hz and its level."""

    low_hz: float
    high_hz: float
    level: float


Phone = Voiced | Hiss | None
"""None is the silence before a stop opens."""

_I = Voiced((270.0, 2290.0, 3010.0))
_IH = Voiced((390.0, 1990.0, 2550.0))
_EH = Voiced((530.0, 1840.0, 2480.0))
_AE = Voiced((660.0, 1720.0, 2410.0))
_AH = Voiced((730.0, 1090.0, 2440.0))
_AW = Voiced((570.0, 840.0, 2410.0))
_U = Voiced((300.0, 870.0, 2240.0))
_UH = Voiced((640.0, 1190.0, 2390.0))
_W = Voiced((290.0, 610.0, 2150.0), 0.5)
_R = Voiced((330.0, 1060.0, 1500.0), 0.6)
_L = Voiced((330.0, 1050.0, 2880.0), 0.5)
_N = Voiced((260.0, 1400.0, 2300.0), 0.35)
_V = Voiced((240.0, 1100.0, 2080.0), 0.25)
_S = Hiss(4200.0, 7600.0, 0.22)
_TH = Hiss(3500.0, 7600.0, 0.06)
_F = Hiss(1500.0, 7600.0, 0.07)
_T = Hiss(2500.0, 7000.0, 0.30)
_K = Hiss(1400.0, 3200.0, 0.25)


@dataclass(frozen=True, slots=True)
class Word:
    """A word: phones and their lengths in seconds, those before the vowel and those from it on."""

    before: tuple[tuple[Phone, float], ...]
    after: tuple[tuple[Phone, float], ...]


WORDS: Mapping[ClickVoice, Word] = MappingProxyType(
    {
        ClickVoice.ONE: Word(((_W, 0.050),), ((_UH, 0.130), (_N, 0.080))),
        ClickVoice.TWO: Word(((_T, 0.045),), ((_U, 0.190),)),
        ClickVoice.THREE: Word(((_TH, 0.040), (_R, 0.030)), ((_I, 0.190),)),
        ClickVoice.FOUR: Word(((_F, 0.060),), ((_AW, 0.130), (_R, 0.080))),
        ClickVoice.FIVE: Word(((_F, 0.060),), ((_AH, 0.100), (_IH, 0.070), (_V, 0.040))),
        ClickVoice.SIX: Word(((_S, 0.070),), ((_IH, 0.080), (None, 0.030), (_K, 0.020), (_S, 0.080))),
        ClickVoice.SEVEN: Word(((_S, 0.070),), ((_EH, 0.080), (_V, 0.035), (_UH, 0.040), (_N, 0.070))),
        ClickVoice.EIGHT: Word((), ((_EH, 0.080), (_I, 0.060), (None, 0.030), (_T, 0.035))),
        ClickVoice.NINE: Word(((_N, 0.060),), ((_AH, 0.100), (_IH, 0.060), (_N, 0.070))),
        ClickVoice.TEN: Word(((_T, 0.045),), ((_EH, 0.110), (_N, 0.080))),
        ClickVoice.ELEVEN: Word(((_L, 0.050),), ((_EH, 0.080), (_V, 0.035), (_UH, 0.040), (_N, 0.070))),
        ClickVoice.TWELVE: Word(((_T, 0.030), (_W, 0.040)), ((_EH, 0.090), (_L, 0.060), (_V, 0.040))),
        ClickVoice.E: Word((), ((_I, 0.120),)),
        ClickVoice.AND: Word((), ((_AE, 0.080), (_N, 0.060))),
        ClickVoice.A: Word((), ((_UH, 0.110),)),
    }
)
"""How each is said; "eleven" without its first syllable, so that its beat comes at once."""

Mono = NDArray[np.float32]


def word_sounds(rate_hz: int) -> dict[ClickVoice, Frames]:
    """Every counted word at `rate_hz`: float32 (n, 2), centred, its vowel `SPOKEN_LEAD_S` after frame 0."""
    return {voice: resampled(_spoken(voice), SPEECH_HZ, rate_hz) for voice in WORDS}


@lru_cache(maxsize=len(WORDS))
def _spoken(voice: ClickVoice) -> Frames:
    word = WORDS[voice]
    begin_s = SPOKEN_LEAD_S - sum(length_s for _, length_s in word.before)
    phones: list[tuple[Phone, float]] = [(None, begin_s), *word.before, *word.after, (None, 2.0 * _GLIDE_S)]
    edges_s = np.cumsum([0.0, *(length_s for _, length_s in phones)])
    mono = _sung(phones, edges_s)
    rng = np.random.default_rng(voice)
    for (phone, _), start_s, end_s in zip(phones, edges_s[:-1], edges_s[1:], strict=True):
        if isinstance(phone, Hiss):
            _add_hiss(mono, phone, float(start_s), float(end_s), rng)
    mono *= np.float32(PEAK / np.abs(mono).max())
    return np.column_stack([mono, mono])


def _sung(phones: list[tuple[Phone, float]], edges_s: NDArray[np.float64]) -> Mono:
    """The voiced phones of a word, over its whole length."""
    time_s = np.arange(round(float(edges_s[-1]) * SPEECH_HZ)) / SPEECH_HZ
    knots_s, tracks = _tracks(phones, edges_s)
    control_s = time_s[::_CONTROL]
    formants = np.column_stack([np.interp(control_s, knots_s, track) for track in tracks[:3]])
    level = np.interp(time_s, knots_s, tracks[3])
    voice_hz = np.interp(time_s, [0.0, time_s[-1]], _VOICE_HZ)
    phase = 2.0 * np.pi * np.cumsum(voice_hz) / SPEECH_HZ
    numbers = np.arange(1, int(_HARMONICS_BELOW_HZ / _VOICE_HZ[0]) + 1)
    gains = _resonance(numbers[:, None] * voice_hz[::_CONTROL], formants) / numbers[:, None]
    sound = np.zeros(len(time_s))
    for number, gain in zip(numbers, gains, strict=True):
        sound += np.interp(time_s, control_s, gain) * np.sin(number * phase)
    whole: Mono = (level * sound).astype(np.float32)
    return whole / np.float32(np.abs(whole).max())


def _tracks(
    phones: list[tuple[Phone, float]], edges_s: NDArray[np.float64]
) -> tuple[list[float], tuple[list[float], list[float], list[float], list[float]]]:
    """Knots of the three formants and of the level; where nothing is sung the formants wait at the next phone's."""
    knots_s: list[float] = []
    tracks: tuple[list[float], list[float], list[float], list[float]] = ([], [], [], [])
    sung = [phone for phone, _ in phones if isinstance(phone, Voiced)]
    for (phone, length_s), start_s in zip(phones, edges_s[:-1], strict=True):
        ahead = phone if isinstance(phone, Voiced) else sung[0]
        glide_s = min(_GLIDE_S if isinstance(phone, Voiced) else _EDGE_S, length_s / 3.0)
        knots_s += [float(start_s) + glide_s, float(start_s) + length_s - glide_s]
        for track, value in zip(tracks, (*ahead.formants_hz, ahead.level if ahead is phone else 0.0), strict=True):
            track += [value, value]
        if ahead is phone and len(sung) > 1:
            sung = sung[1:]
    return knots_s, tracks


def _resonance(freq_hz: NDArray[np.float64], formants_hz: NDArray[np.float64]) -> NDArray[np.float64]:
    """The gain of the four resonances in a row at `freq_hz` (harmonics, times)."""
    fourth = np.full(len(formants_hz), _FOURTH_HZ)
    gain = np.ones_like(freq_hz)
    for centre_hz, width_hz in zip((*formants_hz.T, fourth), _BANDWIDTHS_HZ, strict=True):
        gain *= centre_hz**2 / np.hypot(centre_hz**2 - freq_hz**2, width_hz * freq_hz)
    return gain


def _add_hiss(mono: Mono, hiss: Hiss, start_s: float, end_s: float, rng: np.random.Generator) -> None:
    """Add a band of noise with soft edges, in place."""
    start, end = round(start_s * SPEECH_HZ), round(end_s * SPEECH_HZ)
    spectrum = np.fft.rfft(rng.standard_normal(end - start))
    freq_hz = np.fft.rfftfreq(end - start, 1.0 / SPEECH_HZ)
    spectrum[(freq_hz < hiss.low_hz) | (freq_hz > hiss.high_hz)] = 0.0
    noise = np.fft.irfft(spectrum, end - start)
    edge = min((end - start) // 3, round(_EDGE_S * SPEECH_HZ))
    noise[:edge] *= np.linspace(0.0, 1.0, edge)
    noise[-edge:] *= np.linspace(1.0, 0.0, edge)
    mono[start:end] += (hiss.level * noise / np.sqrt(np.mean(noise**2) + 1e-12)).astype(np.float32)

"""The beat of a song with one tempo, by its onsets: how fast, and where a beat lies. For a track to play along to.

The onset strength's autocorrelation, weighted by how usual a tempo is (Ellis 2007, Beat Tracking by Dynamic
Programming, § 3.2), says about how fast; the attacks themselves, as points of a circle one beat long, then say exactly,
by the tempo at which they lie closest together, and where on the circle they lie. Which beat is the first of a bar
nobody says: that is for the ear. A band that drifts has no such tempo; `drills.songs` follows those.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.music.sound_onsets import OnsetBand, SoundOnsets

LEAST_BPM, MOST_BPM = 55.0, 215.0
"""Slower or faster, a drummer counts it at double or half (our choice)."""
_USUAL_BPM, _OCTAVES = 120.0, 0.9
"""The tempo that people tap most, and how far others are from it (Ellis 2007)."""
_NEAR, _STEPS = 0.03, 1201
"""The exact tempo lies so near to the first guess, and is looked for in so many steps: 0.005 % (our choice)."""
_BEATS = 4
"""Multiples of a beat that are looked at: a bar."""
_HARMONICS = (1, 2, 4)
"""Attacks lie on beats, on their halves, on their quarters."""
_LEAST_ATTACKS = 8
_MOST_STRENGTH = 3.0
"""A single crash counts no more than three usual attacks (our choice)."""
_WEIGHT_OF_BAND = {OnsetBand.LOW: 2.0, OnsetBand.MID: 1.5, OnsetBand.HIGH: 0.5}
"""Kick and snare say where the beat is, hats only how it is parted (our choice)."""
_REACH_S = 0.03
"""An attack within so much of a beat is on it (our choice: a band's scatter)."""
_FIRST_SHARE = 0.5
"""The first beat is half as strong as the song's strong ones: noise before a song is none (our choice)."""
_STRONG_QUANTILE = 0.75


@dataclass(frozen=True, slots=True)
class BeatEstimate:
    """Beats a minute, and when the first beat is, in seconds of the sound."""

    bpm: float
    first_beat_s: float


def estimated_beat(onsets: SoundOnsets) -> BeatEstimate | None:
    """The beat of a sound; None where it has too few attacks."""
    weight = np.minimum(onsets.weight, _MOST_STRENGTH) * np.array([_WEIGHT_OF_BAND[OnsetBand(b)] for b in onsets.band])
    if len(onsets.at_s) < _LEAST_ATTACKS or not weight.sum():
        return None
    bpm = _exact(onsets.at_s, weight, _about(onsets))
    return BeatEstimate(round(bpm, 2), round(_first_beat_s(onsets, weight, 60.0 / bpm), 3))


def _about(onsets: SoundOnsets) -> float:
    """The tempo to about a percent."""
    weights = np.array([_WEIGHT_OF_BAND[band] for band in OnsetBand])
    strength = np.asarray(weights @ np.minimum(onsets.strength, _MOST_STRENGTH), np.float64)
    strength -= strength.mean()
    size = 1 << (2 * len(strength) - 1).bit_length()
    power = np.abs(np.fft.rfft(strength, size)) ** 2
    again = np.fft.irfft(power)[: len(strength)]
    tempi = np.geomspace(LEAST_BPM, MOST_BPM, 800)
    lags = 60.0 / tempi / onsets.hop_s
    likeness = np.zeros(len(tempi))
    for beat in range(1, _BEATS + 1):
        likeness += np.interp(beat * lags, np.arange(len(again)), again, right=0.0)
    usual = np.exp(-0.5 * (np.log2(tempi / _USUAL_BPM) / _OCTAVES) ** 2)
    return float(tempi[np.argmax(np.maximum(likeness, 0.0) * usual)])


def _exact(at_s: NDArray[np.float64], weight: NDArray[np.float64], about_bpm: float) -> float:
    """The tempo near `about_bpm` at which the attacks lie closest together on the beat and its parts."""
    tempi = about_bpm * np.linspace(1.0 - _NEAR, 1.0 + _NEAR, _STEPS)
    closeness = np.zeros(len(tempi))
    for part in _HARMONICS:
        turns = np.outer(tempi * part / 60.0, at_s)
        closeness += np.abs(np.exp(2j * np.pi * turns) @ weight)
    return float(tempi[np.argmax(closeness)])


def _first_beat_s(onsets: SoundOnsets, weight: NDArray[np.float64], beat_s: float) -> float:
    """When the first beat is: of the places on the circle that with the most attacks near it."""
    places = onsets.at_s % beat_s
    tried = np.arange(0.0, beat_s, 0.001)
    apart = np.abs((places[None, :] - tried[:, None] + beat_s / 2) % beat_s - beat_s / 2)
    near = np.where(apart < _REACH_S, 1.0 - (apart / _REACH_S) ** 2, 0.0) @ weight
    place = float(tried[np.argmax(near)])
    beats = place + beat_s * np.arange(round(onsets.length_s / beat_s) + 1)
    strength = (np.abs(beats[:, None] - onsets.at_s[None, :]) < _REACH_S) @ weight
    is_strong = strength >= _FIRST_SHARE * np.quantile(strength, _STRONG_QUANTILE)
    return float(beats[np.argmax(is_strong)])

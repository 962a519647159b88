"""When single attacks begin, to about a millisecond, in each band.

A peak of the onset strength says that there is an attack, to some 10 ms. Its beginning is then found in the band's
envelope by the split that makes two stretches of noise most likely, before and after (the picker of Maeda 1985, from
seismology): it lies on the first arrival, not on the loudest moment.
"""

import numpy as np
from numpy.typing import NDArray

from station.music.sound_onsets import OnsetBand
from station.sound.songs.onset_strength import BANDS_HZ, HOP, RATE_HZ

Floats = NDArray[np.float32]

STEP = 24
STEP_S = STEP / RATE_HZ
"""1 ms."""

_BEFORE, _AFTER = 35, 20
"""Steps that are looked at around a peak; music before it, the attack itself after it (our choice)."""

_LEAST = 0.25
"""Of a usual attack: weaker peaks are none (our choice: half as many hats as strokes are that weak)."""

_APART = 8
"""Hops between two attacks of a band, 40 ms: a 32nd at 180 bpm."""

_NOISE = 0.03
"""Of the loudest power in a window: 15 dB below it the filters ring before an attack (by trial on the virtual band)."""

_EARLY_S = {OnsetBand.LOW: 0.002, OnsetBand.MID: 0.0015, OnsetBand.HIGH: 0.0008}
"""How much too early the splits lie, for a filter spreads an attack to both sides: between what the virtual band's
strokes alone show (4, 2 and 1 ms) and its whole mix (1 ms)."""

_PIECE = 1 << 19
_OVERLAP = 1 << 13
"""Samples that are filtered at once, and how far neighbours reach into each other: 0.34 s, beyond any ringing."""


def attacks(mono: Floats, strength: Floats) -> tuple[NDArray[np.float64], NDArray[np.int8], Floats]:
    """Times in s, rising, bands and weights (m,) of the attacks in `mono` (n,) with its `strength` (3, k)."""
    found = [_of_band(envelope, strength[band]) for band, envelope in zip(BANDS_HZ, band_envelopes(mono), strict=True)]
    at_s = np.concatenate([times + _EARLY_S[band] for band, (times, _) in zip(BANDS_HZ, found, strict=True)])
    bands = np.concatenate(
        [np.full(len(times), band, np.int8) for band, (times, _) in zip(BANDS_HZ, found, strict=True)]
    )
    weights = np.concatenate([weight for _, weight in found])
    order = np.argsort(at_s, kind="stable")
    return at_s[order], bands[order], weights[order]


def band_envelopes(mono: Floats) -> Floats:
    """Mean power of each band in steps of `STEP_S`: (3, about n / `STEP`)."""
    pieces = []
    for first in range(0, len(mono), _PIECE):
        start = max(0, first - _OVERLAP)
        part = mono[start : first + _PIECE + _OVERLAP]
        powers = _powers(part)[:, first - start : first - start + min(_PIECE, len(mono) - first)]
        whole = powers.shape[1] // STEP * STEP
        pieces.append(powers[:, :whole].reshape(len(powers), -1, STEP).mean(axis=2))
    return np.concatenate(pieces, axis=1)


def _powers(part: Floats) -> Floats:
    """Squared analytic signal of each band: (3, len(part))."""
    size = 1 << (len(part) - 1).bit_length()
    spectrum = np.fft.rfft(part, size)
    freqs = np.asarray(np.fft.rfftfreq(size, 1 / RATE_HZ), np.float64)
    rows = []
    for low, high in BANDS_HZ.values():
        whole = np.zeros(size, np.complex64)
        whole[: len(freqs)] = 2 * spectrum * _pass(freqs, low, high)
        band = np.fft.ifft(whole)[: len(part)]
        rows.append((band.real**2 + band.imag**2).astype(np.float32))
    return np.stack(rows)


def _pass(freqs: NDArray[np.float64], low: float, high: float) -> NDArray[np.float64]:
    """A band-pass whose edges are raised cosines an octave wide: it hardly rings."""
    octaves = np.log2(np.maximum(freqs, 1.0))
    rising = np.clip(octaves - np.log2(low) + 0.5, 0.0, 1.0)
    falling = np.clip(np.log2(high) - octaves + 0.5, 0.0, 1.0)
    return np.asarray(np.sin(0.5 * np.pi * rising) ** 2 * np.sin(0.5 * np.pi * falling) ** 2)


def _of_band(envelope: Floats, strength: Floats) -> tuple[NDArray[np.float64], Floats]:
    """When the band's attacks begin, in s (m,), and how strong each is."""
    if not len(envelope):
        return np.zeros(0), np.zeros(0, np.float32)
    peaks = _peaks(strength)
    centres = peaks * (HOP // STEP)
    padded = np.pad(envelope, (_BEFORE, _AFTER + HOP), "edge")
    windows = padded[centres[:, None] + np.arange(_BEFORE + _AFTER)]
    return (centres - _BEFORE + _splits(windows)) * STEP_S, strength[peaks]


def _peaks(strength: Floats) -> NDArray[np.int64]:
    """Hops at which `strength` (n,) is the greatest within `_APART` / 2 to both sides, and worth it."""
    half = _APART // 2
    padded = np.pad(strength, half)
    greatest = np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1).max(axis=1)
    return np.flatnonzero((strength == greatest) & (strength > _LEAST))


def _splits(windows: Floats) -> NDArray[np.float64]:
    """Where each window (m, w) of powers splits best into two: steps from its start (m,)."""
    w = windows.shape[1]
    k = np.arange(1, w)
    loud = windows.astype(np.float64)
    total = np.cumsum(loud + _NOISE * loud.max(axis=1, keepdims=True) + 1e-12, axis=1)
    before, after = total[:, :-1] / k, np.maximum(total[:, -1:] - total[:, :-1], 1e-12) / (w - k)
    likely = k * np.log(before) + (w - k) * np.log(after)
    likely[after < before] = np.inf
    return np.asarray(1.0 + np.argmin(likely, axis=1))

"""How strongly a sound starts, moment by moment, in three bands: spectral flux of logarithmic magnitudes.

Flux is the sum of what rises from one spectrum to the next (Masri 1996; compressed magnitudes as in Böck et al. 2012).
Each band is then measured by its own usual attack around that time, so that a quiet verse speaks as loud as a chorus.
"""

import numpy as np
from numpy.typing import NDArray

from station.music.sound_onsets import OnsetBand

Floats = NDArray[np.float32]

RATE_HZ = 24_000
"""Of the sound that is listened to: hats and snare wires have enough below 12 kHz, and a hop is whole samples."""

HOP = 120
HOP_S = HOP / RATE_HZ
"""5 ms: finer than the beat is known by a peak; single attacks are then placed to 1 ms (`attack_times`)."""

BANDS_HZ = {OnsetBand.LOW: (30.0, 150.0), OnsetBand.MID: (150.0, 4000.0), OnsetBand.HIGH: (5000.0, 11500.0)}
"""Kick drums ring at 45–90 Hz, basses begin at 41; snares ring at 150–250 with wires beyond 4 kHz; hats above 5 kHz."""

_WINDOW = 512
"""21 ms: a bin is 47 Hz, three of them are the low band; a longer one would smear fast hats (our choice)."""

_RISE = 2
"""Hops over which a rise is measured: half the window."""

_FLOOR_DB = -50.0
"""Below full scale by so much, in a song at `_RMS`, is silence: rises down there are noise and the window's own leakage
(our choice)."""

_RMS = 0.1
"""Every song is brought to this level before it is listened to (−20 dB, a usual one)."""

_AROUND_S = 6.0
"""The usual attack is that of so many seconds to both sides: two or three bars (our choice)."""

_USUAL_QUANTILE = 0.95
"""One hop in twenty lies on a peak where an eighth lasts 0.25 s and a peak 10–15 ms."""

_LEAST_USUAL = 0.15
"""Of the whole song's usual attack: in silence noise does not count as attacks (our choice)."""

_LEAST_DB = 1.5
"""Rises that small are no attacks, be they ever so usual in a steady tone."""

_FRAMES_AT_ONCE = 4096


def onset_strength(mono: Floats) -> Floats:
    """Strength (3, n) of `mono` (m,) at `RATE_HZ`, a row an `OnsetBand`; column i belongs to i · `HOP_S`."""
    rms = float(np.sqrt(np.mean(np.square(mono, dtype=np.float64)))) if len(mono) else 0.0
    padded = np.pad(mono * np.float32(_RMS / max(rms, 1e-6)), _WINDOW // 2 + _WINDOW)
    count = len(mono) // HOP + 1
    flux = np.concatenate(
        [_flux(padded, first, min(count, first + _FRAMES_AT_ONCE)) for first in range(0, count, _FRAMES_AT_ONCE)],
        axis=1,
    )
    return np.stack([_by_usual(row) for row in flux])


def _flux(padded: Floats, first: int, end: int) -> Floats:
    """Rise in each band of frames `first` … `end` − 1, against `_RISE` frames before: (3, end − first)."""
    shift = _WINDOW - HOP * (_RISE // 2 + 1)  # a rise is greatest when the attack has come well into the later frame
    starts = (np.arange(first, end + _RISE) * HOP + shift)[:, None]
    frames = padded[starts + np.arange(_WINDOW)] * np.hanning(_WINDOW).astype(np.float32)
    loud = np.abs(np.fft.rfft(frames, axis=1)).astype(np.float32)
    db = 20 * np.log10(loud + 10.0 ** (_FLOOR_DB / 20.0) * _FULL)
    rise = np.maximum(db[_RISE:] - db[:-_RISE], 0.0)
    freqs = np.fft.rfftfreq(_WINDOW, 1 / RATE_HZ)
    rows = [rise[:, (freqs >= low) & (freqs < high)].mean(axis=1) for low, high in BANDS_HZ.values()]
    return np.stack(rows).astype(np.float32)


_FULL = _WINDOW / 16
"""Magnitude of a bin in music at full scale: the window's sum, 256, spread over some sixteen bins (our choice)."""


def _by_usual(row: Floats) -> Floats:
    """`row` (n,) in units of its usual attack around each moment."""
    block = round(1.0 / HOP_S)
    reach = round(_AROUND_S)
    blocks = np.pad(row, (0, -len(row) % block)).reshape(-1, block)
    usual = np.array(
        [np.quantile(blocks[max(0, i - reach) : i + reach + 1], _USUAL_QUANTILE) for i in range(len(blocks))]
    )
    least = max(_LEAST_DB, _LEAST_USUAL * float(np.quantile(usual, 0.9)))
    centres = (np.arange(len(blocks)) + 0.5) * block
    scale = np.interp(np.arange(len(row)), centres, np.maximum(usual, least))
    return np.asarray(row / scale, np.float32)

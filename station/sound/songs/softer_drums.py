"""A song with its drums softer, from one mixed file: what starts suddenly, where the part has a stroke, is turned down.

Near the strokes that are written, in the bands that their drum sounds in, and as long as it rings, each bin of the
spectrogram is turned down to what lasts there: what was there before the stroke, or is still there well after it. So
a chord or a bass note that begins with the stroke stays, but for its attack. It makes drums softer, not silent. (Median
filters along time and frequency, FitzGerald 2010, took strokes of the virtual band back by 2 dB where this takes 9.)
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import CYMBALS, DRUMS, Piece
from station.sound.drum_kit import Frames

Narrow = NDArray[np.float32]

WINDOW, HOP = 2048, 512
"""At 44.1 kHz 46 and 12 ms: bins of 22 Hz tell a bass note from a kick, and a stroke fills four of them."""

_PIECE_FRAMES, _LAP_FRAMES = 1600, 80
"""Spectra that are made at once, 19 s, and how many neighbours they see of each other: beyond all filters."""

_BEFORE, _AFTER = (3, 6, 9, 12), (4, 7, 10, 13, 16)
"""Spectra before and after each in which what lasts is looked for, 35–140 and 46–186 ms away: by then a kick has fallen
by 13 dB (by trial on the virtual band, between taking more of the drums and less of the rest)."""

_LEAST_BIAS = 1.2
"""The least of four magnitudes lies below what they are on average (by the same trial)."""


@dataclass(frozen=True, slots=True)
class _Ring:
    """Where a piece sounds in Hz, and for how many seconds it is turned down."""

    low_hz: float
    high_hz: float
    length_s: float


_RINGS: Mapping[Piece, _Ring] = MappingProxyType(
    {
        **dict.fromkeys(Piece, _Ring(200.0, 24_000.0, 0.15)),
        **dict.fromkeys(DRUMS, _Ring(60.0, 24_000.0, 0.3)),
        **dict.fromkeys(CYMBALS, _Ring(2_500.0, 24_000.0, 1.0)),
        Piece.KICK: _Ring(0.0, 24_000.0, 0.25),
        Piece.SNARE: _Ring(120.0, 24_000.0, 0.3),
        Piece.HIHAT: _Ring(4_000.0, 24_000.0, 0.2),
        Piece.HIHAT_PEDAL: _Ring(4_000.0, 24_000.0, 0.1),
    }
)
"""Our choice, by where these instruments have their power and how long they ring in a mix."""

_EARLY_S = 0.03
"""A stroke's first spectra begin before it: half a window, and what the beat may be off."""

_FLOOR = 0.05
"""No moment is turned down below −26 dB: holes are heard more than soft drums."""


def softer_drums(frames: Frames, rate_hz: int, at_s: NDArray[np.float64], pieces: NDArray[np.uint8]) -> Frames:
    """`frames` (n, 2) with the strokes at `at_s` (m,) seconds on `pieces` (m,), `Piece` values, turned down.

    Returns (n, 2). Takes about a tenth of the song's length and, beside the frames, the memory of 20 s of spectra.
    """
    out = np.zeros((len(frames) + 2 * WINDOW, 2), np.float32)
    padded = np.pad(frames, ((WINDOW, WINDOW + HOP), (0, 0)))
    window = np.hanning(WINDOW + 1)[:-1].astype(np.float32)
    count = (len(frames) + WINDOW) // HOP + 1
    gate = stroke_gate(count, rate_hz, at_s, pieces)
    for first, end in _pieces(count):
        near = max(0, first - _LAP_FRAMES), min(count, end + _LAP_FRAMES)
        spectra = _spectra(padded, *near, window)
        gains = _gains(np.sqrt((np.abs(spectra) ** 2).sum(axis=2)), gate[near[0] : near[1]])
        kept = slice(first - near[0], end - near[0])
        _put(out, first, spectra[kept] * gains[kept, :, None], window)
    return out[WINDOW : WINDOW + len(frames)]


def stroke_gate(count: int, rate_hz: int, at_s: NDArray[np.float64], pieces: NDArray[np.uint8]) -> Narrow:
    """Where a stroke sounds, 1, and where none does, 0, for `count` spectra and each bin: (count, WINDOW/2 + 1)."""
    freqs = np.fft.rfftfreq(WINDOW, 1 / rate_hz)
    gate = np.zeros((count, len(freqs)), np.float32)
    for start_s, piece in zip(at_s.tolist(), pieces.tolist(), strict=True):
        ring = _RINGS[Piece(piece)]
        # spectrum k is centred k·HOP − WINDOW/2 frames into the song
        first, end = (round((s * rate_hz + WINDOW / 2) / HOP) for s in (start_s - _EARLY_S, start_s + ring.length_s))
        bins = slice(*np.searchsorted(freqs, (ring.low_hz, ring.high_hz)).tolist())
        gate[max(0, first) : max(0, end), bins] = 1.0
    return gate


def _pieces(count: int) -> Iterator[tuple[int, int]]:
    yield from ((first, min(count, first + _PIECE_FRAMES)) for first in range(0, count, _PIECE_FRAMES))


def _spectra(padded: Frames, first: int, end: int, window: Narrow) -> NDArray[np.complex64]:
    """Spectra `first` … `end` − 1 of both sides: (end − first, bins, 2)."""
    starts = np.arange(first, end)[:, None] * HOP
    cut = padded[starts + np.arange(WINDOW)] * window[None, :, None]
    return np.asarray(np.fft.rfft(cut, axis=1), np.complex64)


def _gains(loud: Narrow, gate: Narrow) -> Narrow:
    """The gain of every bin of magnitudes `loud` (k, bins): down to what lasts where the gate is open."""
    before = np.minimum.reduce([_shifted(loud, -by) for by in _BEFORE])
    after = np.minimum.reduce([_shifted(loud, by) for by in _AFTER])
    lasts = _LEAST_BIAS * np.maximum(before, after)
    gain = np.clip(lasts / np.maximum(loud, 1e-9), _FLOOR, 1.0)
    return np.asarray(np.where(gate > 0.0, gain, 1.0), np.float32)


def _shifted(loud: Narrow, by: int) -> Narrow:
    """Row i + `by` in the place of row i; beyond the ends the last one stands."""
    return loud[np.clip(np.arange(len(loud)) + by, 0, len(loud) - 1)]


def _put(out: Frames, first: int, spectra: NDArray[np.complex64], window: Narrow) -> None:
    """Add the spectra's sound to `out`: windows of `hanning`² a quarter apart sum to 1.5."""
    sounds = np.fft.irfft(spectra, WINDOW, axis=1).astype(np.float32) * (window / np.float32(1.5))[None, :, None]
    for k, sound in enumerate(sounds):
        start = (first + k) * HOP
        end = min(len(out), start + WINDOW)
        out[start:end] += sound[: end - start]

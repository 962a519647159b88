"""A chirp to measure by, and where it is found in a recording.

A chirp is a tone that rises through the band that every speaker and microphone passes; correlated with itself it
shrinks to a peak of a fifth of a millisecond, whatever noise, hum, crackle or polarity lies over it (the matched
filter of radar: C. E. Cook & M. Bernfeld, *Radar signals*, 1967, ch. 6). The measure is the coherence, 0 to 1: the
magnitude of the analytic correlation over the root of both energies within the chirp's length. Its square is the share
of what was heard that is the chirp, so that neither level nor polarity matters and a click or a thump stays small.

A train's chirps stand at the marks of a Golomb ruler: no two distances are the same, so that only the true delay brings
all of them together, be it longer than the pauses between them.
"""

import numpy as np
from numpy.typing import NDArray

from station.sound.calibration.timeline import TimedRecording

Floats = NDArray[np.float64]

LOW_HZ, HIGH_HZ = 300.0, 7_000.0
"""What a small speaker and any microphone pass, below the Nyquist frequency of 16 kHz (our choice)."""
LENGTH_S = 0.06
PEAK = 0.35
"""−9 dB: clear, and no shock through headphones (our choice)."""
FADE = 0.15
"""Share of the length over which it swells and fades, each."""
RULER = (0, 1, 4, 10, 12, 17)
"""The shortest Golomb ruler with six marks."""
MARK_S = 0.15
SILENCE = 1e-6
"""RMS below which a recording holds nothing, −120 dB: below the noise of every converter (our choice)."""


def chirp(rate_hz: int) -> Floats:
    """One chirp at `rate_hz`: (n,), peak 1."""
    at_s = np.arange(round(LENGTH_S * rate_hz)) / rate_hz
    phase = 2 * np.pi * (LOW_HZ * at_s + (HIGH_HZ - LOW_HZ) * at_s**2 / (2 * LENGTH_S))
    edge = np.minimum(at_s, LENGTH_S - at_s) / (FADE * LENGTH_S)
    made: Floats = np.sin(phase) * np.sin(0.5 * np.pi * np.clip(edge, 0.0, 1.0)) ** 2
    return made


def train(rate_hz: int) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    """A train of chirps at `rate_hz`: the sound (n,) and the first frame of each chirp."""
    single = chirp(rate_hz)
    starts = np.round(np.array(RULER) * MARK_S * rate_hz).astype(np.int64)
    sound = np.zeros(starts[-1] + len(single), np.float32)
    for start in starts:
        sound[start : start + len(single)] += (PEAK * single).astype(np.float32)
    return sound, starts


def coherence(sound: NDArray[np.float32], rate_hz: int) -> Floats:
    """How much of one channel (n,) is a chirp that starts at each frame: (n,), 0 to 1."""
    template = chirp(rate_hz)
    size = 1 << (len(sound) + len(template) - 1).bit_length()
    spectrum = np.fft.fft(np.asarray(sound, np.float64), size)
    at_hz = np.fft.fftfreq(size, 1 / rate_hz)
    spectrum[(np.abs(at_hz) < LOW_HZ) | (np.abs(at_hz) > HIGH_HZ)] = 0.0
    heard = np.fft.ifft(spectrum).real
    analytic = 2.0 * spectrum * (at_hz > 0)
    match = np.abs(np.fft.ifft(analytic * np.conj(np.fft.fft(template, size))))[: len(sound)]
    total = np.concatenate([[0.0], np.cumsum(heard**2)])
    energy = total[len(template) : len(template) + len(sound)] - total[: len(sound)]
    floor = SILENCE**2 * len(template)
    found: Floats = match / np.sqrt(float(template @ template) * (np.maximum(energy, 0.0) + floor))
    return found


def found_at(coherent: Floats, near: int, within: int) -> tuple[float, float]:
    """The frame of the greatest coherence `within` frames of `near`, between frames by a parabola, and its height."""
    first = max(near - within, 1)
    part = coherent[first : min(near + within + 1, len(coherent) - 1)]
    if len(part) == 0:
        return float(near), 0.0
    peak = first + int(part.argmax())
    before, top, after = coherent[peak - 1 : peak + 2]
    bend = before - 2 * top + after
    return peak + (float((before - after) / (2 * bend)) if bend < 0 else 0.0), float(top)


def lags_s(least_s: float, most_s: float, rate_hz: int) -> NDArray[np.int64]:
    """The delays to try, in frames."""
    return np.arange(round(least_s * rate_hz), round(most_s * rate_hz) + 1)


def mean_coherence(
    recording: TimedRecording, coherent: Floats, played_ns: NDArray[np.int64], lags: NDArray[np.int64]
) -> Floats:
    """The mean coherence over all chirps for each of `lags` (in frames) after they were played: (len(lags),)."""
    starts = np.round(recording.timeline.frame_at(played_ns.astype(np.float64))).astype(np.int64)
    frames = starts[:, None] + lags
    inside = (frames >= 0) & (frames < len(coherent))
    summed: Floats = np.where(inside, coherent[np.clip(frames, 0, len(coherent) - 1)], 0.0).mean(axis=0)
    return summed

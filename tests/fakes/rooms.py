"""Synthetic recordings for calibration: what an input would hear of chirps and strokes, by formulas of its own.

Times are monotonic ns from `BEGIN_NS`; the recorder's crystal may run too fast by `ppm`, and then the times of its
blocks say so, as those of a real stream do.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.sound.calibration.chirp import FADE, HIGH_HZ, LENGTH_S, LOW_HZ, MARK_S, RULER
from station.sound.calibration.timeline import TimedRecording, Timeline

BEGIN_NS = 10**13
LEAD_S = 1.0
BLOCK_FRAMES = 256

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Room:
    """What happens between the loudspeaker, or the pad, and the recording.

    `echo_ms` and `echo_gain` of a reflection; `noise` RMS and `hum` (50 Hz) of full scale; so many `crackles` of full
    scale; what is beyond `clip` is cut off and the rest made that much louder.
    """

    gain: float = 0.2
    noise: float = 0.001
    echo_ms: float = 0.0
    echo_gain: float = 0.0
    hum: float = 0.0
    crackles: int = 0
    clip: float | None = None
    rate_hz: int = 48_000
    ppm: float = 0.0
    seed: int = 1

    def recorded(self, sound: Floats) -> TimedRecording:
        """`sound` (n,) with the room's noises, on the second of two channels."""
        rng = np.random.default_rng(self.seed)
        heard = sound + self.noise * rng.standard_normal(len(sound))
        heard += self.hum * np.sin(2 * np.pi * 50 * np.arange(len(sound)) / self.rate_hz)
        heard[rng.integers(0, len(heard), self.crackles)] += rng.choice([-1.0, 1.0], self.crackles)
        if self.clip is not None:
            heard = np.clip(heard, -self.clip, self.clip) / self.clip
        frames = np.arange(0, len(sound), BLOCK_FRAMES)
        times = BEGIN_NS + np.round(frames / self.true_rate_hz * 1e9).astype(np.int64)
        stereo = np.column_stack([np.zeros(len(heard)), heard]).astype(np.float32)
        return TimedRecording(stereo, Timeline(frames, times, self.rate_hz))

    @property
    def true_rate_hz(self) -> float:
        """By the monotonic clock."""
        return self.rate_hz * (1 + self.ppm / 1e6)


def chirps_played_ns() -> NDArray[np.int64]:
    """When a train of chirps left, by the output's report."""
    return BEGIN_NS + np.round((LEAD_S + np.array(RULER) * MARK_S) * 1e9).astype(np.int64)


def room_with_chirps(room: Room, delay_ms: float) -> TimedRecording:
    """A train that comes back `delay_ms` after it left."""
    count = round((LEAD_S + RULER[-1] * MARK_S + 1.5) * room.rate_hz)
    at_s = np.arange(count) / room.true_rate_hz - LEAD_S - delay_ms / 1e3
    sound = room.gain * _train(at_s) + room.gain * room.echo_gain * _train(at_s - room.echo_ms / 1e3)
    return room.recorded(sound)


def _train(at_s: Floats) -> Floats:
    """Linear sweeps with sin² edges, written out in time and not in frames."""
    sound = np.zeros(len(at_s))
    for mark in RULER:
        since = at_s - mark * MARK_S
        inside = (since >= 0) & (since < LENGTH_S)
        s = since[inside]
        swell = np.clip(np.minimum(s, LENGTH_S - s) / (FADE * LENGTH_S), 0, 1)
        angle = 2 * np.pi * s * (LOW_HZ + (HIGH_HZ - LOW_HZ) / (2 * LENGTH_S) * s)
        sound[inside] += np.sin(angle) * np.sin(np.pi / 2 * swell) ** 2
    return sound


def strokes_at_s(count: int, seed: int, gap_s: tuple[float, float] = (0.5, 0.9)) -> Floats:
    """When a person strikes, `count` times, from `BEGIN_NS`."""
    return 0.5 + np.cumsum(np.random.default_rng(seed).uniform(*gap_s, count))


def room_with_strokes(room: Room, at_s: Sequence[float] | Floats) -> TimedRecording:
    """Pads that are struck at `at_s`: a stick's noise and a head's tone, of various strengths."""
    rng = np.random.default_rng(room.seed + 1)
    sound = np.zeros(round((max(at_s) + 1.0) * room.rate_hz))
    for at in at_s:
        gain = room.gain * rng.uniform(0.2, 1.0)
        _strike(sound, at, gain, room.rate_hz, rng)
        if room.echo_gain:
            _strike(sound, at + room.echo_ms / 1e3, gain * room.echo_gain, room.rate_hz, rng)
    return room.recorded(sound)


def _strike(sound: Floats, at_s: float, gain: float, rate_hz: int, rng: np.random.Generator) -> None:
    first = int(np.ceil(at_s * rate_hz))
    since = np.arange(first, min(first + round(0.15 * rate_hz), len(sound))) / rate_hz - at_s
    head = np.exp(-since / 0.02) * np.sin(2 * np.pi * 310 * since)
    stick = np.exp(-since / 0.004) * rng.standard_normal(len(since))
    sound[first : first + len(since)] += gain * (head + 0.4 * stick)


def stamps_ns(at_s: Floats, late_ms: float | Floats, jitter_ms: float, seed: int) -> NDArray[np.int64]:
    """The stamps of strokes at `at_s` by a kit that is `late_ms` and jitters by an SD of `jitter_ms`."""
    jitter = jitter_ms * np.random.default_rng(seed).standard_normal(len(at_s))
    return BEGIN_NS + np.round((at_s + (late_ms + jitter) / 1e3) * 1e9).astype(np.int64)

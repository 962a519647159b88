"""A sound whose beat is known: kick, snare and hats of noise and tones, over a chord that lasts."""

import numpy as np
from numpy.typing import NDArray

from station.sound.songs.onset_strength import RATE_HZ


def rock(bpm: float, first_beat_s: float, length_s: float = 40.0, scatter_s: float = 0.0) -> NDArray[np.float32]:
    """Eighths on a hat, kick on 1 and 3, snare on 2 and 4: (n,) at `RATE_HZ`."""
    chance = np.random.default_rng(7)
    time_s = np.arange(round(length_s * RATE_HZ)) / RATE_HZ
    sound = 0.02 * np.sin(2 * np.pi * np.outer((220.0, 277.2, 329.6), time_s)).sum(axis=0)
    ring_s = np.arange(round(0.15 * RATE_HZ)) / RATE_HZ
    noise = chance.normal(size=len(ring_s))
    kick = np.sin(2 * np.pi * 60 * ring_s) * np.exp(-ring_s / 0.05)
    snare = (0.5 * noise + np.sin(2 * np.pi * 200 * ring_s)) * np.exp(-ring_s / 0.04)
    hat = 0.15 * np.diff(noise, prepend=0.0) * np.exp(-ring_s / 0.02)
    for eighth in range(int((length_s - first_beat_s - 0.5) * bpm / 30)):
        struck = [hat, *({0: [kick], 2: [snare]}.get(eighth % 4, []))]
        at = round((first_beat_s + eighth * 30 / bpm + chance.normal(scale=scatter_s)) * RATE_HZ)
        for each in struck:
            sound[at : at + len(ring_s)] += 0.5 * each
    return np.asarray(sound, np.float32)


def rock_track(bpm: float, first_beat_s: float, length_s: float = 20.0) -> NDArray[np.float32]:
    """The same on both sides: (n, 2)."""
    sound = rock(bpm, first_beat_s, length_s)
    return np.column_stack([sound, sound])

"""The outline of a song's sound, as a listener looks for a beat in it."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.sound.samples.audio_file import read_audio
from station.sound.track import MAX_TRACK_S

PEAKS_A_SECOND = 200
"""5 ms: a stroke is one of them wide (our choice)."""
_RATE_HZ = 40 * PEAKS_A_SECOND
"""Enough for kick and snare; what lies above says little to the eye."""


def outline(paths: Sequence[Path]) -> NDArray[np.float32]:
    """The highest level of each 5 ms (n,), 0 … 1, of files that sound together; raises `BadInput`.

    Of files longer than `MAX_TRACK_S` the beginning.
    """
    highest = np.zeros(0, np.float32)
    for path in paths:
        mono = np.abs(read_audio(path, str(path), _RATE_HZ, MAX_TRACK_S).mean(axis=1))
        step = _RATE_HZ // PEAKS_A_SECOND
        padded = np.pad(mono, (0, -len(mono) % step)).reshape(-1, step).max(axis=1)
        longer, other = (highest, padded) if len(highest) >= len(padded) else (padded, highest)
        highest = longer.copy()
        highest[: len(other)] += other
    top = float(highest.max(initial=0.0))
    return (highest / top if top else highest).astype(np.float32)

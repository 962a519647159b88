"""What a sound file tells of its attacks: how strongly each band starts at each moment, and when attacks begin.

`sound.songs.song_onsets` finds them, `drills.songs` asks them where a band is in its song.
"""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray


class OnsetBand(IntEnum):
    """Part of the spectrum in which attacks are looked for apart."""

    LOW = 0
    """Kick and bass, below 150 Hz."""
    MID = 1
    """Snare, toms, guitars, voices."""
    HIGH = 2
    """Cymbals and the wires of the snare, above 5 kHz."""


@dataclass(frozen=True, eq=False)
class SoundOnsets:
    """Onsets of one sound file.

    `strength` (3, n) ≥ 0, a row an `OnsetBand`, is how strongly the band starts at `i * hop_s`: 1 is a usual attack
    of that band at that time of the song. `at_s` (m,) rises: when single attacks begin, with their `band` (m,) and
    `weight` (m,), the strength that each has. `length_s` is the file's.
    """

    hop_s: float
    strength: NDArray[np.float32]
    at_s: NDArray[np.float64]
    band: NDArray[np.int8]
    weight: NDArray[np.float32]
    length_s: float

"""The onsets of a song's sound file, kept on disk once they are found."""

import hashlib
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from station.core.disk.files import write_whole
from station.core.disk_cache import cache_folder, forget_oldest
from station.core.errors import DeviceError
from station.music.sound_onsets import SoundOnsets
from station.sound.samples.audio_file import read_audio
from station.sound.songs.attack_times import attacks
from station.sound.songs.onset_strength import HOP_S, RATE_HZ, onset_strength
from station.sound.track import MAX_TRACK_S

CACHED_FILES = 32
"""Half a megabyte each for a song of four minutes."""

_ENDING = ".onsets.npz"
_VERSION = 1
"""Another one when the same sound gives other onsets."""


def song_onsets(path: Path, folder: Path | None = None) -> SoundOnsets:
    """The onsets of a sound file, of its first `MAX_TRACK_S`, from the cache where they lie there.

    A song of four minutes takes two or three seconds: never call it where something moves. Raises `BadInput` for what
    is no sound, `DeviceError` for a file that cannot be read or kept.
    """
    home = folder or cache_folder("onsets")
    kept = home / f"{_digest(path)}{_ENDING}" if path.is_file() else None
    if kept is not None and (found := _loaded(kept)) is not None:
        return found
    onsets = onsets_of(read_audio(path, str(path), RATE_HZ, MAX_TRACK_S).mean(axis=1))
    if kept is not None:
        write_whole(kept, _packed(onsets))
        forget_oldest(home, _ENDING, CACHED_FILES)
    return onsets


def onsets_of(mono: NDArray[np.float32]) -> SoundOnsets:
    """The onsets of `mono` (n,), sound at `RATE_HZ`."""
    strength = onset_strength(mono)
    at_s, band, weight = attacks(mono, strength)
    return SoundOnsets(HOP_S, strength, at_s, band, weight, len(mono) / RATE_HZ)


def _digest(path: Path) -> str:
    """Names the file as it is now; raises `DeviceError`."""
    try:
        stat = path.stat()
        facts = (str(path.resolve()), stat.st_size, stat.st_mtime_ns, _VERSION)
    except OSError as fault:
        raise DeviceError(f"{path}: cannot be read: {fault.strerror or fault}") from fault
    return hashlib.sha256(repr(facts).encode()).hexdigest()[:24]


def _packed(onsets: SoundOnsets) -> bytes:
    file = BytesIO()
    np.savez(
        file,
        strength=onsets.strength.astype(np.float16),
        at_s=onsets.at_s,
        band=onsets.band,
        weight=onsets.weight,
        length_s=np.array(onsets.length_s),
    )
    return file.getvalue()


_DAMAGE = (OSError, ValueError, KeyError, EOFError, BadZipFile)


def _loaded(kept: Path) -> SoundOnsets | None:
    """What lies there; None where nothing does, or nothing whole."""
    with suppress(*_DAMAGE), np.load(BytesIO(kept.read_bytes()), allow_pickle=False) as file:
        strength = file["strength"].astype(np.float32)
        return SoundOnsets(HOP_S, strength, file["at_s"], file["band"], file["weight"], float(file["length_s"]))
    return None

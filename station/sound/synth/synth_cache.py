"""Synthesised kits kept on disk: made once on a computer, and there within a tenth of a second from then on.

A file holds one kit at one rate: a numpy array with a checksum and the takes' lengths, then all takes as float32, left
and right in turn. The takes are mapped, not read: every process that plays the kit shares one copy in memory, and the
checksum, which tells a damaged file, has touched each page before the sound needs it. A file's name bears a digest of
the recipes and of the code that makes sounds of them, so that it never outlives what made it. Nothing depends on the
cache: a file that cannot be read or written costs time alone.
"""

import hashlib
import secrets
import zlib
from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from types import MappingProxyType

import numpy as np

from station.core.disk_cache import cache_folder, forget_oldest
from station.core.sound_names import SoundName
from station.sound.drum_kit import DrumKit, Frames, Layer, Sound
from station.sound.synth.layers import TAKES
from station.sound.synth.recipe import Recipe
from station.sound.synth.synth_kits import KIT_NAME, MODELS, synth_kit

CACHED_FILES = 4
"""Kits on disk, the oldest go first (our choice: two kits at two rates, some 400 MB)."""
_ENDING = ".kit"


def cached_kit(model: str = KIT_NAME, rate_hz: int = 48_000, folder: Path | None = None) -> DrumKit:
    """The synthesised kit `model` at `rate_hz`, from disk where it was made before, else made and kept there."""
    path = _path(model, rate_hz, folder)
    kit = _read(path, model, rate_hz)
    if kit is None:
        kit = synth_kit.__wrapped__(rate_hz, model)
        with suppress(OSError):
            _write(path, kit)
            forget_oldest(path.parent, _ENDING, CACHED_FILES)
    return kit


def is_made(model: str, rate_hz: int, folder: Path | None = None) -> bool:
    """Whether `cached_kit` will find the kit on disk; making it takes two seconds of a processor."""
    return _path(model, rate_hz, folder).exists()


def _path(model: str, rate_hz: int, folder: Path | None) -> Path:
    return (folder or cache_folder("kits")) / f"{model}-{rate_hz}-{_digest(model)}{_ENDING}"


@lru_cache
def _digest(model: str) -> str:
    code = hashlib.sha256(repr(sorted(MODELS[model].items())).encode())
    package = files("station.sound")
    for source in sorted((package / "synth").iterdir(), key=lambda entry: entry.name):
        if source.name.endswith(".py"):
            code.update(source.read_bytes())
    code.update((package / "limiter.py").read_bytes())
    return code.hexdigest()[:16]


def _slots(recipes: Mapping[SoundName, Recipe]) -> Iterator[tuple[SoundName, int]]:
    """Each layer of the kit, as its sound and its greatest velocity, in the order of the file."""
    return ((name, reach) for name, recipe in recipes.items() for reach in recipe.layers)


def _read(path: Path, model: str, rate_hz: int) -> DrumKit | None:
    """The kit at `path`; None where there is none, or no whole one."""
    try:
        with path.open("rb") as file:
            head = np.lib.format.read_array(file, allow_pickle=False)
            mapped = np.asarray(np.memmap(file, np.float32, "r", offset=file.tell()))
    except (OSError, ValueError, EOFError):
        return None
    slots = list(_slots(MODELS[model]))
    if head.dtype != np.int64 or head.shape != (1 + TAKES * len(slots),):
        return None
    checksum, lengths = int(head[0]), head[1:]
    if len(mapped) != 2 * lengths.sum() or zlib.crc32(mapped.data) != checksum:
        return None
    with suppress(OSError):
        path.touch()
    takes = iter(np.split(mapped.reshape(-1, 2), np.cumsum(lengths)[:-1]))
    layers: dict[SoundName, list[Layer]] = {}
    for name, reach in slots:
        layers.setdefault(name, []).append(Layer(reach, tuple(next(takes) for _ in range(TAKES))))
    return DrumKit(model, rate_hz, MappingProxyType({name: Sound(tuple(its)) for name, its in layers.items()}))


def _write(path: Path, kit: DrumKit) -> None:
    takes: list[Frames] = [take for sound in kit.sounds.values() for layer in sound.layers for take in layer.takes]
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{secrets.token_hex(8)}.part")
    try:
        with part.open("xb") as file:  # no fsync: a file torn by a power cut is found out when it is read
            frames = np.concatenate(takes)
            np.save(file, np.array([zlib.crc32(frames.data), *(len(take) for take in takes)], np.int64))
            file.write(frames.data)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)

"""What a scene is made of, kept on disk: solids and pictures take most of a second to make and a hundredth to read.

A file holds named arrays: a checksum of all that follows (CRC-32, 4 bytes, the least first), then numpy's `.npz`, which
alone would leave its table of contents unchecked. Its name bears a digest of what was asked for and of the code of
drummers and pictures, so that it never outlives what made it. Nothing depends on the files: one that cannot be read is
made anew, one that cannot be written costs time alone.
"""

import hashlib
import io
import os
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import fields
from functools import lru_cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from station.core.disk.files import write_whole
from station.core.disk_cache import cache_folder, forget_oldest
from station.core.errors import DeviceError
from station.motion.kinematics.figure import Figure
from station.motion.kit.kit import Kit
from station.render.figure.body import build_body
from station.render.figure.skin import Skin
from station.render.geometry.light import Light
from station.render.geometry.mesh import Mesh
from station.render.kit.floor_paint import boards_picture, rug_picture
from station.render.kit.instrument_meshes import Detail
from station.render.kit.kit_rig import KitRig, kit_mesh, rig_of
from station.render.kit.room import Disc, floor_light, wall_picture

Arrays = Mapping[str, NDArray[Any]]

CACHED_FILES = 16
"""The oldest go first (our choice: a few kits and figures at three qualities, some 60 MB)."""
_ENDING = ".scene"
_CHECKSUM_BYTES = 4
_PICTURE = "picture"


def cached_kit(kit: Kit, detail: Detail) -> KitRig:
    """The rig of `kit`, its mesh from disk where it was made before."""
    return rig_of(kit, Mesh(**cached("kit", (kit, detail), lambda: _arrays(kit_mesh(kit, detail)))))


def cached_body(figure: Figure, fineness: float) -> Skin:
    """`build_body`, from disk where it was made before."""
    return Skin(**cached("body", (figure, fineness), lambda: _arrays(build_body(figure, fineness))))


def cached_paint() -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    """`boards_picture` and `rug_picture` in 255ths, from disk where they were made before."""
    pictures = cached("paint", None, lambda: {"boards": _bytes(boards_picture()), "rug": _bytes(rug_picture())})
    return pictures["boards"], pictures["rug"]


def _bytes(picture: NDArray[np.float32]) -> NDArray[np.uint8]:
    return np.asarray(np.clip(np.rint(picture * 255), 0, 255), np.uint8)


def cached_light(discs: Sequence[Disc], light: Light) -> NDArray[np.uint8]:
    """`floor_light` under what shades the floor, from disk where it was made before."""
    return cached("light", (discs, light), lambda: {_PICTURE: floor_light(discs, light)})[_PICTURE]


def cached_wall() -> NDArray[np.uint8]:
    """`wall_picture`, from disk where it was made before."""
    return cached("wall", None, lambda: {_PICTURE: wall_picture()})[_PICTURE]


def cached(name: str, wanted: object, make: Callable[[], Arrays], folder: Path | None = None) -> Arrays:
    """What `make` makes of `wanted`, which its `repr` tells from all else; from disk where it was made before."""
    path = (folder or cache_folder("scenes")) / f"{name}-{_digest(wanted)}{_ENDING}"
    found = _read(path)
    if found is None:
        found = make()
        with suppress(DeviceError):
            write_whole(path, _packed(found))
            forget_oldest(path.parent, _ENDING, CACHED_FILES)
    return found


def _arrays(solid: Mesh | Skin) -> Arrays:
    return {field.name: getattr(solid, field.name) for field in fields(solid)}


def _digest(wanted: object) -> str:
    words = repr(wanted)
    assert " at 0x" not in words, "an address tells nothing apart"
    return hashlib.sha256(f"{_code()} {words}".encode()).hexdigest()[:24]


@lru_cache
def _code() -> str:
    """A digest of all code that the cached arrays may depend on."""
    digest = hashlib.sha256(np.__version__.encode())
    for source in _sources("station.motion", "station.render"):
        digest.update(source)
    return digest.hexdigest()


def _sources(*packages: str) -> Iterable[bytes]:
    for package in packages:
        yield from _code_in(files(package))


def _code_in(folder: Traversable) -> Iterator[bytes]:
    for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
        if entry.is_dir():
            yield from _code_in(entry)
        elif entry.name.endswith(".py"):
            yield entry.read_bytes()


def _read(path: Path) -> Arrays | None:
    """The arrays at `path`; None where there are none, or no whole ones."""
    try:
        whole = path.read_bytes()
    except OSError:
        return None
    if whole[:_CHECKSUM_BYTES] != _checksum(memoryview(whole)[_CHECKSUM_BYTES:]):
        return None
    with suppress(OSError):  # a folder that may only be read
        os.utime(path)
    with np.load(io.BytesIO(whole[_CHECKSUM_BYTES:]), allow_pickle=False) as file:
        return dict(file)


def _packed(arrays: Arrays) -> bytes:
    file = io.BytesIO()
    np.savez(file, **arrays)  # type: ignore[arg-type] # numpy's stub thinks of a flag
    return _checksum(file.getbuffer()) + file.getvalue()


def _checksum(data: memoryview) -> bytes:
    return zlib.crc32(data).to_bytes(_CHECKSUM_BYTES, "little")

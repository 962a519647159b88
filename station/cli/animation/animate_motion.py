"""What `station animate` writes for other programs: the drummer's motion, a writer a file's ending."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.motion.drummer import Drummer

Times = NDArray[np.float64]
Writer = Callable[[Drummer, Path, Times], None]


def _npz() -> Writer:
    from station.motion.export.npz import write_npz

    return write_npz


def _bvh() -> Writer:
    from station.motion.export.bvh import write_bvh

    return write_bvh


def _glb() -> Writer:
    from station.motion.export.gltf import write_glb

    return write_glb


WRITERS: dict[str, Callable[[], Writer]] = {".npz": _npz, ".bvh": _bvh, ".glb": _glb}

"""Acclaim motion (`.amc`): the angles of a skeleton's bones, frame by frame, in the order that its `.asf` gives."""

from pathlib import Path

import numpy as np

from station.core.counts import is_count
from station.core.errors import BadInput
from station.sync.signals.asf import AsfSkeleton, read_asf
from station.sync.signals.signal import Signal
from station.sync.signals.signal_text import numbered_lines, numbers

RATE_HZ = 120.0
"""The file does not say it; Boyd and Godbout 2012, § 4.1, of the CMU database."""
DEGREES, FULLY_SPECIFIED = ":DEGREES", ":FULLY-SPECIFIED"


def read_amc(path: Path) -> Signal:
    """A channel for every degree of freedom, such as `rfemur_rx`, in degrees; `root_tx` … in the skeleton's unit.

    The first frame is at 0 s, whatever its number. Raises `BadInput`, also where no `.asf` lies beside the file.
    """
    skeleton = read_asf(skeleton_beside(path))
    names = tuple(f"{bone.name}_{freedom}" for bone in skeleton.bones.values() for freedom in bone.freedoms)
    frames = _frames(path, skeleton)
    if not frames:
        raise BadInput(path, "", "holds no frame")
    values = np.array(frames, dtype=np.float64)
    return Signal(np.arange(len(values)) / RATE_HZ, names, values, str(path))


def skeleton_beside(path: Path) -> Path:
    """The skeleton of a motion: `07.asf` beside `07_01.amc`, or the only one there is; raises `BadInput`."""
    named = [path.with_name(f"{stem}.asf") for stem in (path.stem, path.stem.split("_")[0])]
    found = [each for each in named if each.is_file()] or sorted(path.parent.glob("*.asf"))
    if not path.exists() or len(found) == 1 or (found and found[0] in named):
        return found[0] if found else named[-1]
    raise BadInput(path, "", f"expected its skeleton beside it, such as {named[-1].name}")


def _frames(path: Path, skeleton: AsfSkeleton) -> list[list[float]]:
    widths = {name: len(bone.freedoms) for name, bone in skeleton.bones.items() if bone.freedoms}
    frames: list[list[float]] = []
    found: dict[str, list[float]] = {}
    number = at = None
    for line, text in numbered_lines(path, "an AMC motion", "#"):
        name, *words = text.split()
        if name.startswith(":"):
            _check_keyword(name, path, line)
        elif not words and is_count(name):
            if number is not None and int(name) != number + 1:
                raise BadInput(path, f"line {line}", f"expected frame {number + 1}, found {name}")
            if at is not None:
                frames.append(_frame(found, widths, path, at))
            number, at, found = int(name), line, {}
        elif at is None:
            raise BadInput(path, f"line {line}", f"expected the number of a frame, found {name}")
        else:
            found[name] = _angles(name, words, widths, found, path, line)
    if at is not None:
        frames.append(_frame(found, widths, path, at))
    return frames


def _check_keyword(name: str, path: Path, line: int) -> None:
    if name not in (DEGREES, FULLY_SPECIFIED):
        raise BadInput(path, f"line {line}", f"expected {FULLY_SPECIFIED} or {DEGREES}, found {name}")


def _angles(
    name: str, words: list[str], widths: dict[str, int], found: dict[str, list[float]], path: Path, line: int
) -> list[float]:
    if name not in widths:
        raise BadInput(path, f"line {line}", f"the skeleton has no bone that moves and is called {name}")
    if name in found:
        raise BadInput(path, f"line {line}", f"{name} is in this frame twice")
    if len(words) != widths[name]:
        raise BadInput(path, f"line {line}", f"{name}: expected {widths[name]} numbers, found {len(words)}")
    return numbers(words, path, line)


def _frame(found: dict[str, list[float]], widths: dict[str, int], path: Path, line: int) -> list[float]:
    missing = next((name for name in widths if name not in found), None)
    if missing is not None:
        raise BadInput(path, f"line {line}", f"this frame lacks {missing}")
    return [value for name in widths for value in found[name]]

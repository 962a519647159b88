"""Acclaim skeletons (`.asf`): the bones of an actor and how they hang together.

The format is Acclaim's; as the CMU database and its tools read it: M. Schafer, "ASF Skeleton File (acclaim)",
https://research.cs.wisc.edu/graphics/Courses/cs-838-1999/Jeff/ASF-AMC.html.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from station.core.errors import BadInput
from station.sync.signals.signal_text import numbered_lines, numbers

ROOT = "root"
DEGREES_OF_FREEDOM = ("tx", "ty", "tz", "rx", "ry", "rz")
Vector = tuple[float, float, float]
_SECTIONS = ("version", "name", "units", "documentation", ROOT, "bonedata", "hierarchy")
_SKIPPED = ("id", "limits", "bodymass", "cofmass")


@dataclass(frozen=True, slots=True)
class Bone:
    """A bone as the file has it, in its unit of length and in degrees.

    `direction` (a unit vector, in the axes of the room) and `length` lead from its near end to its far end at rest;
    `axis_deg` and `axis_order` turn the room's axes into those that its angles `freedoms` (such as rx) are about.
    """

    name: str
    direction: Vector = (0.0, 0.0, 0.0)
    length: float = 0.0
    axis_deg: Vector = (0.0, 0.0, 0.0)
    axis_order: str = "XYZ"
    freedoms: tuple[str, ...] = ()
    parent: str | None = None


@dataclass(frozen=True, slots=True)
class AsfSkeleton:
    """The bones by name, the root first and every parent before its children; `length_unit` divides inches.

    A length in the file is in 1/`length_unit` inches: the CMU database gives 0.45.
    """

    bones: dict[str, Bone] = field(default_factory=dict)
    length_unit: float = 1.0


def read_asf(path: Path) -> AsfSkeleton:
    """The skeleton of a file; raises `BadInput`."""
    bones: dict[str, Bone] = {ROOT: Bone(ROOT)}
    parents: dict[str, tuple[int, str]] = {}
    length_unit, section = 1.0, ""
    lines = iter(list(numbered_lines(path, "an ASF skeleton", "#")))
    for line, text in lines:
        key, *words = text.split()
        if key.startswith(":"):
            section = _section(key[1:], path, line)
        elif section == "units":
            length_unit = _units(key, words, length_unit, path, line)
        elif section == ROOT:
            bones[ROOT] = _with_root(bones[ROOT], key, words, path, line)
        elif section == "bonedata":
            bone = _bone(lines, line, text, path)
            if bone.name in bones:
                raise BadInput(path, f"line {line}", f"{bone.name} is here twice")
            bones[bone.name] = bone
        elif section == "hierarchy" and text not in ("begin", "end"):
            parents.update(dict.fromkeys(words, (line, key)))
    return AsfSkeleton(_hung_together(bones, parents, path), length_unit)


def _section(name: str, path: Path, line: int) -> str:
    if name not in _SECTIONS:
        raise BadInput(path, f"line {line}", f"no such section: :{name}; expected one of {', '.join(_SECTIONS)}")
    return name


def _units(key: str, words: list[str], length_unit: float, path: Path, line: int) -> float:
    if key == "angle" and words != ["deg"]:
        raise BadInput(path, f"line {line}", f"expected angle deg, found angle {' '.join(words)}")
    if key != "length":
        return length_unit
    (unit,) = _numbers(words, 1, path, line)
    if unit <= 0:
        raise BadInput(path, f"line {line}", f"expected a length above 0, found {unit:g}")
    return unit


def _with_root(root: Bone, key: str, words: list[str], path: Path, line: int) -> Bone:
    if key == "order":
        return replace(root, freedoms=_freedoms(words, path, line))
    if key == "axis" and words:
        return replace(root, axis_order=words[0])
    return root


def _bone(lines: Iterator[tuple[int, str]], line: int, text: str, path: Path) -> Bone:
    """One bone, from its `begin` to its `end`; further lines of limits stand alone in brackets."""
    if text != "begin":
        raise BadInput(path, f"line {line}", f"expected begin, found {text}")
    bone = Bone("")
    for at, entry in lines:
        key, *words = entry.split()
        if key == "end":
            if not bone.name:
                raise BadInput(path, f"line {at}", "a bone without a name")
            return bone
        bone = _with_entry(bone, key, words, path, at)
    raise BadInput(path, f"line {line}", "this bone does not end")


def _with_entry(bone: Bone, key: str, words: list[str], path: Path, line: int) -> Bone:
    if key == "name" and len(words) == 1:
        return replace(bone, name=words[0])
    if key == "direction":
        return replace(bone, direction=_vector(words, path, line))
    if key == "length":
        return replace(bone, length=_numbers(words, 1, path, line)[0])
    if key == "axis" and len(words) == 4:
        return replace(bone, axis_deg=_vector(words[:3], path, line), axis_order=words[3])
    if key == "dof":
        return replace(bone, freedoms=_freedoms(words, path, line))
    if key in _SKIPPED or key.startswith("("):
        return bone
    raise BadInput(path, f"line {line}", f"no such entry of a bone: {key} {' '.join(words)}")


def _freedoms(words: list[str], path: Path, line: int) -> tuple[str, ...]:
    small = tuple(word.lower() for word in words)
    strange = next((word for word in small if word not in DEGREES_OF_FREEDOM), None)
    if strange is not None or len(set(small)) < len(small):
        raise BadInput(
            path, f"line {line}", f"expected some of {' '.join(DEGREES_OF_FREEDOM)}, found {' '.join(words)}"
        )
    return small


def _vector(words: list[str], path: Path, line: int) -> Vector:
    x, y, z = _numbers(words, 3, path, line)
    return x, y, z


def _numbers(words: list[str], count: int, path: Path, line: int) -> list[float]:
    if len(words) != count:
        raise BadInput(path, f"line {line}", f"expected {count} numbers, found {len(words)}")
    return numbers(words, path, line)


def _hung_together(bones: dict[str, Bone], parents: dict[str, tuple[int, str]], path: Path) -> dict[str, Bone]:
    """The bones with their parents, in an order in which every parent comes before its children."""
    for child, (line, parent) in parents.items():
        missing = next((name for name in (child, parent) if name not in bones), None)
        if missing is not None or child == ROOT:
            raise BadInput(path, f"line {line}", f"no such bone: {missing or child}")
    place = {name: at for at, name in enumerate(bones)}
    children: dict[str, list[str]] = {}
    for child, (_, parent) in parents.items():
        children.setdefault(parent, []).append(child)
    hung, ready = {ROOT: bones[ROOT]}, [ROOT]
    while ready:
        ready = sorted((child for name in ready for child in children.get(name, ())), key=place.__getitem__)
        hung |= {name: replace(bones[name], parent=parents[name][1]) for name in ready}
    loose = next((name for name in bones if name not in hung), None)
    if loose is not None:
        raise BadInput(path, ":hierarchy", f"{loose} does not hang on the {ROOT}")
    return hung

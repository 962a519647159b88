"""A walker made of sines as motion-capture files: `1.asf` and `1_01.amc`, as Vicon's programs write them."""

from itertools import pairwise
from pathlib import Path

import numpy as np

RATE_HZ = 120.0
PERIOD_S = 1.05
_SHANK, _FOOT = 7.5, 2.0
_CHAIN = (("hipjoint", 2.0), ("femur", 7.5), ("tibia", _SHANK), ("foot", _FOOT), ("toes", 1.0))
_DIRECTIONS = {"femur": "0 -1 0", "tibia": "0 -1 0", "foot": "0 0 1", "toes": "0 0 1"}


def asf_text() -> str:
    """Two legs and a trunk."""
    bones, links = [_bone("lowerback", "0 1 0", 8.0)], ["root lhipjoint rhipjoint lowerback"]
    for side, x in (("l", 1), ("r", -1)):
        for name, length in _CHAIN:
            direction = _DIRECTIONS.get(name, f"{x} 0 0")
            bones.append(_bone(side + name, direction, length, name in ("femur", "tibia")))
        names = [side + name for name, _ in _CHAIN]
        links += [f"{a} {b}" for a, b in pairwise(names)]
    head = [":version 1.10", ":name made", ":units", "mass 1.0", "length 0.45", "angle deg", ":root"]
    root = ["order TX TY TZ RX RY RZ", "axis XYZ", "position 0 0 0", "orientation 0 0 0"]
    return "\n".join([*head, *root, ":bonedata", *bones, ":hierarchy", "begin", *links, "end", ""])


def _bone(name: str, direction: str, length: float, turns: bool = False) -> str:
    dof = ["dof rx"] if turns else []
    return "\n".join(
        ["begin", f"name {name}", f"direction {direction}", f"length {length}", "axis 0 0 0 XYZ", *dof, "end"]
    )


def amc_text(cycles: float) -> str:
    """The right thigh passes its middle, going back, at each whole cycle; a knee bends while its thigh goes ahead."""
    lines = [":FULLY-SPECIFIED", ":DEGREES"]
    for k in range(round(cycles * PERIOD_S * RATE_HZ)):
        turn = 2 * np.pi * k / RATE_HZ / PERIOD_S
        lines += [str(k + 1), f"root 0 16.5 {1.4 / 0.0564 * k / RATE_HZ:.4f} 0 0 0"]
        for side, at in (("r", turn), ("l", turn + np.pi)):
            lines.append(f"{side}femur {25 * np.sin(at):.4f}")
            lines.append(f"{side}tibia {25 + 25 * np.cos(at + np.pi):.4f}")
    return "\n".join([*lines, ""])


def write_walker(folder: Path, cycles: float = 6.0) -> Path:
    """The motion's file in `folder`, its skeleton beside it."""
    (folder / "1.asf").write_text(asf_text())
    path = folder / "1_01.amc"
    path.write_text(amc_text(cycles))
    return path

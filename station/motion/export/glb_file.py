"""glTF 2.0 in one binary file: nodes, meshes, materials and sampled animation, and nothing else.

Source: Khronos, glTF 2.0 Specification, §§ 3.6 (buffers and accessors), 3.11 (animations), 4.4 (GLB layout).
"""

import json
import struct
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from station.motion.export.plain_solids import Solid

Array = NDArray[np.float64]

_FLOAT, _USHORT = 5126, 5123
_VERTICES, _INDICES = 34962, 34963
_TYPES = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}


@dataclass(slots=True)
class Glb:
    """A scene under construction; `data` gives the finished file."""

    nodes: list[dict[str, object]] = field(default_factory=list)
    roots: list[int] = field(default_factory=list)
    _meshes: list[dict[str, object]] = field(default_factory=list)
    _materials: list[dict[str, object]] = field(default_factory=list)
    _accessors: list[dict[str, object]] = field(default_factory=list)
    _views: list[dict[str, object]] = field(default_factory=list)
    _samplers: list[dict[str, object]] = field(default_factory=list)
    _channels: list[dict[str, object]] = field(default_factory=list)
    _binary: bytearray = field(default_factory=bytearray)
    _times: int = -1

    def material(self, name: str, colour: tuple[float, float, float], metallic: float, roughness: float) -> int:
        """A new material; `colour` linear, each 0–1."""
        surface = {"baseColorFactor": [*colour, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness}
        self._materials.append({"name": name, "pbrMetallicRoughness": surface})
        return len(self._materials) - 1

    def mesh(self, name: str, solid: Solid, material: int) -> int:
        """A new mesh of one solid."""
        attributes = {
            "POSITION": self._accessor(solid.points.astype(np.float32), _VERTICES, bounds=True),
            "NORMAL": self._accessor(solid.normals.astype(np.float32), _VERTICES),
        }
        indices = self._accessor(solid.triangles.astype(np.uint16).reshape(-1, 1), _INDICES)
        primitive = {"attributes": attributes, "indices": indices, "material": material}
        self._meshes.append({"name": name, "primitives": [primitive]})
        return len(self._meshes) - 1

    def node(self, name: str, parent: int | None, mesh: int | None = None) -> int:
        """A new node under `parent`, or at the top."""
        index = len(self.nodes)
        self.nodes.append({"name": name} | ({} if mesh is None else {"mesh": mesh}))
        if parent is None:
            self.roots.append(index)
        else:
            children = self.nodes[parent].setdefault("children", [])
            assert isinstance(children, list)
            children.append(index)
        return index

    def place(self, node: int, translation: Array, rotation: Array) -> None:
        """Where `node` is (3,) and how it is turned, a quaternion x, y, z, w."""
        self.nodes[node] |= {"translation": translation.tolist(), "rotation": rotation.tolist()}

    def clock(self, time_s: Array) -> None:
        """The times of all animation, rising from 0."""
        self._times = self._accessor(time_s.astype(np.float32).reshape(-1, 1), None, bounds=True)

    def animate(self, node: int, path: str, values: Array) -> None:
        """Animate "translation" (n, 3) or "rotation" (n, 4) of `node` at the clock's times."""
        output = self._accessor(values.astype(np.float32), None)
        self._samplers.append({"input": self._times, "output": output, "interpolation": "LINEAR"})
        self._channels.append({"sampler": len(self._samplers) - 1, "target": {"node": node, "path": path}})

    def _accessor(self, values: NDArray[np.generic], target: int | None, bounds: bool = False) -> int:
        self._binary += bytes(-len(self._binary) % 4)
        view: dict[str, object] = {"buffer": 0, "byteOffset": len(self._binary), "byteLength": values.nbytes}
        if target is not None:
            view["target"] = target
        self._views.append(view)
        self._binary += values.tobytes()
        component = _FLOAT if values.dtype == np.float32 else _USHORT
        accessor: dict[str, object] = {
            "bufferView": len(self._views) - 1,
            "componentType": component,
            "count": len(values),
            "type": _TYPES[values.shape[1]],
        }
        if bounds:
            accessor |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        self._accessors.append(accessor)
        return len(self._accessors) - 1

    def data(self, generator: str) -> bytes:
        """The whole file."""
        document = {
            "asset": {"version": "2.0", "generator": generator},
            "scene": 0,
            "scenes": [{"nodes": self.roots}],
            "nodes": self.nodes,
            "meshes": self._meshes,
            "materials": self._materials,
            "accessors": self._accessors,
            "bufferViews": self._views,
            "buffers": [{"byteLength": len(self._binary)}],
        }
        if self._channels:
            document["animations"] = [{"name": "performance", "samplers": self._samplers, "channels": self._channels}]
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        binary = bytes(self._binary) + bytes(-len(self._binary) % 4)
        length = 12 + 8 + len(text) + 8 + len(binary)
        return b"".join(
            (
                struct.pack("<4sII", b"glTF", 2, length),
                struct.pack("<I4s", len(text), b"JSON"),
                text,
                struct.pack("<I4s", len(binary), b"BIN\0"),
                binary,
            )
        )


def quaternions(turn: Array) -> Array:
    """Unit quaternions x, y, z, w (n, 4) of rotations (n, 3, 3), each on the same side as the one before."""
    m = turn
    # the largest of the four is computed from the trace and divides the rest (Shepperd 1978)
    squares = np.stack(
        [
            1 + m[:, 0, 0] - m[:, 1, 1] - m[:, 2, 2],
            1 - m[:, 0, 0] + m[:, 1, 1] - m[:, 2, 2],
            1 - m[:, 0, 0] - m[:, 1, 1] + m[:, 2, 2],
            1 + m[:, 0, 0] + m[:, 1, 1] + m[:, 2, 2],
        ],
        1,
    )
    xy, xz, yz = m[:, 0, 1] + m[:, 1, 0], m[:, 0, 2] + m[:, 2, 0], m[:, 1, 2] + m[:, 2, 1]
    wx, wy, wz = m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0], m[:, 1, 0] - m[:, 0, 1]
    rows = np.stack(
        [
            np.stack([squares[:, 0], xy, xz, wx], 1),
            np.stack([xy, squares[:, 1], yz, wy], 1),
            np.stack([xz, yz, squares[:, 2], wz], 1),
            np.stack([wx, wy, wz, squares[:, 3]], 1),
        ],
        1,
    )
    q = np.take_along_axis(rows, np.argmax(squares, 1)[:, None, None], 1)[:, 0]
    q = q / np.linalg.norm(q, axis=1, keepdims=True)
    flips = np.cumprod(np.where((q[1:] * q[:-1]).sum(1) < 0, -1.0, 1.0))
    q[1:] *= flips[:, None]
    return np.asarray(q)

"""glTF 2.0 in one binary file: nodes, meshes, skins, materials and sampled animation, and nothing else.

Source: Khronos, glTF 2.0 Specification, §§ 3.6 (buffers and accessors), 3.7.3 (skins), 3.11 (animations), 4.4 (GLB
layout).
"""

import json
import struct
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from station.motion.export.plain_solids import Solid

Array = NDArray[np.float64]

_COMPONENTS = {
    np.dtype(np.float32): 5126,
    np.dtype(np.uint16): 5123,
    np.dtype(np.int16): 5122,
    np.dtype(np.uint8): 5121,
}
_VERTICES, _INDICES = 34962, 34963
_TYPES = {1: "SCALAR", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
_INT16 = 32767
MOST_CORNERS = 65535
"""A primitive's corners are counted by 16 bits, whose greatest number is reserved."""


@dataclass(frozen=True, eq=False)
class Primitive:
    """A part of a mesh of one material: a solid, and what its corners bear besides.

    `shade` (v,) 0 … 1 darkens each corner. `joints` (v, 4) are places in the skin's list of joints, `weights` (v, 4)
    255ths that sum to 255 in each row.
    """

    solid: Solid
    material: int
    shade: Array | None = None
    joints: NDArray[np.uint8] | None = None
    weights: NDArray[np.uint8] | None = None


@dataclass(slots=True)
class Glb:
    """A scene under construction; `data` gives the finished file.

    Where it `is_compact` rotations over time are kept in 16 bits a number, within 0.1 mrad.
    """

    is_compact: bool = False

    nodes: list[dict[str, object]] = field(default_factory=list)
    roots: list[int] = field(default_factory=list)
    _meshes: list[dict[str, object]] = field(default_factory=list)
    _materials: list[dict[str, object]] = field(default_factory=list)
    _accessors: list[dict[str, object]] = field(default_factory=list)
    _views: list[dict[str, object]] = field(default_factory=list)
    _skins: list[dict[str, object]] = field(default_factory=list)
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
        return self.mesh_of(name, [Primitive(solid, material)])

    def mesh_of(self, name: str, primitives: Sequence[Primitive]) -> int:
        """A new mesh of several parts, each with at most `MOST_CORNERS` corners."""
        self._meshes.append({"name": name, "primitives": [self._primitive(part) for part in primitives]})
        return len(self._meshes) - 1

    def _primitive(self, part: Primitive) -> dict[str, object]:
        assert len(part.solid.points) <= MOST_CORNERS, "corners are counted by 16 bits"
        attributes = {
            "POSITION": self._accessor(part.solid.points.astype(np.float32), _VERTICES, bounds=True),
            "NORMAL": self._accessor(part.solid.normals.astype(np.float32), _VERTICES),
        }
        if part.shade is not None:
            grey = np.rint(255 * np.repeat(part.shade[:, None], 4, axis=1)).astype(np.uint8)
            grey[:, 3] = 255
            attributes["COLOR_0"] = self._accessor(grey, _VERTICES, normalized=True)
        if part.joints is not None and part.weights is not None:
            attributes["JOINTS_0"] = self._accessor(part.joints, _VERTICES)
            attributes["WEIGHTS_0"] = self._accessor(part.weights, _VERTICES, normalized=True)
        indices = self._accessor(part.solid.triangles.astype(np.uint16).reshape(-1, 1), _INDICES)
        return {"attributes": attributes, "indices": indices, "material": part.material}

    def skin(self, node: int, joints: Sequence[int], bind: Array) -> None:
        """Let nodes pull the mesh of `node`; `bind` (joints, 4, 4) are their places when it was made."""
        back = np.swapaxes(np.linalg.inv(bind), 1, 2).reshape(-1, 16)  # column by column
        self._skins.append(
            {"joints": list(joints), "inverseBindMatrices": self._accessor(back.astype(np.float32), None)}
        )
        self.nodes[node]["skin"] = len(self._skins) - 1

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

    def place(self, node: int, translation: Array, rotation: Array, scale: Array | None = None) -> None:
        """Where `node` is (3,) and how it is turned, a quaternion x, y, z, w; `scale` (3,) along its own axes."""
        self.nodes[node] |= {"translation": translation.tolist(), "rotation": rotation.tolist()}
        if scale is not None:
            self.nodes[node]["scale"] = scale.tolist()

    def clock(self, time_s: Array) -> None:
        """The times (n,) of what is animated from now on, rising from 0 or later."""
        self._times = self._accessor(time_s.astype(np.float32).reshape(-1, 1), None, bounds=True)

    def animate(self, node: int, path: str, values: Array) -> None:
        """Animate "translation" (n, 3) or "rotation" (n, 4) of `node` at the clock's times."""
        if self.is_compact and path == "rotation":
            output = self._accessor(np.rint(values * _INT16).astype(np.int16), None, normalized=True)
        else:
            output = self._accessor(values.astype(np.float32), None)
        self._samplers.append({"input": self._times, "output": output, "interpolation": "LINEAR"})
        self._channels.append({"sampler": len(self._samplers) - 1, "target": {"node": node, "path": path}})

    def _accessor(
        self, values: NDArray[np.generic], target: int | None, bounds: bool = False, normalized: bool = False
    ) -> int:
        self._binary += bytes(-len(self._binary) % 4)
        view: dict[str, object] = {"buffer": 0, "byteOffset": len(self._binary), "byteLength": values.nbytes}
        if target is not None:
            view["target"] = target
        self._views.append(view)
        self._binary += values.tobytes()
        accessor: dict[str, object] = {
            "bufferView": len(self._views) - 1,
            "componentType": _COMPONENTS[values.dtype],
            "count": len(values),
            "type": _TYPES[values.shape[1]],
        }
        if normalized:
            accessor["normalized"] = True
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
        if self._skins:
            document["skins"] = self._skins
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

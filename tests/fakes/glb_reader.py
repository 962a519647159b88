"""A reader of .glb files after the specification, which knows nothing of ours: arrays, nodes, and where they move.

Source: Khronos, glTF 2.0 Specification, §§ 3.5 (nodes), 3.6.2 (accessors), 3.7.3 (skins), 3.11 and appendix C
(animation), 4.4 (GLB).
"""

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_TYPES = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_COMPONENTS: dict[int, tuple[str, float]] = {
    5121: ("<u1", 255.0),
    5122: ("<i2", 32767.0),
    5123: ("<u2", 65535.0),
    5126: ("<f4", 1.0),
}


class GlbReader:
    """One file; what the format forbids fails an assertion."""

    def __init__(self, data: bytes) -> None:
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON"
        assert size % 4 == 0
        self.document: dict[str, Any] = json.loads(data[20 : 20 + size])
        binary, kind = struct.unpack_from("<I4s", data, 20 + size)
        assert kind == b"BIN\0"
        self._binary = data[28 + size : 28 + size + binary]
        assert self.document["buffers"] == [{"byteLength": len(self._binary)}]
        self.nodes: list[dict[str, Any]] = self.document["nodes"]
        self._parents = {child: k for k, node in enumerate(self.nodes) for child in node.get("children", ())}
        self._names = {node["name"]: k for k, node in enumerate(self.nodes)}
        assert len(self._names) == len(self.nodes), "two nodes of one name"
        self._tracks: dict[tuple[int, str], tuple[Array, Array]] = {}
        for animation in self.document.get("animations", ()):
            for channel in animation["channels"]:
                sampler = animation["samplers"][channel["sampler"]]
                assert sampler["interpolation"] == "LINEAR"
                place = channel["target"]["node"], channel["target"]["path"]
                assert place not in self._tracks, "two tracks for one thing"
                times, values = self.array(sampler["input"])[:, 0], self.array(sampler["output"])
                assert len(times) == len(values)
                assert times[0] >= 0
                assert (np.diff(times) > 0).all()
                self._tracks[place] = times, values

    def array(self, index: int) -> Array:
        """The numbers of an accessor, (count, components), normalized ones as the fractions that they mean."""
        accessor = self.document["accessors"][index]
        view = self.document["bufferViews"][accessor["bufferView"]]
        kind, full = _COMPONENTS[accessor["componentType"]]
        width, start = _TYPES[accessor["type"]], view["byteOffset"]
        size = np.dtype(kind).itemsize
        assert start % size == 0
        assert width * size % 4 == 0 or accessor["type"] == "SCALAR", "rows begin at whole words"
        assert view["byteLength"] == accessor["count"] * width * size
        assert start + view["byteLength"] <= len(self._binary)
        raw = np.frombuffer(self._binary, kind, accessor["count"] * width, start).reshape(-1, width)
        values = raw.astype(np.float64)
        if "min" in accessor:
            assert (values.min(axis=0) == accessor["min"]).all()
            assert (values.max(axis=0) == accessor["max"]).all()
        return np.maximum(values / full, -1.0) if accessor.get("normalized") else values

    def times_of(self, name: str) -> Array:
        """The times of all keyframes of a node, rising."""
        node = self._names[name]
        return np.unique(np.concatenate([times for (n, _), (times, _) in self._tracks.items() if n == node]))

    def has(self, name: str) -> bool:
        """Whether there is such a node."""
        return name in self._names

    def world(self, name: str, time_s: float) -> Array:
        """The matrix (4, 4) that carries a node's own points to the scene's at a time."""
        return self._world(self._names[name], time_s)

    def _world(self, node: int, time_s: float) -> Array:
        own = self._local(node, time_s)
        return self._world(self._parents[node], time_s) @ own if node in self._parents else own

    def _local(self, node: int, time_s: float) -> Array:
        said = self.nodes[node]
        m = np.eye(4)
        turn = self._at(node, "rotation", said.get("rotation", [0, 0, 0, 1]), time_s)
        m[:3, :3] = turned(turn / np.linalg.norm(turn)) * said.get("scale", [1, 1, 1])
        m[:3, 3] = self._at(node, "translation", said.get("translation", [0, 0, 0]), time_s)
        return m

    def _at(self, node: int, path: str, rest: list[float], time_s: float) -> Array:
        if (node, path) not in self._tracks:
            return np.array(rest, np.float64)
        times, values = self._tracks[node, path]
        k = int(np.clip(np.searchsorted(times, time_s, side="right") - 1, 0, len(times) - 2))
        share = float(np.clip((time_s - times[k]) / (times[k + 1] - times[k]), 0, 1))
        if path == "rotation":
            return _slerp(values[k], values[k + 1], share)
        return np.asarray(values[k] + share * (values[k + 1] - values[k]))

    def skinned(self, node_name: str, time_s: float) -> list[Array]:
        """The corners (v, 3) of every part of a skinned mesh, in the scene at a time."""
        node = self.nodes[self._names[node_name]]
        skin = self.document["skins"][node["skin"]]
        back = self.array(skin["inverseBindMatrices"]).reshape(-1, 4, 4).swapaxes(1, 2)
        joints = np.stack([self._world(joint, time_s) for joint in skin["joints"]]) @ back
        found = []
        for part in self.document["meshes"][node["mesh"]]["primitives"]:
            places = part["attributes"]
            points, pulled, by = (self.array(places[name]) for name in ("POSITION", "WEIGHTS_0", "JOINTS_0"))
            m = np.einsum("vk,vkij->vij", pulled, joints[by.astype(int)])
            found.append(np.einsum("vij,vj->vi", m[:, :3, :3], points) + m[:, :3, 3])
        return found


def turned(q: Array) -> Array:
    """The rotation (3, 3) of a unit quaternion x, y, z, w."""
    x, y, z, w = q.tolist()
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _slerp(a: Array, b: Array, share: float) -> Array:
    """Appendix C.4: spherical linear interpolation along the shorter way."""
    dot = float(a @ b)
    b, dot = (-b, -dot) if dot < 0 else (b, dot)
    angle = np.arccos(min(dot, 1.0))
    if angle < 1e-6:
        return np.asarray(a + share * (b - a))
    return np.asarray((np.sin((1 - share) * angle) * a + np.sin(share * angle) * b) / np.sin(angle))

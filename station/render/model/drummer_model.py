"""The drummer who plays a score as one .glb: the figure and the kit of the pictures, with few keyframes.

Nodes bear the names of pieces (`station.core.pieces.word`) and bones, and stand under one that turns the station's
axes to glTF's: y up, the figure faces +z, metres. At the time of every stroke there is a keyframe of the limb that
plays it and of the piece that is struck. Time 0 of the animation is the start that is asked for.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import word
from station.motion.drummer import Drummer
from station.motion.export.glb_file import Glb, Primitive, quaternions
from station.motion.export.joint_tree import TURN
from station.motion.kinematics.pose import Pose
from station.motion.motion_plan import holds
from station.render.figure.bones import BODY_BONES
from station.render.figure.skeleton import Skeleton
from station.render.geometry.transforms import Matrix
from station.render.gpu.scene_cache import cached_body, cached_kit
from station.render.kit.held_meshes import HELD_PARTS
from station.render.kit.instrument_meshes import Detail
from station.render.kit.kit_rig import WORLD
from station.render.model.model_motion import STICK_OF, MovingGroup, NodeMotion, moving_groups
from station.render.model.model_shapes import (
    Materials,
    faces_of_bones,
    resting_shapes,
    rigid_primitives,
    skin_primitives,
    with_still_face,
)
from station.render.model.sparse_keys import sparse_keys

Array = NDArray[np.float64]

DETAIL, CELL = Detail(32, hardware=True, grooves=False), 2.5
"""How finely the kit and the figure are cut: a browser's picture is small, and a megabyte of corners is enough."""
_STEP_S = 1 / 60
_NEAR = {"translation": 0.0015, "rotation": 0.002}
"""Straight lines between keyframes stay so near to the motion, in metres and in a number of a quaternion (0.23°), which
is a pixel or two; our choice."""
_APART_S = 0.001
"""Instants that are nearer to a stroke than that are left out."""
_STILL = 1e-5
_TRIES = 12


def model_bytes(drummer: Drummer, start_s: float, end_s: float) -> bytes:
    """The file's bytes, its motion from `start_s` to `end_s` of the score."""
    model = _Model(drummer)
    time_s = _instants(drummer, start_s, end_s)
    for group in moving_groups(drummer, model.rig, time_s):
        model.move(group, time_s)
    model.dress(drummer)
    return model.scene.data("drum station")


def _instants(drummer: Drummer, start_s: float, end_s: float) -> Array:
    """When the motion is looked at: evenly, and at every stroke."""
    even = np.linspace(start_s, end_s, max(2, round((end_s - start_s) / _STEP_S) + 1))
    onset_s = np.unique(drummer.score.onset_s)
    onset_s = onset_s[(onset_s > start_s) & (onset_s < end_s)]
    if not len(onset_s):
        return even
    after = np.searchsorted(onset_s, even)
    gap = np.minimum(
        np.abs(even - onset_s[np.minimum(after, len(onset_s) - 1)]), np.abs(even - onset_s[np.maximum(after - 1, 0)])
    )
    gap[[0, -1]] = np.inf
    return np.union1d(even[gap > _APART_S], onset_s)


class _Model:
    """The scene under construction, and the nodes in it by their names."""

    def __init__(self, drummer: Drummer) -> None:
        self.scene = Glb(is_compact=True)
        self.rig = cached_kit(drummer.kit, DETAIL)
        self._materials = Materials(self.scene, drummer.figure.look.colours)
        self._stage = self.scene.node("stage", None)
        self.scene.place(self._stage, np.zeros(3), quaternions(TURN[None])[0])
        self._nodes: dict[str, int] = {}
        self._shapes = resting_shapes(self.rig, holds(drummer.style))
        self._lengths = {name: _length_share(drummer, side) for side, name in enumerate(STICK_OF.values())}
        self._stand(drummer)

    def _stand(self, drummer: Drummer) -> None:
        """Add what stands: the hardware, and a node for each drum."""
        rig, first = self.rig, self.rig.pedals.right_board
        hung = rig.pedal_rig.matrices(drummer.pose(0.0))
        still = self._parts([WORLD], np.eye(4))
        for strap in (rig.pedals.kick_strap, rig.pedals.slave_strap, rig.pedals.hat_strap):
            still += self._parts([strap], np.linalg.inv(hung[strap - first]))
        self.scene.node("hardware", self._stage, self.scene.mesh_of("hardware", still))
        for piece, bone in rig.piece_bones.items():
            if word(piece) not in self._shapes:
                self.scene.node(word(piece), self._stage, self._mesh(word(piece), [bone], np.eye(4)))

    def _parts(self, bones: Sequence[int], place: Matrix) -> list[Primitive]:
        return rigid_primitives(self.rig.mesh, faces_of_bones(self.rig.mesh, bones), self._materials, place)

    def _mesh(self, name: str, bones: Sequence[int], place: Matrix) -> int | None:
        parts = self._parts(bones, place)
        return self.scene.mesh_of(name, parts) if parts else None

    def move(self, group: MovingGroup, time_s: Array) -> None:
        """Add the nodes of a group, and their motion at the few of the times (n,) that it takes."""
        for node in group.nodes:
            self._add(node)
        channels = [channel for node in group.nodes for channel in _channels(node)]
        if not channels:
            return
        seen = group.strikes_s[(group.strikes_s >= time_s[0]) & (group.strikes_s <= time_s[-1])]
        scaled = np.concatenate([channel.values / _NEAR[channel.path] for channel in channels], axis=1)
        keys = sparse_keys(time_s, scaled, np.searchsorted(time_s, seen))
        self.scene.clock(time_s[keys] - time_s[0])
        for channel in channels:
            self.scene.animate(self._nodes[channel.node], channel.path, channel.values[keys])

    def _add(self, node: NodeMotion) -> None:
        parent = self._stage if node.parent is None else self._nodes[node.parent]
        mesh = self._mesh(node.name, *self._shapes[node.name]) if node.name in self._shapes else None
        self._nodes[node.name] = self.scene.node(node.name, parent, mesh)
        share = self._lengths.get(node.name)
        scale = None if share is None else np.array([1.0, 1.0, share])
        self.scene.place(self._nodes[node.name], node.place_m[0], node.turn[0], scale)

    def dress(self, drummer: Drummer) -> None:
        """Hang the figure's skin on its bones."""
        skeleton = Skeleton(drummer.figure)
        skin = with_still_face(cached_body(drummer.figure, CELL), skeleton, _awake(drummer))
        mesh = self.scene.mesh_of("figure", skin_primitives(skin, self._materials))
        joints = [self._nodes[bone.name.lower()] for bone in BODY_BONES]
        self.scene.skin(self.scene.node("figure", None, mesh), joints, skeleton.frames)


@dataclass(frozen=True, eq=False)
class _Channel:
    """What moves of a node: its `path` as glTF has it, and the `values` (n, 3) or (n, 4)."""

    node: str
    path: str
    values: Array


def _channels(node: NodeMotion) -> Iterator[_Channel]:
    for path, values in (("translation", node.place_m), ("rotation", node.turn)):
        if np.ptp(values, axis=0).max() > _STILL:
            yield _Channel(node.name, path, values)


def _length_share(drummer: Drummer, side: int) -> float | None:
    """How many times as long as it was made a hand holds what it holds; None of a bare hand."""
    hold = holds(drummer.style)[side]
    made = HELD_PARTS.get(hold.held.name)
    return None if made is None else hold.length_m(drummer.figure) / made[1]


def _awake(drummer: Drummer) -> Pose:
    """A pose at a stroke, the fingers about the sticks, in which the eyes are open."""
    onset_s = drummer.score.onset_s
    tried = onset_s[:: max(1, len(onset_s) // _TRIES)].tolist() or [0.0]
    return max((drummer.pose(at_s) for at_s in tried), key=lambda pose: pose.eyes)

"""Draws one kit and who plays it with OpenGL: what `scene` puts into the room.

Two kinds of geometry share one palette of bone matrices: rigid (the kit) and skinned (the figure). All of it is
uploaded once; a frame uploads the palette alone. Cameras are the room's; all else is in the kit's own axes, whose
`place` carries it into the room, its spotlight with it.
"""

from collections.abc import Iterable
from functools import cached_property, lru_cache

import moderngl
import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kinematics.figure import Figure
from station.motion.kit.kit import Kit
from station.render.camera import Camera
from station.render.figure.skeleton import Skeleton
from station.render.geometry.transforms import Matrix, gl_bytes
from station.render.gpu.bone_palette import BoneFrame, BonePalette
from station.render.gpu.edge_smoothing import Tiles, balls_of, tiles_of
from station.render.gpu.scene_cache import cached_kit
from station.render.gpu.scene_parts import SceneParts, write
from station.render.kit.kit_rig import KitRig
from station.render.place import ALONE, Place
from station.render.quality import Quality

_NEARER = (-1.0, -4.0)
"""Depth offset of what is drawn over the very same surface once more."""
_NEAR_M = 0.15
"""What is nearer to the eye than this is taken to be so far away: it fills the picture all the same."""
_ALONG = 9
"""Places on each edge of what moves: 10 cm apart on the longest."""
_DARK = 0.003
"""A glow below this is not seen: less than one of 255 steps on the screen."""

Viewport = tuple[int, int, int, int]
"""x, y, width, height in pixels from the lower left."""


class PlayerScene:
    """One kit and one figure at a place of the room, to be drawn at one quality: `set` says how they are.

    `scene` says where it draws to.
    """

    def __init__(self, ctx: moderngl.Context, kit: Kit, figure: Figure, quality: Quality, place: Place = ALONE) -> None:
        self._ctx = ctx
        self._place = place
        self.rig: KitRig = cached_kit(kit, quality.detail)
        self.skeleton = Skeleton(figure)
        self._bones = BonePalette(ctx, self.rig, self.skeleton)
        self.parts = SceneParts(ctx, self.rig, figure, quality)
        self.parts.ghost.skin.program["first_bone"] = self._bones.double
        self.parts.ghost.rigid.program["first_bone"] = self._bones.double_sticks - self.rig.sticks.start
        self.frame = BoneFrame()
        self._lit: dict[
            BoneFrame, set[Piece]
        ] = {}  # what was drawn glowing already, of frames that wait for `draw_glow`
        self._shadow_is_cast = False
        self._resting_shadow: bool | None = None
        self._light = 1.0

    @property
    def shows_figure(self) -> bool:
        """Whether the drummer is there."""
        return self.frame.pose is not None

    def set(self, frame: BoneFrame) -> None:
        """Say what the next pictures show; to say the same again costs nothing."""
        if frame is self.frame:
            return
        self.frame = frame
        self._bones.set(frame)
        self._shadow_is_cast = False
        self.light(frame.light)

    def light(self, share: float) -> None:
        """Stand in so much light, 0–1."""
        if share != self._light:
            self._light = share
            self.parts.light(share)

    # --- what is drawn ------------------------------------------------------------------------------------------------

    def cast_shadow(self) -> None:
        """Draw the shadow map of the frame, if it was not."""
        if not self._shadow_is_cast:
            self.draw_shadows()

    def draw(self, camera: Camera, viewport: Viewport) -> None:
        """Draw kit and figure pixel by pixel."""
        self._bones.use()
        self.parts.use_shadow()
        self._aim(camera, viewport, *self.picture_parts)
        for part in self.picture_parts:
            part.render()

    def rest(self) -> None:
        """Cast the shadow of a figure at rest."""
        if self._resting_shadow is not self.shows_figure:
            self._draw_resting_shadows()

    def draw_still(self, camera: Camera, viewport: Viewport, is_rough: bool) -> None:
        """Draw the hardware and the drums at rest."""
        self._bones.use_rest()
        self.parts.use_shadow()
        rigid = self.parts.quick.rigid if is_rough else self.parts.still_rigid
        self._aim(camera, viewport, rigid)
        _render(rigid, slice(0, self.rig.still_faces))

    def draw_moving(self, camera: Camera, viewport: Viewport) -> None:
        """Draw what moves over what `draw_still` has left there."""
        self._bones.use()
        rigid, skin = self.parts.quick.rigid, self.parts.quick.skin
        self._aim(camera, viewport, rigid, skin)
        if self.shows_figure:
            skin.render()
        _render(rigid, slice(self.rig.still_faces, len(self.rig.mesh.faces)))
        self._lit[self.frame] = {piece for piece in self._glowing if self._faces(piece).start >= self.rig.still_faces}

    def moving_tiles(self, camera: Camera, viewport: Viewport) -> Tiles:
        """Where in `viewport` all that moves is seen."""
        left, low, width, height = viewport
        points, reach = self._moving_points()
        clip = np.column_stack([points, np.ones(len(points))]) @ self._clip(camera, width / height).T
        deep = np.maximum(clip[:, 3:], _NEAR_M)
        middle = (clip[:, :2] / deep + 1) / 2 * [width, height] + [left, low]
        nearest = np.maximum(clip[:, 3] - reach, _NEAR_M)
        return tiles_of(middle, reach * height / (2 * np.tan(camera.fov_rad / 2) * nearest), viewport)

    def _moving_points(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Points (n, 3), and how far (n,) from the nearest all lies that moves."""
        bone, middle, reach = self._moving
        bones = slice(0, None if self.shows_figure else np.searchsorted(bone, self._bones.figure))
        matrices = self._bones.matrices[bone[bones]]
        return np.einsum("nij,nj->ni", matrices[:, :3], middle[bones]), reach[bones] * matrices[:, 3, 3]

    @cached_property
    def _moving(self) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]:
        """Balls round all that moves: their bones in rising order, their middles (n, 4) in rest, their radii."""
        mesh, skin = self.rig.mesh, self.parts.skin
        edges = mesh.faces[self.rig.still_faces :][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        one, other = (mesh.position[edges[:, k]] for k in (0, 1))
        along = one + np.linspace(0, 1, _ALONG)[:, None, None] * (other - one)  # a rod has corners at its ends alone
        bone = np.tile(mesh.bone[edges[:, 0]].astype(int), _ALONG)
        own = self._bones.figure + skin.bones[:, 0].astype(int)
        return balls_of(np.concatenate([bone, own]), np.concatenate([along.reshape(-1, 3), skin.position]))

    def draw_glow(self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport) -> None:
        """Lay over what `draw_moving` has drawn what glows, and the double; what has begun to glow since then too."""
        self._bones.use()
        self._aim(camera, viewport, self.parts.glow)
        self._over_the_same()
        lit = self._lit.pop(self.frame, None)
        if lit is None:  # a frame that is newer than what was drawn
            lit = set().union(*self._lit.values())
            self._lit.clear()
        for piece in self._glowing:
            if piece not in lit:
                _render(self.parts.glow, self._faces(piece))
        self.draw_double(target, camera, viewport)

    def draw_double(self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport) -> None:
        """Draw the limbs and sticks of the student's double: first their depth, so that their outside alone is seen."""
        if self.frame.double is None:
            return
        skin, rigid = self.parts.ghost.skin, self.parts.ghost.rigid
        first, last = (self.rig.faces_of[bone] for bone in (self.rig.sticks[0], self.rig.sticks[-1]))
        self._bones.use()
        self._aim(camera, viewport, skin, rigid)
        self._over_the_same()
        for seen in (False, True):
            target.color_mask = seen, seen, seen, seen
            skin.render()
            _render(rigid, slice(first.start, last.stop))

    @property
    def _glowing(self) -> list[Piece]:
        return [piece for piece, colour in self.frame.glow.items() if np.max(colour) > _DARK]

    def _faces(self, piece: Piece) -> slice:
        return self.rig.faces_of[self.rig.piece_bones[piece]]

    def draw_shadows(self) -> None:
        """Draw the shadow map of the frame."""
        self._bones.use()
        self._begin_shadows()
        self.parts.rigid_depth.render()
        if self.shows_figure:
            self.parts.skin_depth.render()
        self._shadow_is_cast, self._resting_shadow = True, None

    def _draw_resting_shadows(self) -> None:
        self._bones.use_rest()
        self._begin_shadows()
        _render(self.parts.rigid_depth, slice(0, self.rig.faces_of[self.rig.sticks.start].start))
        if self.shows_figure:
            self.parts.resting_depth.render()
        self._resting_shadow, self._shadow_is_cast = self.shows_figure, False

    @property
    def picture_parts(self) -> tuple[moderngl.VertexArray, ...]:
        """What the picture pass draws of kit and figure: the figure only where there is one."""
        return (self.parts.solid.skin, self.parts.solid.rigid) if self.shows_figure else (self.parts.solid.rigid,)

    # --- OpenGL's state -----------------------------------------------------------------------------------------------

    def _begin_shadows(self) -> None:
        ctx = self._ctx
        ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        ctx.front_face = "ccw"
        self.parts.shadow_buffer.use()
        self.parts.shadow_buffer.clear(depth=1.0)

    def _over_the_same(self) -> None:
        """Blend over surfaces that are there already."""
        self._ctx.enable(moderngl.BLEND)
        self._ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self._ctx.depth_func = "<="
        self._ctx.polygon_offset = _NEARER

    def _aim(self, camera: Camera, viewport: Viewport, *parts: moderngl.VertexArray) -> None:
        aim(parts, self._clip(camera, viewport[2] / viewport[3]), self._place.own(camera.eye))

    def _clip(self, camera: Camera, aspect: float) -> Matrix:
        """Own axes to clip space."""
        return clip_of(camera, aspect) if self._place is ALONE else clip_of(camera, aspect) @ self._place.matrix


def aim(parts: Iterable[moderngl.VertexArray], clip: Matrix, eye: tuple[float, float, float]) -> None:
    """Let `parts` be seen from `eye`, `clip` carrying their axes to clip space."""
    projection = gl_bytes(clip)
    for part in parts:
        write(part.program, "view_projection", projection)
        if "eye" in part.program:
            part.program["eye"] = eye


@lru_cache(maxsize=4)
def clip_of(camera: Camera, aspect: float) -> Matrix:
    """The room to clip space; a camera mostly stands still."""
    return camera.matrix(aspect)


def _render(part: moderngl.VertexArray, faces: slice) -> None:
    """Draw some of a part's faces."""
    part.render(first=3 * faces.start, vertices=3 * (faces.stop - faces.start))

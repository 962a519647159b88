"""Draws the room, the kit and the drummer with OpenGL: a shadow pass and a picture pass.

Two kinds of geometry share one palette of bone matrices: rigid (kit, room) and skinned (the figure). All of it is
uploaded once; a frame uploads the palette alone.

Where the processor does all the work, at the lowest quality, a picture is made in two layers instead: what hardly ever
moves is drawn once for each camera with the figure's resting shadow (`draw_still`), whoever draws keeps that picture
with its depth, and each frame adds what moves, lit corner by corner (`draw_moving`), and what glows (`draw_glow`).
"""

from functools import lru_cache

import moderngl
import numpy as np

from station.core.pieces import Piece
from station.motion.kinematics.figure import Figure
from station.motion.kit.kit import Kit
from station.render.camera import Camera
from station.render.figure.skeleton import Skeleton
from station.render.geometry.transforms import gl_bytes
from station.render.gpu.bone_palette import BoneFrame, BonePalette
from station.render.gpu.scene_cache import cached_kit
from station.render.gpu.scene_parts import SceneParts, write
from station.render.kit.kit_rig import KitRig
from station.render.quality import Quality

_NEARER = (-1.0, -4.0)
"""Depth offset of what is drawn over the very same surface once more."""
_DARK = 0.003
"""A glow below this is not seen: less than one of 255 steps on the screen."""

Viewport = tuple[int, int, int, int]
"""x, y, width, height in pixels from the lower left."""


class Scene:
    """One kit and one figure, ready to be drawn at one quality: `set` says how, then draw from any camera."""

    def __init__(self, ctx: moderngl.Context, kit: Kit, figure: Figure, quality: Quality) -> None:
        self._ctx = ctx
        self.quality = quality
        self.rig: KitRig = cached_kit(kit, quality.detail)
        self.skeleton = Skeleton(figure)
        self._bones = BonePalette(ctx, self.rig, self.skeleton)
        self._parts = SceneParts(ctx, self.rig, figure, quality)
        self._parts.ghost.skin.program["first_bone"] = self._bones.double
        self._parts.ghost.rigid.program["first_bone"] = self._bones.double_sticks - self.rig.sticks.start
        self._frame = BoneFrame()
        self._lit: dict[
            BoneFrame, set[Piece]
        ] = {}  # what was drawn glowing already, of frames that wait for `draw_glow`
        self._shadow_is_cast = False
        self._resting_shadow: bool | None = None

    @property
    def triangles(self) -> int:
        """How many triangles a picture draws, shadows apart."""
        return self._parts.triangles

    @property
    def shows_figure(self) -> bool:
        """Whether the drummer is there."""
        return self._frame.pose is not None

    # --- what is drawn ------------------------------------------------------------------------------------------------

    def set(self, frame: BoneFrame) -> None:
        """Say what the next pictures show; to say the same again costs nothing."""
        if frame is self._frame:
            return
        self._frame = frame
        self._bones.set(frame)
        self._shadow_is_cast = False

    def draw(self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport) -> None:
        """Draw everything into `viewport` of `target`; more pictures of one frame cast its shadow once."""
        self._bones.use()
        if not self._shadow_is_cast:
            self.draw_shadows()
        self._begin(target, viewport, camera)
        target.clear(depth=1.0, viewport=viewport)
        self._aim(camera, viewport, *self.picture_parts)
        for part in self.picture_parts:
            part.render()
        self._draw_double(target, camera, viewport)
        self._end()

    def draw_still(
        self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport, is_rough: bool = False
    ) -> None:
        """Draw what hardly ever moves: the room, the hardware, the drums at rest, and the shadow of a figure at rest.

        A rough picture, for a camera that moves, takes half the time.
        """
        self._bones.use_rest()
        if self._resting_shadow is not self.shows_figure:
            self._draw_resting_shadows()
        self._begin(target, viewport, camera)
        target.clear(depth=1.0, viewport=viewport)
        parts = self._parts
        rigid, room = (parts.quick.rigid, parts.room) if is_rough else (parts.still_rigid, parts.still_room)
        parts.sharpen(is_rough)
        self._aim(camera, viewport, rigid, *room)
        _render(rigid, slice(0, self.rig.still_faces))
        for part in room:
            part.render()
        self._end()

    def _draw_resting_shadows(self) -> None:
        self._begin_shadows()
        _render(self._parts.rigid_depth, slice(0, self.rig.faces_of[self.rig.sticks.start].start))
        if self.shows_figure:
            self._parts.resting_depth.render()
        self._resting_shadow = self.shows_figure

    def draw_moving(self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport) -> None:
        """Draw what moves over what `draw_still` has left there, its depth included."""
        self._bones.use()
        self._begin(target, viewport, camera)
        rigid, skin = self._parts.quick.rigid, self._parts.quick.skin
        self._aim(camera, viewport, rigid, skin)
        if self.shows_figure:
            skin.render()
        _render(rigid, slice(self.rig.still_faces, len(self.rig.mesh.faces)))
        self._lit[self._frame] = {piece for piece in self._glowing if self._faces(piece).start >= self.rig.still_faces}
        self._end()

    def draw_glow(self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport) -> None:
        """Lay over what `draw_moving` has drawn what glows, and the double; what has begun to glow since then too."""
        self._bones.use()
        self._begin(target, viewport, camera)
        self._aim(camera, viewport, self._parts.glow)
        self._over_the_same()
        lit = self._lit.pop(self._frame, None)
        if lit is None:  # a frame that is newer than what was drawn
            lit = set().union(*self._lit.values())
            self._lit.clear()
        for piece in self._glowing:
            if piece not in lit:
                _render(self._parts.glow, self._faces(piece))
        self._draw_double(target, camera, viewport)
        self._end()

    @property
    def _glowing(self) -> list[Piece]:
        return [piece for piece, colour in self._frame.glow.items() if np.max(colour) > _DARK]

    def _faces(self, piece: Piece) -> slice:
        return self.rig.faces_of[self.rig.piece_bones[piece]]

    def draw_shadows(self) -> None:
        """Draw the shadow map of the frame."""
        self._begin_shadows()
        self._parts.rigid_depth.render()
        if self.shows_figure:
            self._parts.skin_depth.render()
        self._shadow_is_cast, self._resting_shadow = True, None

    @property
    def picture_parts(self) -> tuple[moderngl.VertexArray, ...]:
        """What the picture pass draws: the figure, then nearest first, so that what is hidden is not shaded."""
        parts = (self._parts.solid.skin, self._parts.solid.rigid, *self._parts.room)
        return parts if self.shows_figure else parts[1:]

    def _draw_double(self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport) -> None:
        """Draw the limbs and sticks of the student's double: first their depth, so that their outside alone is seen."""
        if self._frame.double is None:
            return
        skin, rigid = self._parts.ghost.skin, self._parts.ghost.rigid
        first, last = (self.rig.faces_of[bone] for bone in (self.rig.sticks[0], self.rig.sticks[-1]))
        self._aim(camera, viewport, skin, rigid)
        self._over_the_same()
        for seen in (False, True):
            target.color_mask = seen, seen, seen, seen
            skin.render()
            _render(rigid, slice(first.start, last.stop))

    # --- OpenGL's state -----------------------------------------------------------------------------------------------

    def _begin_shadows(self) -> None:
        ctx = self._ctx
        ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        ctx.front_face = "ccw"
        self._parts.shadow_buffer.use()
        self._parts.shadow_buffer.clear(depth=1.0)

    def _begin(self, target: moderngl.Framebuffer, viewport: Viewport, camera: Camera) -> None:
        ctx = self._ctx
        ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        target.use()
        ctx.viewport = ctx.scissor = viewport
        ctx.front_face = "cw" if camera.mirrored else "ccw"
        self._parts.use_textures()

    def _over_the_same(self) -> None:
        """Blend over surfaces that are there already."""
        self._ctx.enable(moderngl.BLEND)
        self._ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self._ctx.depth_func = "<="
        self._ctx.polygon_offset = _NEARER

    def _end(self) -> None:
        self._ctx.depth_func = "<"
        self._ctx.polygon_offset = 0.0, 0.0
        self._ctx.scissor = None
        self._ctx.front_face = "ccw"

    def _aim(self, camera: Camera, viewport: Viewport, *parts: moderngl.VertexArray) -> None:
        projection = _projection(camera, viewport[2] / viewport[3])
        for part in parts:
            write(part.program, "view_projection", projection)
            if "eye" in part.program:
                part.program["eye"] = camera.eye


@lru_cache(maxsize=4)
def _projection(camera: Camera, aspect: float) -> bytes:
    """World to clip as the shaders want it; a camera mostly stands still."""
    return gl_bytes(camera.matrix(aspect))


def _render(part: moderngl.VertexArray, faces: slice) -> None:
    """Draw some of a part's faces."""
    part.render(first=3 * faces.start, vertices=3 * (faces.stop - faces.start))

"""Draws the room, the kits and the drummers with OpenGL: a shadow pass for each kit and a picture pass.

One drummer plays in the room's middle, or two side by side, each in a light of their own; a crowd may stand behind.

Where the processor does all the work, at the lowest quality, a picture is made in two layers instead: what hardly ever
moves is drawn once for each camera with the figures' resting shadows (`draw_still`), whoever draws keeps that picture
with its depth, and each frame adds what moves, lit corner by corner (`draw_moving`), and what glows (`draw_glow`).
"""

from collections.abc import Iterator
from contextlib import contextmanager

import moderngl
import numpy as np

from station.motion.kinematics.figure import Figure
from station.motion.kit.kit import Kit
from station.render.camera import Camera
from station.render.gpu.bone_palette import BoneFrame
from station.render.gpu.crowd import Crowd
from station.render.gpu.edge_smoothing import Tiles
from station.render.gpu.light_layers import Lights
from station.render.gpu.room_parts import RoomParts
from station.render.place import ALONE, TWO
from station.render.player_scene import PlayerScene, Viewport, aim, clip_of
from station.render.quality import Quality


class Scene:
    """One kit and one figure, or two, ready to be drawn at one quality: `set` says how, then draw from any camera."""

    def __init__(
        self,
        ctx: moderngl.Context,
        kit: Kit,
        figure: Figure,
        quality: Quality,
        rival: tuple[Kit, Figure] | None = None,
    ) -> None:
        self._ctx = ctx
        self.quality = quality
        players = ((kit, figure),) if rival is None else ((kit, figure), rival)
        places = (ALONE,) if rival is None else TWO
        self._players = [
            PlayerScene(ctx, *player, quality, place) for player, place in zip(players, places, strict=True)
        ]
        self.rig, self.skeleton = self._players[0].rig, self._players[0].skeleton
        self._room = RoomParts(ctx, list(zip((k for k, _ in players), places, strict=True)), quality)
        self._crowd = Crowd(ctx) if rival is not None else None

    @property
    def triangles(self) -> int:
        """How many triangles a picture draws, shadows apart."""
        return sum(player.parts.triangles for player in self._players)

    @property
    def shows_figure(self) -> bool:
        """Whether the drummer is there, or the first of two."""
        return self._players[0].shows_figure

    # --- what is drawn ------------------------------------------------------------------------------------------------

    def set(self, frame: BoneFrame) -> None:
        """Say what the next pictures show; to say the same again costs nothing."""
        self._players[0].set(frame)
        if len(self._players) > 1 and frame.rival is not None:
            self._players[1].set(frame.rival)
            self._light((frame.light, frame.rival.light))

    def _light(self, lights: Lights) -> None:
        for player, light in zip(self._players, lights, strict=True):
            player.light(light)
        self._room.light(lights)

    def draw(self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport) -> None:
        """Draw everything into `viewport` of `target`; more pictures of one frame cast its shadows once."""
        for player in self._players:
            player.cast_shadow()
        with self._drawing(target, camera, viewport):
            target.clear(depth=1.0, viewport=viewport)
            for player in self._players:  # nearest first, so that what is hidden is not shaded
                player.draw(camera, viewport)
            self._draw_room(self._room.parts, camera, viewport)
            self._draw_crowd(target, camera, viewport)
            for player in self._players:
                player.draw_double(target, camera, viewport)

    def draw_still(
        self,
        target: moderngl.Framebuffer,
        camera: Camera,
        viewport: Viewport,
        is_rough: bool = False,
        lights: Lights | None = None,
    ) -> None:
        """Draw what hardly ever moves: the room, the hardware, the drums at rest, and shadows of figures at rest.

        A rough picture, for a camera that moves, takes half the time. `lights` are those of two drummers, None as they
        are.
        """
        for player in self._players:
            player.rest()
        if lights is not None:
            self._light(lights)
        with self._drawing(target, camera, viewport):
            target.clear(depth=1.0, viewport=viewport)
            self._room.sharpen(is_rough)
            target.color_mask = True, True, True, False  # only what moves marks its pixels
            for player in self._players:
                player.draw_still(camera, viewport, is_rough)
            target.color_mask = True, True, True, True
            self._draw_room(self._room.parts if is_rough else self._room.still, camera, viewport)
        if lights is not None:
            self._light(self._lights)

    @property
    def _lights(self) -> Lights:
        first, second = (player.frame.light for player in self._players)
        return first, second

    def draw_moving(self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport) -> None:
        """Draw what moves over what `draw_still` has left there, its depth included."""
        with self._drawing(target, camera, viewport):
            self._draw_crowd(target, camera, viewport)
            for player in self._players:
                player.draw_moving(camera, viewport)

    def moving_tiles(self, camera: Camera, viewport: Viewport) -> Tiles:
        """Where in `viewport` all that moves is seen; the crowd's edges are soft by themselves."""
        return np.concatenate([player.moving_tiles(camera, viewport) for player in self._players])

    def draw_glow(self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport) -> None:
        """Lay over what `draw_moving` has drawn what glows, and the double; what has begun to glow since then too."""
        with self._drawing(target, camera, viewport):
            for player in self._players:
                player.draw_glow(target, camera, viewport)

    def draw_shadows(self) -> None:
        """Draw the shadow maps of the frame."""
        for player in self._players:
            player.draw_shadows()

    @property
    def picture_parts(self) -> tuple[moderngl.VertexArray, ...]:
        """What the picture pass draws: figures and kits, then the room."""
        return (*(part for player in self._players for part in player.picture_parts), *self._room.parts)

    def _draw_room(self, parts: tuple[moderngl.VertexArray, ...], camera: Camera, viewport: Viewport) -> None:
        self._room.use_textures([player.parts.shadow for player in self._players])
        aim(parts, clip_of(camera, viewport[2] / viewport[3]), camera.eye)
        for part in parts:
            part.render()

    def _draw_crowd(self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport) -> None:
        beat = self._players[0].frame.crowd_beat
        if self._crowd is not None and beat is not None:
            self._crowd.draw(target, clip_of(camera, viewport[2] / viewport[3]), camera.eye, beat)

    # --- OpenGL's state -----------------------------------------------------------------------------------------------

    @contextmanager
    def _drawing(self, target: moderngl.Framebuffer, camera: Camera, viewport: Viewport) -> Iterator[None]:
        ctx = self._ctx
        ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        target.use()
        ctx.viewport = ctx.scissor = viewport
        ctx.front_face = "cw" if camera.mirrored else "ccw"
        yield
        ctx.depth_func = "<"
        ctx.polygon_offset = 0.0, 0.0
        ctx.scissor = None
        ctx.front_face = "ccw"

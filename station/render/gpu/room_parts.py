"""What the room is drawn from: rugs, floor and wall, and how the light over each kit falls on them."""

from collections.abc import Sequence

import moderngl
import numpy as np

from station.motion.kit.kit import Kit
from station.render.geometry.light import Light
from station.render.geometry.mesh import Mesh, joined
from station.render.geometry.transforms import translation, unit
from station.render.gpu import room_shaders
from station.render.gpu.scene_cache import cached_light, cached_paint, cached_wall
from station.render.gpu.scene_parts import STILL_LEVEL, TO_TEXTURE, write
from station.render.kit import room
from station.render.kit.kit_rig import floor_discs
from station.render.place import Place
from station.render.quality import Quality

_KEY = Light()
_BOARDS, _RUG, _LIGHTS = 0, 1, 3
_PLACES = {"wall_map": 2, "light_map": 3, "shadow_map": 4, "light_map_2": 5, "shadow_map_2": 6}
"""Where the shaders find the pictures; boards and rug come first."""
_OVER_M = 0.001
"""The second rug lies over the first one's edge."""
_SHADOWS = (_PLACES["shadow_map"], _PLACES["shadow_map_2"])


class RoomParts:
    """Rugs, floor and wall: `parts` to be drawn with every picture, `still` as finely as can be, to be kept."""

    def __init__(self, ctx: moderngl.Context, kits: Sequence[tuple[Kit, Place]], quality: Quality) -> None:
        self._ctx, self._quality = ctx, quality
        self._places = [place for _, place in kits]
        self._pictures = self._textures([kit for kit, _ in kits])
        self.parts = self._room_parts(quality.level)
        self.still = self._room_parts(STILL_LEVEL) if quality.level == 0 else self.parts
        self.light((1.0,) * len(kits))

    def use_textures(self, shadows: Sequence[moderngl.Texture]) -> None:
        """Let the shaders read the room's pictures, and the shadow map of each kit."""
        for place, texture in enumerate(self._pictures[: _LIGHTS + 1]):
            texture.use(place)
        for texture in self._pictures[_LIGHTS + 1 :]:
            texture.use(_PLACES["light_map_2"])
        for place, shadow in zip(_SHADOWS, shadows, strict=False):
            shadow.use(place)

    def sharpen(self, is_rough: bool) -> None:
        """Let what is seen at a flat angle be as sharp as can be, or be drawn soon."""
        for picture in self._pictures[: _RUG + 1]:
            picture.anisotropy = 1.0 if is_rough else self._quality.anisotropy

    def light(self, shares: Sequence[float]) -> None:
        """Light the floor under each kit so much, 0–1."""
        for part in (*self.parts, *self.still):
            if "shares" in part.program:
                part.program["shares"] = tuple(shares)

    def _textures(self, kits: Sequence[Kit]) -> list[moderngl.Texture]:
        ctx = self._ctx
        discs = [
            (*place.placed((x, y, 0.0))[:2], height, radius)
            for kit, place in zip(kits, self._places, strict=True)
            for x, y, height, radius in floor_discs(kit)
        ]
        lights = [cached_light(discs, place.light(_KEY)) for place in self._places]
        pictures = (*cached_paint(), cached_wall(), *lights)
        made = [ctx.texture(p.shape[1::-1], p.shape[2], p.tobytes()) for p in pictures]
        for picture in made[: _RUG + 1]:  # the others are seen larger than they are
            picture.build_mipmaps()
            picture.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR
        made[_RUG].repeat_x = False
        for picture in made[_RUG:]:
            picture.repeat_y = False
        for picture in made[: _RUG + 1]:
            picture.anisotropy = self._quality.anisotropy
        return made

    def _room_parts(self, level: int) -> tuple[moderngl.VertexArray, ...]:
        lights = len(self._places)
        floor, rug = (room_shaders.floor_fragment(level, is_varnished=has, lights=lights) for has in (level > 0, False))
        rugs = joined(
            [
                room.rug_mesh().moved(translation([0, 0, k * _OVER_M]) @ place.matrix)
                for k, place in enumerate(self._places)
            ]
        )
        boards, carpet = self._part(floor, room.floor_mesh()), self._part(rug, rugs)
        boards.program["paint_map"], carpet.program["paint_map"] = _BOARDS, _RUG
        return carpet, boards, self._part(room_shaders.WALL_FRAGMENT, room.wall_mesh())

    def _part(self, fragment: str, mesh: Mesh) -> moderngl.VertexArray:
        rows = np.concatenate([mesh.position, mesh.uv], axis=1).astype(np.float32)
        content = [(self._ctx.buffer(rows.tobytes()), "3f 2f", "position", "uv")]
        program = self._ctx.program(room_shaders.room_vertex(len(self._places)), fragment)
        self._constants(program)
        return self._ctx.vertex_array(program, content, self._ctx.buffer(mesh.faces.tobytes()), skip_errors=True)

    def _constants(self, program: moderngl.Program) -> None:
        values: dict[str, object] = {
            "key_colour": _KEY.colour,
            "rim_way": unit(_KEY.rim_from),
            "rim_colour": _KEY.rim_colour,
            "warm_colour": _KEY.warm_colour,
            "sky": _KEY.sky,
        }
        for ending, place in zip(("", "_2"), self._places, strict=False):
            light = place.light(_KEY)
            values |= {f"key_at{ending}": light.at, f"light_projection{ending}": (TO_TEXTURE @ light.matrix()).T}
        for name, value in values.items():
            if name in program:
                write(program, name, np.ascontiguousarray(value, np.float32).tobytes())
        for name, place_of in _PLACES.items():
            if name in program:
                program[name] = place_of

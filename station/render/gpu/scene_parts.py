"""What a kit and who plays it are drawn from: corners and programs, uploaded once.

Every solid can be drawn in several ways, each a program of its own over the same corners. All is in the kit's own axes.
"""

from collections.abc import Collection
from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.motion.kinematics.figure import Figure
from station.render.figure.bones import LIMB_BONES, Bone
from station.render.figure.skin import Skin
from station.render.geometry.light import Light
from station.render.geometry.materials import shader_table
from station.render.geometry.mesh import Mesh
from station.render.geometry.transforms import gl_bytes, unit
from station.render.gpu import corner_shaders, pixel_shaders
from station.render.gpu.scene_cache import cached_body
from station.render.gpu.vertex_layouts import RIGID, RIGID_PLACES, SKIN, SKIN_PLACES, rigid_rows, skin_rows
from station.render.kit.kit_rig import KitRig
from station.render.palette import GOOD
from station.render.quality import Quality

_KEY = Light()
TO_TEXTURE = np.array([[0.5, 0, 0, 0.5], [0, 0.5, 0, 0.5], [0, 0, 0.5, 0.5], [0, 0, 0, 1.0]])
"""From clip space −1 … 1 to texture space 0 … 1."""
_GHOST_OPACITY = 0.42
"""How opaque the student's double is where one looks straight at it (our choice: the demonstrator shows through)."""
STILL_LEVEL = 1
"""The shader level of what is drawn once and kept (our choice: the highest takes twice as long, and little is seen)."""
_SHADOW = 4
"""Where the shaders find the shadow map; the room's pictures come first."""
_DIMMED = ("key_colour", "sky", "ground", "rim_colour")
_LEFT = (0.0, 0.55, 0.55, 0.75)
"""What light is left where the spotlight is on somebody else: of the spot, of what comes from above and from the floor,
and of the light from behind, which draws the outline (our choice, by eye)."""
_LIMBS: frozenset[int] = frozenset(bone for bones in LIMB_BONES.values() for bone in bones)
_BUT_ARMS: frozenset[int] = frozenset(Bone) - {*LIMB_BONES[Limb.RIGHT_HAND], *LIMB_BONES[Limb.LEFT_HAND]}


@dataclass(frozen=True, slots=True)
class KitAndFigure:
    """Kit and figure by one kind of program."""

    rigid: moderngl.VertexArray
    skin: moderngl.VertexArray


class SceneParts:
    """`solid`, `quick`, `ghost`: kit and figure pixel by pixel, corner by corner, and the student's double's limbs.

    `glow` lays light over the kit. `still_rigid` is the kit as finely as can be, to be drawn once and kept.
    `rigid_depth`, `skin_depth` and, without the arms, `resting_depth` cast shadows into `shadow_buffer`.
    """

    def __init__(self, ctx: moderngl.Context, rig: KitRig, figure: Figure, quality: Quality) -> None:
        self._ctx = ctx
        self._quality = quality
        self._colours = figure.look.colours
        self._make_shadow()
        self.skin = cached_body(figure, quality.figure_cell)
        self._upload(rig.mesh, self.skin)
        fragment = pixel_shaders.solid_fragment(quality.level)
        self.solid = self._pair(pixel_shaders.RIGID_VERTEX, pixel_shaders.SKIN_VERTEX, fragment)
        self.quick = self._pair(corner_shaders.RIGID_QUICK, corner_shaders.SKIN_QUICK, corner_shaders.QUICK_FRAGMENT)
        self.ghost = KitAndFigure(
            self._rigid_part(corner_shaders.RIGID_GHOST, corner_shaders.QUICK_FRAGMENT),
            self._skin_part(corner_shaders.SKIN_GHOST, corner_shaders.QUICK_FRAGMENT, self._limb_faces),
        )
        self.glow = self._rigid_part(corner_shaders.RIGID_GLOW, corner_shaders.QUICK_FRAGMENT)
        self.still_rigid = self.solid.rigid
        if quality.level == 0:  # the one that may be drawn in layers
            self.still_rigid = self._rigid_part(pixel_shaders.RIGID_VERTEX, pixel_shaders.solid_fragment(STILL_LEVEL))
        for part in (self.solid.skin, self.quick.skin, self.skin_depth):
            part.program["first_bone"] = rig.bone_count

    def use_shadow(self) -> None:
        """Let the shaders read the shadow map."""
        self.shadow.use(_SHADOW)

    def light(self, share: float) -> None:
        """Light kit and figure so much: 1 in the spotlight … 0 where it is on somebody else."""
        for name, left in zip(_DIMMED, _LEFT, strict=True):
            colour = np.asarray(getattr(_KEY, name.removeprefix("key_")), np.float32) * (left + (1 - left) * share)
            for part in (self.solid.rigid, self.solid.skin, self.quick.rigid, self.quick.skin, self.still_rigid):
                if name in part.program:
                    write(part.program, name, np.asarray(colour, np.float32).tobytes())

    def _make_shadow(self) -> None:
        self.shadow = self._ctx.depth_texture((self._quality.shadow_texels,) * 2)
        self.shadow.compare_func = "<="
        self.shadow.repeat_x = self.shadow.repeat_y = False
        self.shadow_buffer = self._ctx.framebuffer(depth_attachment=self.shadow)

    def _upload(self, mesh: Mesh, skin: Skin) -> None:
        ctx = self._ctx
        self._rigid_data = ctx.buffer(rigid_rows(mesh).tobytes()), ctx.buffer(mesh.faces.tobytes())
        self._skin_data = ctx.buffer(skin_rows(skin).tobytes()), ctx.buffer(skin.faces.tobytes())
        rigid, skinned = (
            self._program(vertex, pixel_shaders.SHADOW_FRAGMENT)
            for vertex in (pixel_shaders.RIGID_SHADOW, pixel_shaders.SKIN_SHADOW)
        )
        for program in (rigid, skinned):
            write(program, "light_projection", gl_bytes(_KEY.matrix()))
        places = [(self._skin_data[0], *SKIN_PLACES)]
        self.rigid_depth = ctx.vertex_array(rigid, [(self._rigid_data[0], *RIGID_PLACES)], self._rigid_data[1])
        self.skin_depth = ctx.vertex_array(skinned, places, self._skin_data[1])
        self.resting_depth = ctx.vertex_array(skinned, places, _some(ctx, skin, _BUT_ARMS))
        self._limb_faces = _some(ctx, skin, _LIMBS)
        self.triangles = len(mesh.faces) + len(skin.faces)

    def _pair(self, rigid: str, skin: str, fragment: str) -> KitAndFigure:
        return KitAndFigure(self._rigid_part(rigid, fragment), self._skin_part(skin, fragment, self._skin_data[1]))

    def _skin_part(self, vertex: str, fragment: str, faces: moderngl.Buffer) -> moderngl.VertexArray:
        content = [(self._skin_data[0], *SKIN)]
        return self._ctx.vertex_array(self._program(vertex, fragment), content, faces, skip_errors=True)

    def _rigid_part(self, vertex: str, fragment: str) -> moderngl.VertexArray:
        corners, faces = self._rigid_data
        return self._ctx.vertex_array(self._program(vertex, fragment), [(corners, *RIGID)], faces, skip_errors=True)

    def _program(self, vertex: str, fragment: str) -> moderngl.Program:
        program = self._ctx.program(vertex, fragment)
        self._constants(program)
        return program

    def _constants(self, program: moderngl.Program) -> None:
        first, second = shader_table(self._colours)
        values: dict[str, object] = {
            "look_a": first,
            "look_b": second,
            "key_at": _KEY.at,
            "key_axis": _KEY.axis,
            "key_colour": _KEY.colour,
            "rim_way": unit(_KEY.rim_from),
            "rim_colour": _KEY.rim_colour,
            "sky": _KEY.sky,
            "ground": _KEY.ground,
            "light_projection": (TO_TEXTURE @ _KEY.matrix()).T,
            "tint": GOOD[:3],
            "opacity": _GHOST_OPACITY,
        }
        for name, value in values.items():
            if name in program:
                write(program, name, np.ascontiguousarray(value, np.float32).tobytes())
        if "shadow_map" in program:
            program["shadow_map"] = _SHADOW


def _some(ctx: moderngl.Context, skin: Skin, bones: Collection[int]) -> moderngl.Buffer:
    """The faces that hang on some bones above all."""
    strongest: NDArray[np.uint8] = skin.bones[:, 0]
    return ctx.buffer(skin.faces[np.isin(strongest[skin.faces[:, 0]], list(bones))].tobytes())


def write(program: moderngl.Program, name: str, data: bytes) -> None:
    """Set a uniform from its bytes."""
    uniform = program[name]
    assert isinstance(uniform, moderngl.Uniform), f"{name} is no uniform"
    uniform.write(data)

"""Draws the room, the kit and the drummer with OpenGL: a shadow pass and a picture pass.

Two kinds of geometry share one palette of bone matrices: rigid (kit, room) and skinned (the figure). All of it is
uploaded once; a frame uploads the palette alone.
"""

from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.figure import Figure
from station.motion.kit import Kit
from station.motion.pose import Pose
from station.render import kit_rig, room, shaders
from station.render.body import Skin, build_body
from station.render.camera import Camera
from station.render.drums import Detail
from station.render.kit_rig import KitRig, build_kit, floor_discs
from station.render.light import Light
from station.render.materials import shader_table
from station.render.mesh import Mesh
from station.render.skeleton import Bone, Skeleton
from station.render.space import gl_bytes, unit

RIGID_DTYPE = np.dtype(
    [
        ("position", np.float32, 3),
        ("normal", np.float16, 4),
        ("tangent", np.float16, 4),
        ("bone", np.uint8),
        ("material", np.uint8),
        ("ao", np.uint8),
        ("pad", np.uint8),
    ]
)
SKIN_DTYPE = np.dtype(
    [
        ("position", np.float32, 3),
        ("normal", np.float16, 4),
        ("bones", np.uint8, 4),
        ("weights", np.uint8, 4),
        ("material", np.uint8),
        ("ao", np.uint8),
        ("pad", np.uint8, 2),
    ]
)
_SKIN_LAYOUT = "3f 4f2 4i1 4f1 1i1 1f1 2x1"
_SKIN_NAMES = ("position", "normal", "bones", "weights", "material", "ao")
_RIGID_LAYOUT = "3f 4f2 4f2 1i1 1i1 1f1 1x1"
_RIGID_NAMES = ("position", "normal", "tangent", "bone", "material", "ao")


@dataclass(frozen=True, slots=True)
class Quality:
    """How much work a picture is worth: shader level 0–2, sizes of shadow map and floor, roundness, small hardware."""

    level: int
    shadow_texels: int
    floor_texels: int
    detail: Detail
    figure_cell: float
    samples: int


QUALITIES = (
    Quality(0, 768, 768, Detail(28, hardware=False), 2.5, 0),
    Quality(1, 1024, 1024, Detail(48, hardware=True), 1.5, 4),
    Quality(2, 2048, 1536, Detail(80, hardware=True), 1.0, 4),
)
"""Lowest to highest; `figure_cell` multiplies the cell size that the figure's surface is cut with."""


_KEY = Light()
_TO_TEXTURE = np.array([[0.5, 0, 0, 0.5], [0, 0.5, 0, 0.5], [0, 0, 0.5, 0.5], [0, 0, 0, 1.0]])
"""From clip space −1 … 1 to texture space 0 … 1."""
_RIM_WAY = unit([-0.55, -0.65, 0.52])
_RIM_COLOUR = (0.20, 0.34, 0.52)
_GROUND = (0.060, 0.045, 0.040)


Glow = dict[Piece, NDArray[np.float64]]
"""Linear red, green and blue that a piece of the kit glows with."""


class Scene:
    """One kit and one figure, ready to be drawn at one quality."""

    def __init__(self, ctx: moderngl.Context, kit: Kit, figure: Figure, quality: Quality) -> None:
        self._ctx = ctx
        self.quality = quality
        self.rig: KitRig = build_kit(kit, quality.detail)
        self._rigid_program = ctx.program(shaders.RIGID_VERTEX, shaders.solid_fragment(quality.level))
        self._skin_program = ctx.program(shaders.SKIN_VERTEX, shaders.solid_fragment(quality.level))
        self._skin_shadow = ctx.program(shaders.SKIN_SHADOW, shaders.SHADOW_FRAGMENT)
        self.skeleton = Skeleton(figure)
        self._rigid_shadow = ctx.program(shaders.RIGID_SHADOW, shaders.SHADOW_FRAGMENT)
        self._palette = ctx.buffer(reserve=shaders.MAX_BONES * 80, dynamic=True)
        self._floor_program = ctx.program(shaders.ROOM_VERTEX, shaders.floor_fragment(quality.level))
        self._wall_program = ctx.program(shaders.ROOM_VERTEX, shaders.WALL_FRAGMENT)
        self._textures(kit)
        self._upload_rigid()
        self._upload_skin(build_body(figure, quality.figure_cell))
        self._upload_room()
        for program in (self._rigid_program, self._skin_program, self._floor_program, self._wall_program):
            self._constants(program)
        for program in (self._rigid_shadow, self._skin_shadow):
            _write(program, "light_projection", gl_bytes(_KEY.matrix()))

    def _textures(self, kit: Kit) -> None:
        ctx = self._ctx
        floor, wall = room.floor_picture(floor_discs(kit), _KEY, self.quality.floor_texels), room.wall_picture()
        self._floor = ctx.texture(floor.shape[1::-1], 4, floor.tobytes())
        self._floor.build_mipmaps()
        self._floor.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR
        self._floor.anisotropy = 1.0 if self.quality.level == 0 else 8.0
        self._wall = ctx.texture(wall.shape[1::-1], 3, wall.tobytes())
        self._wall.repeat_y = False
        size = (self.quality.shadow_texels,) * 2
        self._shadow = ctx.depth_texture(size)
        self._shadow.compare_func = "<="
        self._shadow.repeat_x = self._shadow.repeat_y = False
        self._shadow_buffer = ctx.framebuffer(depth_attachment=self._shadow)

    def _upload_rigid(self) -> None:
        mesh = self.rig.mesh
        self._vertices = self._ctx.buffer(_interleaved(mesh).tobytes())
        self._faces = self._ctx.buffer(mesh.faces.tobytes())
        content = [(self._vertices, _RIGID_LAYOUT, *_RIGID_NAMES)]
        self._rigid = self._ctx.vertex_array(self._rigid_program, content, self._faces)
        self._rigid_depth = self._ctx.vertex_array(
            self._rigid_shadow, [(self._vertices, "3f 16x1 1i1 3x1", "position", "bone")], self._faces
        )

    def _upload_skin(self, skin: Skin) -> None:
        rows = np.zeros(len(skin.position), SKIN_DTYPE)
        rows["position"], rows["material"] = skin.position, skin.material
        rows["normal"][:, :3] = skin.normal
        rows["bones"] = skin.bones + self.rig.bone_count
        rows["weights"] = _shares(skin.weights)
        rows["ao"] = np.rint(skin.ao * 255)
        vertices, faces = self._ctx.buffer(rows.tobytes()), self._ctx.buffer(skin.faces.tobytes())
        content = [(vertices, _SKIN_LAYOUT, *_SKIN_NAMES)]
        self._skin = self._ctx.vertex_array(self._skin_program, content, faces)
        depth = [(vertices, "3f 8x1 4i1 4f1 4x1", "position", "bones", "weights")]
        self._skin_depth = self._ctx.vertex_array(self._skin_shadow, depth, faces)
        self._skin_triangles = len(skin.faces)

    def _upload_room(self) -> None:
        self._room = [
            self._room_part(self._floor_program, room.floor_mesh()),
            self._room_part(self._wall_program, room.wall_mesh()),
        ]

    def _room_part(self, program: moderngl.Program, mesh: Mesh) -> moderngl.VertexArray:
        rows = np.concatenate([mesh.position, mesh.uv], axis=1).astype(np.float32)
        content = [(self._ctx.buffer(rows.tobytes()), "3f 2f", "position", "uv")]
        return self._ctx.vertex_array(program, content, self._ctx.buffer(mesh.faces.tobytes()), skip_errors=True)

    def _constants(self, program: moderngl.Program) -> None:
        first, second = shader_table()
        values: dict[str, object] = {
            "look_a": first,
            "look_b": second,
            "key_at": _KEY.at,
            "key_axis": _KEY.axis,
            "key_colour": _KEY.colour,
            "rim_way": _RIM_WAY,
            "rim_colour": _RIM_COLOUR,
            "sky": _KEY.sky,
            "ground": _GROUND,
            "opacity": 1.0,
            "tint": (0.0, 0.0, 0.0),
            "light_projection": (_TO_TEXTURE @ _KEY.matrix()).T,
        }
        for name, value in values.items():
            if name in program:
                _write(program, name, np.ascontiguousarray(value, np.float32).tobytes())
        for unit_index, name in enumerate(("floor_map", "wall_map", "shadow_map")):
            if name in program:
                program[name] = unit_index

    @property
    def triangles(self) -> int:
        """How many triangles a picture draws, shadows apart."""
        return self._faces.size // 12 + self._skin_triangles

    def draw(
        self,
        target: moderngl.Framebuffer,
        camera: Camera,
        pose: Pose | None,
        viewport: tuple[int, int, int, int],
        glow: Glow | None = None,
    ) -> None:
        """Draw into `viewport` (x, y, width, height from the lower left) of `target`; `glow` lights struck pieces."""
        ctx = self._ctx
        matrices = np.tile(np.eye(4), (shaders.MAX_BONES, 1, 1))
        first = self.rig.bone_count
        matrices[:first] = kit_rig.bone_matrices(self.rig, pose)
        if pose is not None:
            matrices[first : first + len(Bone)] = self.skeleton.matrices(pose)
        light = np.zeros((shaders.MAX_BONES, 4), np.float32)
        for piece, colour in (glow or {}).items():
            light[self.rig.piece_bones[piece], :3] = colour
        self._palette.write(gl_bytes(matrices) + light.tobytes())
        self._palette.bind_to_uniform_block(0)
        ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        ctx.front_face = "ccw"
        self.draw_shadows(pose is not None)
        self.draw_again(target, camera, pose is not None, viewport)

    def draw_again(
        self, target: moderngl.Framebuffer, camera: Camera, with_figure: bool, viewport: tuple[int, int, int, int]
    ) -> None:
        """Draw what was drawn last once more, from another camera into another viewport: no shadow is cast anew."""
        ctx = self._ctx
        ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        ctx.front_face = "ccw"
        self._palette.bind_to_uniform_block(0)
        target.use()
        ctx.viewport = viewport
        ctx.scissor = viewport
        target.clear(depth=1.0, viewport=viewport)
        if camera.mirrored:
            ctx.front_face = "cw"
        self._floor.use(0)
        self._wall.use(1)
        self._shadow.use(2)
        projection = gl_bytes(camera.matrix(viewport[2] / viewport[3]))
        for program in (self._skin_program, self._rigid_program, self._floor_program, self._wall_program):
            _write(program, "view_projection", projection)
            if "eye" in program:
                program["eye"] = camera.eye
        for part in self.picture_parts[0 if with_figure else 1 :]:
            part.render()
        ctx.scissor = None
        ctx.front_face = "ccw"

    @property
    def picture_parts(self) -> tuple[moderngl.VertexArray, ...]:
        """What the picture pass draws: the figure first, then nearest first, so that what is hidden is not shaded."""
        return (self._skin, self._rigid, *self._room)

    @property
    def shadow_parts(self) -> tuple[moderngl.VertexArray, ...]:
        """What the shadow pass draws: the figure first."""
        return (self._skin_depth, self._rigid_depth)

    def draw_shadows(self, with_figure: bool) -> None:
        """Draw the shadow map with the bones that were set last."""
        self._shadow_buffer.use()
        self._shadow_buffer.clear(depth=1.0)
        for part in self.shadow_parts[0 if with_figure else 1 :]:
            part.render()


def _write(program: moderngl.Program, name: str, data: bytes) -> None:
    """Set a uniform from its bytes."""
    uniform = program[name]
    assert isinstance(uniform, moderngl.Uniform), f"{name} is no uniform"
    uniform.write(data)


def _shares(weights: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Weights as 255ths that sum to 255 exactly, so that no corner is pulled towards the origin."""
    parts = np.rint(weights * 255)
    parts[:, 0] += 255 - parts.sum(axis=1)
    return parts.astype(np.uint8)


def _interleaved(mesh: Mesh) -> NDArray[np.void]:
    out = np.zeros(len(mesh.position), RIGID_DTYPE)
    out["position"] = mesh.position
    out["normal"][:, :3] = mesh.normal
    out["tangent"][:, :3] = mesh.tangent
    out["bone"], out["material"] = mesh.bone, mesh.material
    out["ao"] = np.rint(np.clip(mesh.ao, 0, 1) * 255)
    return out

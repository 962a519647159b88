"""Draws tables of flat shapes (`draw_list.SHAPE_DTYPE`) with one OpenGL call a table."""

from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from station.render.palette import Theme, themed, themed_bytes
from station.render.text.atlas import ATLAS_SIZE, SPREAD, Atlas
from station.render.text.draw_list import SHAPE_DTYPE, Colour

_VERTEX = f"""
#version 330 core
uniform vec2 viewport;        // pixels
uniform vec2 origin;          // pixels
uniform float unit;           // pixels a unit
uniform float position_s;
uniform float pixels_per_s;
uniform vec2 way;             // of time, a unit vector along an axis
uniform float texels_to_uv = {1.0 / ATLAS_SIZE};

in vec2 centre;
in vec2 half_size;
in vec2 axis;
in vec4 uv;
in vec3 style;
in vec2 time_s;
in float kind;
in vec4 colour;
in vec4 colour_2;

out vec2 v_at;                // pixels from the shape's middle, unturned
flat out vec2 v_half;
out vec2 v_uv;
out vec4 v_colour;
flat out vec3 v_style;
flat out int v_kind;
flat out float v_texel;       // pixels a texel
out float v_along;

void main() {{
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    float span = 0.5 * time_s.y * pixels_per_s;
    v_half = half_size * unit + abs(way) * span;
    v_style = style * unit;
    v_kind = int(kind + 0.5);
    float margin = v_kind == 2 ? 0.0 : 1.0 + v_style.z + 0.5 * v_style.y;
    v_at = corner * (v_half + margin);
    vec2 turned = vec2(axis.x * v_at.x - axis.y * v_at.y, axis.y * v_at.x + axis.x * v_at.y);
    vec2 pixel = origin + centre * unit + turned;
    pixel += way * ((time_s.x - position_s) * pixels_per_s + span);
    v_along = dot(pixel, abs(way));
    v_uv = mix(uv.xy, uv.zw, corner * 0.5 + 0.5);
    v_texel = 2.0 * v_half.x * texels_to_uv / max(abs(uv.z - uv.x), 1e-6);
    v_colour = mix(colour, colour_2, clamp(corner.y * 0.5 + 0.5, 0.0, 1.0));
    gl_Position = vec4(pixel.x / viewport.x * 2.0 - 1.0, 1.0 - pixel.y / viewport.y * 2.0, 0.0, 1.0);
}}
"""

_FRAGMENT = f"""
#version 330 core
uniform sampler2D atlas;
uniform vec4 fade;            // pixels along time's axis: gone before x, whole from y to z, gone after w

in vec2 v_at;
flat in vec2 v_half;
in vec2 v_uv;
in vec4 v_colour;
flat in vec3 v_style;
flat in int v_kind;
flat in float v_texel;
in float v_along;
out vec4 shade;

float segment(vec2 p, vec2 a, vec2 b) {{
    vec2 pa = p - a, ba = b - a;
    return length(pa - ba * clamp(dot(pa, ba) / dot(ba, ba), 0.0, 1.0));
}}

float outside() {{            // signed distance in pixels, negative inside
    if (v_kind == 2) return (0.5 - texture(atlas, v_uv).r) * {2.0 * SPREAD} * v_texel;
    if (v_kind == 1) {{
        float a = length(v_at / v_half), b = length(v_at / (v_half * v_half));
        return a < 1e-4 ? -min(v_half.x, v_half.y) : a * (a - 1.0) / b;
    }}
    if (v_kind == 3) {{
        float slope = dot(vec2(v_at.x - v_half.x, abs(v_at.y)), normalize(vec2(v_half.y, 2.0 * v_half.x)));
        return max(slope, -v_half.x - v_at.x);
    }}
    if (v_kind == 4) {{
        vec2 p = abs(v_at);
        return segment(p, vec2(0.0), v_half) - 0.5 * v_style.y;
    }}
    vec2 q = abs(v_at) - v_half + v_style.x;
    return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - v_style.x;
}}

void main() {{
    float d = outside();
    if (v_kind != 4 && v_style.y > 0.0) d = abs(d) - 0.5 * v_style.y;
    float edge = 0.5 + v_style.z;
    float cover = v_style.z > 0.0 ? 1.0 - smoothstep(-edge, edge, d) : clamp(0.5 - d, 0.0, 1.0);
    float seen = clamp((v_along - fade.x) / max(fade.y - fade.x, 1e-3), 0.0, 1.0)
               * clamp((fade.w - v_along) / max(fade.w - fade.z, 1e-3), 0.0, 1.0);
    float alpha = v_colour.a * cover * seen;
    if (alpha <= 0.0) discard;
    shade = vec4(v_colour.rgb * alpha, alpha);
}}
"""

_FILL_VERTEX = """
#version 330 core
uniform vec4 area;            // left, top, right, bottom in clip space
uniform vec4 top;
uniform vec4 bottom;
out vec4 v_colour;            // the picture's program has none
void main() {
    vec2 at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    v_colour = mix(top, bottom, at.y);
    gl_Position = vec4(mix(area.xy, area.zw, at), 0.0, 1.0);
}
"""

_FILL_FRAGMENT = """
#version 330 core
in vec4 v_colour;
out vec4 shade;
void main() { shade = vec4(v_colour.rgb * v_colour.a, v_colour.a); }
"""

_PICTURE_FRAGMENT = """
#version 330 core
uniform sampler2D picture;
uniform ivec2 corner;
uniform float opacity;
out vec4 shade;
void main() { shade = vec4(texelFetch(picture, ivec2(gl_FragCoord.xy) - corner, 0).rgb, 1.0) * opacity; }
"""

_LAYOUT = "2f 2f 2f 4f 3f 2f 1f 4f1 4f1/i"
_NAMES = ("centre", "half_size", "axis", "uv", "style", "time_s", "kind", "colour", "colour_2")
_EVERYWHERE = (-2.0, -1.0, 1e6, 1e6 + 1)


@dataclass(frozen=True, slots=True)
class Transform:
    """Where shapes go: `size` of the picture, `origin` of the units (pixels, y down), `unit` pixels a unit.

    `position_s` stands at the origin and a second takes `pixels_per_s`, to the right, or up where what comes `falls`.
    `fade` (a, b, c, d), pixels along that axis: shapes appear between a and b and vanish between c and d.
    """

    size: tuple[int, int]
    origin: tuple[float, float] = (0.0, 0.0)
    unit: float = 1.0
    position_s: float = 0.0
    pixels_per_s: float = 0.0
    fade: tuple[float, float, float, float] = _EVERYWHERE
    falls: bool = False


class ShapeRenderer:
    """The program, the letter texture and a growing instance buffer; prints in the colours of `theme`."""

    def __init__(self, ctx: moderngl.Context, atlas: Atlas) -> None:
        self.theme = Theme.NIGHT
        self._ctx = ctx
        self._atlas = atlas
        self._program = ctx.program(vertex_shader=_VERTEX, fragment_shader=_FRAGMENT)
        self._texture = ctx.texture((ATLAS_SIZE, ATLAS_SIZE), 1, dtype="f1")
        self._version = -1
        self._fill_program = ctx.program(vertex_shader=_FILL_VERTEX, fragment_shader=_FILL_FRAGMENT)
        self._fill = ctx.vertex_array(self._fill_program, [])
        self._picture_program = ctx.program(vertex_shader=_FILL_VERTEX, fragment_shader=_PICTURE_FRAGMENT)
        self._picture_program["area"] = -1.0, 1.0, 1.0, -1.0
        self._picture = ctx.vertex_array(self._picture_program, [])
        self._allocate(1024)

    def _allocate(self, capacity: int) -> None:
        self._capacity = capacity
        self._buffer = self._ctx.buffer(reserve=capacity * SHAPE_DTYPE.itemsize, dynamic=True)
        self._vertices = self._ctx.vertex_array(self._program, [(self._buffer, _LAYOUT, *_NAMES)])

    def fill(self, box: tuple[float, float, float, float], colours: tuple[Colour, Colour], sheet: Transform) -> None:
        """Fill `box` (left, top, width, height; pixels, y down) from the first colour above to the second below.

        Large areas deserve a shader that does nothing else, for without a graphics card every pixel counts.
        """
        width, height = sheet.size
        left, top, across, down = box
        program = self._fill_program
        program["area"] = (
            2 * left / width - 1,
            1 - 2 * top / height,
            2 * (left + across) / width - 1,
            1 - 2 * (top + down) / height,
        )
        program["top"], program["bottom"] = (themed(colour, self.theme) for colour in colours)
        self._blend()
        self._fill.render(moderngl.TRIANGLE_STRIP, vertices=4)

    def picture(self, texture: moderngl.Texture, opacity: float = 1.0) -> None:
        """Fill the viewport, which is as large, with a picture, `opacity` over what is there."""
        self._blend()
        if opacity == 1.0:
            self._ctx.disable(moderngl.BLEND)
        self._picture_program["opacity"] = opacity
        texture.use(0)
        self._picture_program["corner"] = self._ctx.viewport[:2]
        self._picture.render(moderngl.TRIANGLE_STRIP, vertices=4)

    def _blend(self) -> None:
        self._ctx.disable(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        self._ctx.enable(moderngl.BLEND)
        self._ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA

    def draw(self, shapes: NDArray[np.void], sheet: Transform) -> None:
        """Draw `shapes`, first to last, over what is there."""
        if not len(shapes):
            return
        if len(shapes) > self._capacity:
            self._vertices.release()
            self._buffer.release()
            self._allocate(2 * len(shapes))
        self._buffer.orphan()
        self._buffer.write(np.ascontiguousarray(self._themed(shapes)).tobytes())
        self._upload()
        self._set(sheet)
        self._blend()
        self._vertices.render(moderngl.TRIANGLE_STRIP, vertices=4, instances=len(shapes))

    def _themed(self, shapes: NDArray[np.void]) -> NDArray[np.void]:
        if self.theme is Theme.NIGHT:
            return shapes
        copy = shapes.copy()
        for field in ("colour", "colour_2"):
            copy[field][:, :3] = themed_bytes(shapes[field][:, :3], self.theme)
        return copy

    def _upload(self) -> None:
        if self._version != self._atlas.version:
            self._texture.write(self._atlas.pixels.tobytes())
            self._version = self._atlas.version
        self._texture.use(0)

    def _set(self, sheet: Transform) -> None:
        self._program["viewport"] = sheet.size
        self._program["origin"] = sheet.origin
        self._program["unit"] = sheet.unit
        self._program["position_s"] = sheet.position_s
        self._program["pixels_per_s"] = sheet.pixels_per_s
        self._program["way"] = (0.0, -1.0) if sheet.falls else (1.0, 0.0)
        self._program["fade"] = sheet.fade

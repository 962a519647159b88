"""Pictures as planes of luma and chroma, which video is made of: converted by a shader and read back a frame later.

ITU-R BT.709-6, narrow range (luma 16 … 235, chroma 16 … 240 about 128), 4:2:0 as NV12: rows of luma, then rows that
hold Cb and Cr in turn for every second row and column. A chroma sample lies on the left of its two columns and between
its two rows, as H.264 (Annex E, chroma_sample_loc_type 0) takes for granted. The picture's colours are encoded already.
"""

from collections import deque

import moderngl
import numpy as np
from numpy.typing import NDArray

Planes = NDArray[np.uint8]
"""A picture in NV12: shape (height · 3/2, width), top row first; width and height are even."""

_LUMA_RED, _LUMA_BLUE = 0.2126, 0.0722
"""BT.709-6, item 3.2."""
_PARTS = 3
"""Even rows of luma, odd rows, chroma."""
_AHEAD = 2
"""So many frames are on their way from the graphics card while the next is drawn: double buffering."""
_SETS = 2
"""One is converted into while the other is read."""

_VERTEX = """
#version 330 core
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }
"""

_FRAGMENT = f"""
#version 330 core
uniform sampler2D picture;
uniform ivec2 last;                         // column and row
layout(location = 0) out vec4 upper;        // four pixels' luma
layout(location = 1) out vec4 lower;        // of the row below
layout(location = 2) out vec4 chroma;       // of two blocks of two by two

vec3 at(int x, int y) {{ return texelFetch(picture, ivec2(x, y), 0).rgb; }}
float luma(vec3 c) {{ return dot(c, vec3({_LUMA_RED}, {1 - _LUMA_RED - _LUMA_BLUE}, {_LUMA_BLUE})); }}
vec2 differences(vec3 mean) {{
    vec2 reach = vec2({2 * (1 - _LUMA_BLUE)}, {2 * (1 - _LUMA_RED)});
    return (128.0 + 224.0 * (mean.br - luma(mean)) / reach) / 255.0;
}}

void main() {{
    int x = 4 * int(gl_FragCoord.x), y = last.y - 2 * int(gl_FragCoord.y);  // OpenGL counts rows from below
    int x2 = min(x + 2, last.x), x3 = min(x + 3, last.x), before = max(x - 1, 0);
    vec3 a = at(x, y), b = at(x + 1, y), c = at(x2, y), d = at(x3, y);
    vec3 e = at(x, y - 1), f = at(x + 1, y - 1), g = at(x2, y - 1), h = at(x3, y - 1);
    vec3 left = at(before, y) + at(before, y - 1), middle = b + f;
    upper = (16.0 + 219.0 * vec4(luma(a), luma(b), luma(c), luma(d))) / 255.0;
    lower = (16.0 + 219.0 * vec4(luma(e), luma(f), luma(g), luma(h))) / 255.0;
    chroma.xy = differences(0.25 * (a + e) + 0.125 * (middle + left));
    chroma.zw = differences(0.25 * (c + g) + 0.125 * (d + h + middle));
}}
"""


class Nv12Reader:
    """Converts one picture after another; all calls are made while its context is the current one.

    A fragment makes eight pixels, which takes a software driver a fifth of the time: luma of even and of odd rows go
    to pictures of their own, and come together as they are read. What was converted is read back when the next
    picture has been put in: a software driver then converts while that one is prepared.
    """

    def __init__(self, ctx: moderngl.Context, picture: moderngl.Texture) -> None:
        width, height = picture.size
        assert width % 2 == height % 2 == 0, "chroma has half the columns and half the rows"
        self._ctx = ctx
        self._picture = picture
        program = ctx.program(_VERTEX, _FRAGMENT)
        program["last"] = width - 1, height - 1
        self._triangle = ctx.vertex_array(program, [])
        fours = (width + 3) // 4, height // 2
        self._free = [ctx.framebuffer([ctx.texture(fours, 4) for _ in range(_PARTS)]) for _ in range(_SETS)]
        self._converted: deque[moderngl.Framebuffer] = deque()
        self._part_bytes = 4 * fours[0] * fours[1]
        self._buffers = [ctx.buffer(reserve=_PARTS * self._part_bytes) for _ in range(_AHEAD)]
        self._waiting: deque[moderngl.Buffer] = deque()

    @property
    def is_full(self) -> bool:
        """Whether the oldest picture must be taken before the next is put in."""
        return not self._buffers

    def put(self) -> None:
        """Convert the picture as it is now, and begin to read back the one before."""
        parts = self._free.pop()
        self._ctx.disable(moderngl.DEPTH_TEST | moderngl.CULL_FACE | moderngl.BLEND)
        parts.use()
        self._picture.use(0)
        self._triangle.render(vertices=3)
        if self._converted:
            self._read()
        self._converted.append(parts)

    def _read(self) -> None:
        """Begin to read back the oldest that was converted: as textures, for which a driver waits for nothing else."""
        parts, buffer = self._converted.popleft(), self._buffers.pop()
        for place, part in enumerate(parts.color_attachments):
            assert isinstance(part, moderngl.Texture)
            part.read_into(buffer, alignment=1, write_offset=place * self._part_bytes)
        self._free.append(parts)
        self._waiting.append(buffer)

    def read(self, into: Planes | None = None) -> Planes | None:
        """The oldest picture that was put in and not read yet, written to `into`; None where there is none."""
        if not self._waiting:
            if not self._converted:
                return None
            self._read()
        buffer = self._waiting.popleft()
        width, height = self._picture.size
        rows = np.frombuffer(buffer.read(), np.uint8).reshape(_PARTS, height // 2, -1)
        upper, lower, chroma = rows[..., :width]
        self._buffers.append(buffer)
        planes = np.empty((height * 3 // 2, width), np.uint8) if into is None else into
        planes[0:height:2], planes[1:height:2], planes[height:] = upper, lower, chroma
        return planes

    def release(self) -> None:
        """Give the driver its memory back."""
        for parts in (*self._free, *self._converted):
            for part in parts.color_attachments:
                part.release()
            parts.release()
        for buffer in (*self._buffers, *self._waiting):
            buffer.release()
        self._triangle.release()

"""Smooth edges for what moves at the lowest quality, after it was drawn with one sample a pixel.

Whatever moves marks its pixels by their opacity, `MOVING`. Where brightness changes about a marked pixel, an edge as
FXAA finds it (Lottes, NVIDIA 2009), the pixel takes half of its neighbours' mean. Four samples a pixel would take four
times as long without a graphics card. Only tiles of the picture where something may move are looked at: `tiles_of`.
"""

import moderngl
import numpy as np
from numpy.typing import NDArray

MOVING = 0.5
"""The opacity that marks a pixel as one of what moves."""
TILE = 16
"""Pixels of a tile's side (our choice: a stick covers few of them, and there are few hundred)."""

_MOST_TILES, _TILE_BYTES = 480 * 270, 4
"""So many cover the largest picture, 7680 × 4320."""

Tiles = NDArray[np.int16]
"""The lower left corners of tiles in pixels, (n, 2)."""

_VERTEX = f"""
#version 330 core
uniform vec2 size;
in ivec2 corner;
void main() {{
    vec2 at = vec2(corner) + float({TILE}) * vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(at / size * 2.0 - 1.0, 0.0, 1.0);
}}
"""

_FRAGMENT = f"""
#version 330 core
uniform sampler2D drawn;
out vec4 shade;

void main() {{
    vec4 here = texelFetch(drawn, ivec2(gl_FragCoord.xy), 0);
    ivec2 at = clamp(ivec2(gl_FragCoord.xy), ivec2(1), textureSize(drawn, 0) - 2);
    vec4 a = texelFetch(drawn, at + ivec2(-1, 1), 0), b = texelFetch(drawn, at + ivec2(1, 1), 0);
    vec4 c = texelFetch(drawn, at - ivec2(1, 1), 0), d = texelFetch(drawn, at + ivec2(1, -1), 0);
    vec2 most = max(max(a.ga, b.ga), max(c.ga, d.ga)), least = min(min(a.ga, b.ga), min(c.ga, d.ga));
    bool is_edge = min(least.y, here.a) < {(MOVING + 1) / 2} && most.x - least.x > 0.06;
    shade = vec4(is_edge ? 0.5 * here.rgb + 0.125 * (a.rgb + b.rgb + c.rgb + d.rgb) : here.rgb, 1.0);
}}
"""


_PARTS = 4
"""Into so many balls the corners of a bone are put, one after the other along it (our choice: a forearm is long)."""


def balls_of(
    bone: NDArray[np.int64], corners: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]:
    """Balls that hold all `corners` (n, 3): their bones in rising order, their middles (m, 4) and radii (m,)."""
    bones, middles, radii = [], [], []
    for one in np.unique(bone):
        own = corners[bone == one]
        longest = int(np.argmax(np.ptp(own, axis=0)))
        cuts = np.linspace(own[:, longest].min(), own[:, longest].max() + 1e-9, _PARTS + 1)
        place = np.searchsorted(cuts, own[:, longest], "right")
        for part in np.unique(place):
            some = own[place == part]
            middle = (some.min(axis=0) + some.max(axis=0)) / 2
            bones.append(one)
            middles.append([*middle, 1.0])
            radii.append(np.linalg.norm(some - middle, axis=1).max() + _SPAN_M)
    return np.array(bones), np.array(middles), np.array(radii)


_SPAN_M = 0.03
"""What lies between corners of two parts may be so far from both, and bends away from its bone (our choice)."""


def tiles_of(middle: NDArray[np.float64], reach: NDArray[np.float64], area: tuple[int, int, int, int]) -> Tiles:
    """The tiles that squares touch: of `middle` (n, 2) and half their sides (n,), all in pixels; within `area`."""
    left, low, width, height = area
    columns, rows = -(-width // TILE), -(-height // TILE)
    corner = np.array([left, low])
    first = np.clip((middle - reach[:, None] - corner) // TILE, 0, [columns, rows]).astype(int)
    last = np.clip((middle + reach[:, None] - corner) // TILE + 1, 0, [columns, rows]).astype(int)
    touched = np.zeros((rows, columns), bool)
    for (x0, y0), (x1, y1) in zip(first.tolist(), last.tolist(), strict=True):
        touched[y0:y1, x0:x1] = True
    return np.asarray(np.argwhere(touched)[:, ::-1] * TILE + corner, np.int16)


class EdgeSmoother:
    """Keeps a copy of the picture to read from while it is written."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._program = ctx.program(_VERTEX, _FRAGMENT)
        self._corners = ctx.buffer(reserve=_MOST_TILES * _TILE_BYTES, dynamic=True)
        self._tiles = ctx.vertex_array(self._program, [(self._corners, "2i2/i", "corner")])
        self._copy: moderngl.Framebuffer | None = None

    def smooth(self, target: moderngl.Framebuffer, tiles: Tiles, area: tuple[int, int, int, int]) -> None:
        """Smooth what moves in `tiles` of `area` of `target`, which has one sample a pixel, and take its marks away."""
        ctx, (width, height) = self._ctx, target.size
        if not len(tiles):
            return
        if self._copy is None or self._copy.size != target.size:
            self.release()
            self._drawn = ctx.texture(target.size, 4)
            self._copy = ctx.framebuffer([self._drawn])
            self._program["size"] = width, height
        ctx.copy_framebuffer(self._copy, target)
        self._drawn.use(0)
        target.use()
        ctx.enable_only(moderngl.NOTHING)
        ctx.viewport, ctx.scissor = (0, 0, width, height), area
        self._corners.write(tiles[:_MOST_TILES].tobytes())
        self._tiles.render(moderngl.TRIANGLE_STRIP, 4, instances=min(len(tiles), _MOST_TILES))
        ctx.scissor = None

    def release(self) -> None:
        """Give the memory back."""
        if self._copy is not None:
            self._copy.release()
            self._drawn.release()
            self._copy = None

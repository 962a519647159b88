"""A crowd behind two drummers: dark outlines before the wall, which move gently with the beat.

Each of them is one upright picture that faces the camera; how far a pixel is from their outline follows in closed form
from a head, a trunk and limbs, so that a crowd costs little and its edges are soft at every size.
"""

from math import cos, radians, sin

import moderngl
import numpy as np
from numpy.typing import NDArray

from station.render.geometry.transforms import Matrix, gl_bytes
from station.render.gpu.scene_parts import write
from station.render.kit.room import CENTRE_Y, WALL_RADIUS_M

_VERTEX = """
#version 330 core
uniform mat4 view_projection;
uniform vec3 eye;
uniform float beat;
in vec3 foot;
in vec4 build;                 // height, breadth, how much they move, and when in the beat
out vec2 v_at;                 // metres from the foot: aside and up
flat out vec2 v_build;
flat out float v_far;          // 0 in the first row, 1 in the second
const float TAU = 6.2831853;

void main() {
    vec2 corner = vec2(float(gl_VertexID & 1) * 2.0 - 1.0, float(gl_VertexID >> 1));
    float height = build.x;
    bool is_board = build.y < 0.0;              // a board stands along the wall, whoever looks
    vec2 size = vec2(is_board ? BOARD_M : 0.48, height + 0.08);
    v_at = corner * size;
    v_build = build.xy;
    v_far = foot.z;
    vec2 to_eye = normalize((is_board ? vec2(0.0, CENTRE_M) : eye.xy) - foot.xy);
    vec3 aside = vec3(-to_eye.y, to_eye.x, 0.0);
    float nod = 0.5 - 0.5 * cos(TAU * (beat + build.w));         // down on the beat
    float sway = sin(0.5 * TAU * (beat + 2.0 * build.w));        // to and fro over two beats
    vec3 at = vec3(foot.xy, LOWER_M) + aside * (v_at.x + 0.02 * build.z * sway * corner.y);
    at.z += v_at.y + (0.022 * build.z * nod + 0.16 * foot.z) * corner.y;
    gl_Position = view_projection * vec4(at, 1.0);
}
"""

_VERTEX = _VERTEX.replace("LOWER_M", "-0.30").replace("CENTRE_M", str(CENTRE_Y)).replace("BOARD_M", "0.095")
"""The crowd stands so much lower than the stage, as crowds do: in the picture heads stay below those who play."""

_FRAGMENT = """
#version 330 core
in vec2 v_at;
flat in vec2 v_build;
flat in float v_far;
out vec4 shade;

float box(vec2 p, vec2 half_size, float round) {
    vec2 q = abs(p) - half_size + round;
    return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - round;
}

float limb(vec2 p, vec2 a, vec2 b, float thick) {
    vec2 pa = p - a, ba = b - a;
    return length(pa - ba * clamp(dot(pa, ba) / dot(ba, ba), 0.0, 1.0)) - thick;
}

vec4 barrier() {                             // before the crowd: a dark board with a rail
    float rail = smoothstep(0.05, 0.02, v_build.x - v_at.y);
    return v_at.y > v_build.x ? vec4(0.0) : vec4(mix(vec3(0.024, 0.027, 0.038), vec3(0.085, 0.095, 0.115), rail), 1.0);
}

void main() {
    if (v_build.y < 0.0) {
        shade = barrier();
        if (shade.a <= 0.0) discard;
        return;
    }
    float top = v_build.x, wide = v_build.y, hip = 0.50 * top, shoulder = top - 0.34;
    vec2 p = vec2(abs(v_at.x), v_at.y);         // both sides alike
    float head = (length((p - vec2(0.0, top - 0.12)) / vec2(0.088, 0.12)) - 1.0) * 0.09;
    float neck = limb(p, vec2(0.0, top - 0.22), vec2(0.0, shoulder), 0.05);
    float slope = limb(p, vec2(0.0, shoulder + 0.03), vec2(wide - 0.05, shoulder - 0.02), 0.055);
    float waist = mix(0.78 * wide, wide, clamp((p.y - hip) / (shoulder - hip), 0.0, 1.0));
    float trunk = box(v_at - vec2(0.0, 0.5 * (hip + shoulder)), vec2(waist, 0.5 * (shoulder - hip) + 0.04), 0.07);
    float arm = limb(p, vec2(wide - 0.03, shoulder - 0.03), vec2(wide + 0.045, hip + 0.08), 0.045);
    float leg = limb(p, vec2(0.45 * wide, hip), vec2(0.52 * wide, 0.06), 0.078);
    float d = min(min(min(head, neck), min(slope, trunk)), min(arm, leg));
    float soft = max(fwidth(v_at.y), 0.004);
    float cover = 1.0 - smoothstep(-soft, soft, d);
    if (cover <= 0.0) discard;
    float rim = smoothstep(-0.035, 0.0, d) * smoothstep(0.8, top, v_at.y);
    vec3 colour = mix(vec3(0.020, 0.023, 0.034), vec3(0.038, 0.045, 0.065), v_far) + rim * vec3(0.035, 0.055, 0.085);
    shade = vec4(colour * cover, cover);
}
"""

_FROM_RAD, _TO_RAD = radians(198), radians(342)
"""The crowd stands along the wall behind the drummers."""
_ROWS = ((0.45, 21, 1.0), (0.95, 19, 0.0))
"""How far from the wall a row stands in metres, how many are in it, and whether it stands a step up, behind (our
choice: enough to fill the wall, and nobody alone)."""
_BARRIER_M, _BARRIER_HIGH_M, _BOARDS = 1.35, 1.05, 61
"""How far from the wall the barrier before them is, how high over where they stand, of how many boards."""
_SEED = 14


def people() -> NDArray[np.float32]:
    """Everybody, those at the wall first, (n, 7): x, y, how far up the step, height, breadth, liveliness, phase.

    Last come the boards of the barrier, of a breadth below 0.
    Heights of standing adults, 1.55–1.90 m; everybody is up to an eighth of a beat off, as crowds are (our choice).
    """
    rng = np.random.default_rng(_SEED)
    rows = []
    for from_wall, count, step in _ROWS:
        for k in range(count):
            share = (k + 0.5 + rng.uniform(-0.28, 0.28)) / count
            angle = _FROM_RAD + (_TO_RAD - _FROM_RAD) * share
            far = WALL_RADIUS_M - from_wall - rng.uniform(0, 0.12)
            build = rng.uniform(1.55, 1.90), rng.uniform(0.19, 0.26), rng.uniform(0.5, 1.0), rng.uniform(-1, 1) / 8
            rows.append((far * cos(angle), CENTRE_Y + far * sin(angle), step, *build))
    far = WALL_RADIUS_M - _BARRIER_M
    boards = np.linspace(_FROM_RAD - 0.1, _TO_RAD + 0.1, _BOARDS)
    rows += [(far * cos(a), CENTRE_Y + far * sin(a), 0.0, _BARRIER_HIGH_M, -1.0, 0.0, 0.0) for a in boards.tolist()]
    return np.array(rows, np.float32)


class Crowd:
    """The crowd, ready to be drawn behind what has been drawn with its depth."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._program = ctx.program(_VERTEX, _FRAGMENT)
        everybody = people()
        self._count = len(everybody)
        buffer = ctx.buffer(everybody.tobytes())
        self._quads = ctx.vertex_array(self._program, [(buffer, "3f 4f/i", "foot", "build")])

    def draw(self, target: moderngl.Framebuffer, clip: Matrix, eye: tuple[float, float, float], beat: float) -> None:
        """Draw everybody into `target`, which is in use, as they are at `beat`; whole numbers are beats."""
        ctx, program = self._ctx, self._program
        write(program, "view_projection", gl_bytes(clip))
        program["eye"], program["beat"] = eye, beat % _BEATS
        ctx.disable(moderngl.CULL_FACE)
        ctx.enable(moderngl.BLEND)
        ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        target.depth_mask = False
        self._quads.render(moderngl.TRIANGLE_STRIP, 4, instances=self._count)
        target.depth_mask = True
        ctx.disable(moderngl.BLEND)
        ctx.enable(moderngl.CULL_FACE)


_BEATS = 2.0
"""After so many beats all moves again as it did."""

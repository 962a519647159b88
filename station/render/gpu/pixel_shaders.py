"""The shaders that light pixel by pixel, and those of the shadow map, GLSL 3.30.

`QUALITY` 0 takes one shadow sample, 1 four, 2 twenty-five. How light falls is `light_shader`'s affair.
"""

from station.render.gpu.light_shader import LIGHT, RIGID_IN, RIPPLE, SKIN_IN

_OUT = """
uniform mat4 view_projection;
uniform mat4 light_projection;
out vec3 v_world;
out vec3 v_normal;
out vec3 v_tangent;
out vec4 v_shadow;
out vec3 v_glow;
out float v_ao;
flat out int v_material;

void place(vec3 world, vec3 normal) {
    v_world = world;
    v_normal = normal;
    v_shadow = light_projection * vec4(world + normalize(normal) * 0.012, 1.0);  // a little off the surface
    gl_Position = view_projection * vec4(world, 1.0);
}
"""

RIGID_VERTEX = (
    "#version 330 core\n"
    + RIGID_IN
    + RIPPLE
    + _OUT
    + """
void main() {
    mat3x4 m = bone_matrix[bone + first_bone];
    vec3 at = position, up = normal.xyz;
    if (normal.w > 0.0) {
        vec4 moved = ripple();
        at += moved.w * up;
        up -= moved.xyz;
    }
    place(vec4(at, 1.0) * m, vec4(up, 0.0) * m);
    v_tangent = vec4(tangent.xyz, 0.0) * m;
    v_glow = bone_glow[bone + first_bone].rgb;
    v_ao = ao;
    v_material = material;
}
"""
)

SKIN_VERTEX = (
    "#version 330 core\n"
    + SKIN_IN
    + _OUT
    + """
void main() {
    mat3x4 m = skinned();
    place(vec4(position, 1.0) * m, vec4(normal.xyz, 0.0) * m);
    v_tangent = vec3(0.0);
    v_glow = vec3(0.0);
    v_ao = ao;
    v_material = material;
}
"""
)

_NOISE = """
float noise() {                             // hides the steps of 8 bits in the dark (Jimenez 2014)
    return (fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5) / 255.0;
}
"""

_SHADOW = """
uniform sampler2DShadow shadow_map;
in vec4 v_shadow;

float lit() {
    vec3 at = v_shadow.xyz / v_shadow.w;
    at.z -= 0.0006;
#if QUALITY == 0
    return texture(shadow_map, at);
#else
    float step = 1.3 / float(textureSize(shadow_map, 0).x), total = 0.0;
#if QUALITY == 1
    for (int i = 0; i < 4; i++)
        total += texture(shadow_map, at + vec3(i & 1, i >> 1, 0) * 2.0 * step - vec3(step, step, 0));
    return total * 0.25;
#else
    for (int x = -2; x <= 2; x++) for (int y = -2; y <= 2; y++)
        total += texture(shadow_map, at + vec3(x, y, 0) * step);
    return total / 25.0;
#endif
#endif
}
"""

ROOM_VERTEX = """
#version 330 core
uniform mat4 view_projection;
uniform mat4 light_projection;
uniform vec3 eye;
uniform vec3 key_at;
in vec3 position;
in vec2 uv;
out vec2 v_uv;
out vec4 v_shadow;
out vec3 v_half;
void main() {
    v_uv = uv;
    v_shadow = light_projection * vec4(position, 1.0);
    v_half = normalize(eye - position) + normalize(key_at - position);
    gl_Position = view_projection * vec4(position, 1.0);
}
"""

WALL_FRAGMENT = (
    "#version 330 core\n"
    + _NOISE
    + """
uniform sampler2D wall_map;
in vec2 v_uv;
out vec4 shade;
void main() { shade = vec4(texture(wall_map, v_uv).rgb + noise(), 1.0); }
"""
)

FLOOR_FRAGMENT = (
    "#version 330 core\n#define QUALITY __QUALITY__\n"
    + _NOISE
    + _SHADOW
    + """
uniform sampler2D floor_map;                // rgb the floor in full light, a the share that only the key light gives
in vec2 v_uv;
out vec4 shade;
void main() {
    vec4 paint = texture(floor_map, v_uv);
    shade = vec4(paint.rgb * (1.0 - paint.a * (1.0 - lit())) + noise(), 1.0);
}
"""
)

_FRAGMENT = (
    "#version 330 core\n#define QUALITY __QUALITY__\n"
    + _NOISE
    + _SHADOW
    + LIGHT
    + """
in vec3 v_world;
in vec3 v_normal;
in vec3 v_tangent;
in vec3 v_glow;
in float v_ao;
flat in int v_material;
out vec4 shade;

void main() {
    vec3 seen = light(v_world, normalize(v_normal), v_tangent, v_ao, v_material, lit(), v_glow);
    shade = vec4(seen + noise(), 1.0);
}
"""
)

SHADOW_FRAGMENT = "#version 330 core\nvoid main() {}\n"

_SHADOW_PLACE = """
uniform mat4 light_projection;
void place(vec3 world) { gl_Position = light_projection * vec4(world, 1.0); }
"""

RIGID_SHADOW = (
    "#version 330 core\n"
    + RIGID_IN
    + _SHADOW_PLACE
    + "void main() { place(vec4(position, 1.0) * bone_matrix[bone + first_bone]); }\n"
)

SKIN_SHADOW = (
    "#version 330 core\n" + SKIN_IN + _SHADOW_PLACE + "void main() { place(vec4(position, 1.0) * skinned()); }\n"
)


def solid_fragment(quality: int) -> str:
    """The fragment shader of kit and figure at quality 0, 1 or 2."""
    return _FRAGMENT.replace("__QUALITY__", str(quality))


def floor_fragment(quality: int) -> str:
    """The fragment shader of the floor at quality 0, 1 or 2."""
    return FLOOR_FRAGMENT.replace("__QUALITY__", str(quality))

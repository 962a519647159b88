"""Shaders that light corner by corner, GLSL 3.30: for what moves at the lowest quality, and for the student's double.

Without a graphics card a pixel is dear and a corner cheap. No shadow falls on what they draw.
"""

from station.render.figure.bones import Bone
from station.render.gpu.light_shader import LIGHT, RIGID_IN, SKIN_IN

_HEAD = "#version 330 core\n#define QUALITY 0\n"
_OUT = (
    LIGHT
    + """
uniform mat4 view_projection;
out vec4 v_seen;                            // premultiplied
"""
)

_LIT = (
    _OUT
    + """
void place(vec3 world, vec3 normal, vec3 tangent, vec3 glow) {
    v_seen = vec4(light(world, normalize(normal), tangent, ao, material, 1.0, glow), 1.0);
    gl_Position = view_projection * vec4(world, 1.0);
}
"""
)

_GLOWING = (
    _OUT
    + """
void place(vec3 world, vec3 normal, vec3 tangent, vec3 glow) {
    float view = max(dot(normalize(normal), normalize(eye - world)), 0.0);
    vec3 seen = film(glow * (0.35 + 0.65 * view) * (0.6 * look_a[material].rgb + 0.25));
    v_seen = vec4(seen, 0.55 * min(max(glow.r, max(glow.g, glow.b)), 1.0));
    gl_Position = view_projection * vec4(world, 1.0);
}
"""
)

_NEARER_M = 0.08
"""The double's depth is so much nearer than it is: an arm within the demonstrator's is seen whole (our choice)."""

_GHOSTLY = (
    _OUT
    + f"""
uniform vec3 tint;
uniform float opacity;
float fade = 1.0;
void place(vec3 world, vec3 normal, vec3 tangent, vec3 glow) {{
    vec3 to_eye = normalize(eye - world);
    float graze = 1.0 - max(dot(normalize(normal), to_eye), 0.0);
    float strength = max(glow.r, max(glow.g, glow.b));
    float share = fade * clamp(opacity * (0.55 + 0.9 * graze) + 0.6 * strength, 0.0, 1.0);
    v_seen = vec4(mix(tint, glow / max(strength, 1e-3), min(strength, 1.0)) * (0.55 + 0.45 * graze) * share, share);
    gl_Position = view_projection * vec4(world, 1.0);
    vec4 nearer = view_projection * vec4(world + {_NEARER_M} * to_eye, 1.0);
    gl_Position.z = nearer.z / nearer.w * gl_Position.w;
}}
"""
)

_RIGID_MAIN = """
void main() {
    mat3x4 m = bone_matrix[bone + first_bone];
    vec3 glow = bone_glow[bone + first_bone].rgb;
    place(vec4(position, 1.0) * m, vec4(normal.xyz, 0.0) * m, vec4(tangent.xyz, 0.0) * m, glow);
}
"""

_SKIN_MAIN = """
void main() {
    mat3x4 m = roughly_skinned();
    place(vec4(position, 1.0) * m, vec4(normal.xyz, 0.0) * m, vec3(0.0), vec3(0.0));
}
"""

_SKIN_GHOST_MAIN = f"""
void main() {{
    mat3x4 m = skinned();
    fade = clamp(2.0 * dot(vec4(greaterThan(bones, ivec4({int(Bone.HEAD)}))), weights) - 1.0, 0.0, 1.0);  // limbs alone
    vec3 glow = bone_glow[bones.x + first_bone].rgb * weights.x + bone_glow[bones.y + first_bone].rgb * weights.y
              + bone_glow[bones.z + first_bone].rgb * weights.z + bone_glow[bones.w + first_bone].rgb * weights.w;
    place(vec4(position, 1.0) * m, vec4(normal.xyz, 0.0) * m, vec3(0.0), glow);
}}
"""

RIGID_QUICK = _HEAD + RIGID_IN + _LIT + _RIGID_MAIN
SKIN_QUICK = _HEAD + SKIN_IN + _LIT + _SKIN_MAIN
RIGID_GLOW = _HEAD + RIGID_IN + _GLOWING + _RIGID_MAIN
RIGID_GHOST = _HEAD + RIGID_IN + _GHOSTLY + _RIGID_MAIN
SKIN_GHOST = _HEAD + SKIN_IN + _GHOSTLY + _SKIN_GHOST_MAIN

QUICK_FRAGMENT = """
#version 330 core
in vec4 v_seen;
out vec4 shade;
void main() { shade = v_seen; }
"""

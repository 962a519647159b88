"""The shaders that light kit and figure pixel by pixel, and those of the shadow map, GLSL 3.30.

How light falls is `light_shader`'s affair, how shadows do `shadow_shader`'s.
"""

from station.render.gpu.light_shader import LIGHT, RIGID_IN, RIPPLE, SKIN_IN
from station.render.gpu.shadow_shader import NOISE, SHADOW

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

_FRAGMENT = (
    "#version 330 core\n#define QUALITY __QUALITY__\n"
    + NOISE
    + SHADOW
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

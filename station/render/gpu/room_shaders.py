"""The shaders of the room, GLSL 3.30: boards, a rug, and a wall with stage lights.

What is painted on the floor comes from `kit.floor_paint`, how light falls on it from `kit.room.floor_light`.
"""

from station.render.gpu.light_shader import FILM
from station.render.gpu.shadow_shader import NOISE, SHADOW
from station.render.kit.room import CENTRE_Y, FLOOR_HALF_M

_VERTEX = """
#version 330 core
#define LIGHTS __LIGHTS__
uniform mat4 view_projection;
uniform mat4 light_projection;
#if LIGHTS == 2
uniform mat4 light_projection_2;
out vec4 v_shadow_2;
#endif
in vec3 position;
in vec2 uv;                                 // on the wall's picture, or in tiles of what is painted on the floor
out vec2 v_uv;
out vec3 v_world;
out vec4 v_shadow;
void main() {
    v_uv = uv;
    v_world = position;
    v_shadow = light_projection * vec4(position, 1.0);
#if LIGHTS == 2
    v_shadow_2 = light_projection_2 * vec4(position, 1.0);
#endif
    gl_Position = view_projection * vec4(position, 1.0);
}
"""

_SHADOW_2 = SHADOW.replace("shadow_map", "shadow_map_2").replace("v_shadow", "v_shadow_2").replace("lit()", "lit_2()")
"""The same of a second light."""

_FLOOR_FRAGMENT = (
    "#version 330 core\n#define QUALITY __QUALITY__\n#define VARNISH __VARNISH__\n#define LIGHTS __LIGHTS__\n"
    + NOISE
    + SHADOW
    + "#if LIGHTS == 2\n"
    + _SHADOW_2
    + "#endif\n"
    + FILM
    + f"""
const float LIGHT_SCALE = {0.5 / FLOOR_HALF_M};
const vec2 LIGHT_SHIFT = vec2(0.5, {0.5 - 0.5 * CENTRE_Y / FLOOR_HALF_M});
"""
    + """
#if QUALITY == 1
const float SHARPER = -0.6;                 // instead of anisotropic filtering
#else
const float SHARPER = 0.0;
#endif
uniform sampler2D paint_map;
uniform sampler2D light_map;                // shares of the key, of open sky, of the warm and of the cool lamps' light
#if LIGHTS == 2
uniform sampler2D light_map_2;              // the second key's light in its first channel
uniform vec3 key_at_2;
uniform vec2 shares;                        // how much each key shines
#endif
uniform vec3 eye;
uniform vec3 key_at;
uniform vec3 key_colour;
uniform vec3 rim_colour;
uniform vec3 sky;
uniform vec3 warm_colour;
in vec2 v_uv;
in vec3 v_world;
out vec4 shade;

// how a varnished floor mirrors a key at `at`
float shine(vec3 to_eye, vec3 at) {
    vec3 to_key = normalize(at - v_world);
    float up = to_eye.z + to_key.z;
    float shine = up * up / (2.0 + 2.0 * dot(to_eye, to_key));  // the squared cosine between half vector and floor
    shine *= shine * shine, shine *= shine;
    return shine;
}

void main() {
    vec3 colour = texture(paint_map, abs(v_uv), SHARPER).rgb;
    vec2 on_map = v_world.xy * LIGHT_SCALE + LIGHT_SHIFT;
    vec4 falls = texture(light_map, on_map);
    colour *= colour;
    float keys = falls.r * lit();
#if LIGHTS == 2
    keys = keys * shares.x + texture(light_map_2, on_map).r * lit_2() * shares.y;
#endif
    vec3 key = key_colour * keys, lamps = warm_colour * falls.b + rim_colour * falls.a;
    vec3 seen = colour * (key + sky * falls.g + lamps);
#if VARNISH
    vec3 to_eye = normalize(eye - v_world);
    float graze = 1.0 - to_eye.z, mirrored = shine(to_eye, key_at);
#if LIGHTS == 2
    mirrored = max(mirrored * shares.x, shine(to_eye, key_at_2) * shares.y);
#endif
    seen += key * mirrored * 0.06 + lamps * graze * graze * 0.22;
#endif
    shade = vec4(film(seen) + noise(), 1.0);
}
"""
)

WALL_FRAGMENT = (
    "#version 330 core\n"
    + NOISE
    + """
uniform sampler2D wall_map;
in vec2 v_uv;
out vec4 shade;
void main() { shade = vec4(texture(wall_map, v_uv).rgb + noise(), 1.0); }
"""
)


def room_vertex(lights: int) -> str:
    """The vertex shader of all the room, for one light or two."""
    return _VERTEX.replace("__LIGHTS__", str(lights))


def floor_fragment(quality: int, *, is_varnished: bool, lights: int = 1) -> str:
    """The fragment shader of the floor at quality 0, 1 or 2: varnished boards, or cloth; under one light or two."""
    words = {"__QUALITY__": quality, "__VARNISH__": int(is_varnished), "__LIGHTS__": lights}
    shader = _FLOOR_FRAGMENT
    for name, value in words.items():
        shader = shader.replace(name, str(value))
    return shader

"""The shaders of the room, GLSL 3.30: boards, a rug, and a wall with stage lights.

What is painted on the floor comes from `kit.floor_paint`, how light falls on it from `kit.room.floor_light`.
"""

from station.render.gpu.light_shader import FILM
from station.render.gpu.shadow_shader import NOISE, SHADOW
from station.render.kit.room import CENTRE_Y, FLOOR_HALF_M

ROOM_VERTEX = """
#version 330 core
uniform mat4 view_projection;
uniform mat4 light_projection;
in vec3 position;
in vec2 uv;                                 // on the wall's picture, or in tiles of what is painted on the floor
out vec2 v_uv;
out vec3 v_world;
out vec4 v_shadow;
void main() {
    v_uv = uv;
    v_world = position;
    v_shadow = light_projection * vec4(position, 1.0);
    gl_Position = view_projection * vec4(position, 1.0);
}
"""

FLOOR_FRAGMENT = (
    "#version 330 core\n#define QUALITY __QUALITY__\n#define VARNISH __VARNISH__\n"
    + NOISE
    + SHADOW
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
uniform vec3 eye;
uniform vec3 key_at;
uniform vec3 key_colour;
uniform vec3 rim_colour;
uniform vec3 sky;
uniform vec3 warm_colour;
in vec2 v_uv;
in vec3 v_world;
out vec4 shade;
void main() {
    vec3 colour = texture(paint_map, abs(v_uv), SHARPER).rgb;
    vec4 falls = texture(light_map, v_world.xy * LIGHT_SCALE + LIGHT_SHIFT);
    colour *= colour;
    vec3 key = key_colour * (falls.r * lit()), lamps = warm_colour * falls.b + rim_colour * falls.a;
    vec3 seen = colour * (key + sky * falls.g + lamps);
#if VARNISH
    vec3 to_eye = normalize(eye - v_world), to_key = normalize(key_at - v_world);
    float up = to_eye.z + to_key.z, graze = 1.0 - to_eye.z;
    float shine = up * up / (2.0 + 2.0 * dot(to_eye, to_key));  // the squared cosine between half vector and floor
    shine *= shine * shine, shine *= shine;
    seen += key * shine * 0.06 + lamps * graze * graze * 0.22;
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


def floor_fragment(quality: int, *, is_varnished: bool) -> str:
    """The fragment shader of the floor at quality 0, 1 or 2: varnished boards, or cloth."""
    return FLOOR_FRAGMENT.replace("__QUALITY__", str(quality)).replace("__VARNISH__", str(int(is_varnished)))

"""The shaders of the scene, GLSL 3.30.

One fragment shader lights everything: a key spotlight with a shadow map, a cool rim light from behind, a sky that is
brighter above than below, and for varnish and metal a made-up studio of soft boxes to mirror. Highlights follow Blinn
and Phong, stretched along the tangent for lathe-cut metal (Kajiya and Kay); Fresnel after Schlick; the film curve is
Hejl and Burgess-Dawson's, which includes the screen's gamma. `QUALITY` 0 takes one shadow sample, 1 four, 2 nine.
"""

from station.render.materials import Material

MAX_BONES = 128
"""Matrices in the palette; 128 of 5 × vec4 fit the 16 KiB that every OpenGL 3.3 grants a block."""

_BONES = f"""
layout(std140) uniform Bones {{
    mat4 bone_matrix[{MAX_BONES}];
    vec4 bone_glow[{MAX_BONES}];
}};
"""

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
    + _BONES
    + _OUT
    + """
in vec3 position;
in vec4 normal;
in vec4 tangent;
in int bone;
in int material;
in float ao;

void main() {
    mat4 m = bone_matrix[bone];
    place((m * vec4(position, 1.0)).xyz, mat3(m) * normal.xyz);
    v_tangent = mat3(m) * tangent.xyz;
    v_glow = bone_glow[bone].rgb;
    v_ao = ao;
    v_material = material;
}
"""
)

SKIN_VERTEX = (
    "#version 330 core\n"
    + _BONES
    + _OUT
    + """
in vec3 position;
in vec4 normal;
in ivec4 bones;
in vec4 weights;
in int material;
in float ao;

void main() {
    mat4 m = bone_matrix[bones.x] * weights.x + bone_matrix[bones.y] * weights.y
           + bone_matrix[bones.z] * weights.z + bone_matrix[bones.w] * weights.w;
    place((m * vec4(position, 1.0)).xyz, mat3(m) * normal.xyz);
    v_tangent = vec3(0.0);
    v_glow = vec3(0.0);
    v_ao = ao;
    v_material = material;
}
"""
)

_FILM = """
vec3 film(vec3 c) {
    c = max(vec3(0.0), c - 0.004);
    return (c * (6.2 * c + 0.5)) / (c * (6.2 * c + 1.7) + 0.06);
}

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
    + _FILM
    + """
uniform sampler2D wall_map;
in vec2 v_uv;
out vec4 shade;
void main() { shade = vec4(texture(wall_map, v_uv).rgb + noise(), 1.0); }
"""
)

FLOOR_FRAGMENT = (
    "#version 330 core\n#define QUALITY __QUALITY__\n"
    + _FILM
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
    + _FILM
    + _SHADOW
    + f"""
uniform vec4 look_a[{len(Material)}];      // linear colour, roughness
uniform vec4 look_b[{len(Material)}];      // metal, coat + 2 emission, grain, sheen
uniform vec3 eye;
uniform vec3 key_at;
uniform vec3 key_axis;
uniform vec3 key_colour;
uniform vec3 rim_way;
uniform vec3 rim_colour;
uniform vec3 sky;
uniform vec3 ground;
uniform float opacity;
uniform vec3 tint;

in vec3 v_world;
in vec3 v_normal;
in vec3 v_tangent;
in vec3 v_glow;
in float v_ao;
flat in int v_material;
out vec4 shade;

vec3 studio(vec3 r, float blur) {{            // what a mirror would show: dark floor, dim sky, two soft boxes
    float up = r.z * 0.5 + 0.5;
    vec3 light = mix(ground * 0.8, sky * 1.6, up * up);
#if QUALITY == 0
    return light + key_colour * 0.16 * smoothstep(0.60, 1.0, dot(r, vec3(0.5500, 0.6000, 0.5809)));
#else
    float box = smoothstep(0.72 - blur * 0.5, 0.86 + blur * 0.3, dot(r, vec3(0.5500, 0.6000, 0.5809)));
    float strip = smoothstep(0.10 + blur * 0.3, 0.0, abs(r.z - 0.42 - 0.25 * r.x)) * smoothstep(-0.2, 0.7, -r.y);
    float back = smoothstep(0.16 + blur * 0.3, 0.0, abs(r.z - 0.30 + 0.15 * r.x)) * smoothstep(0.0, 0.9, r.y);
    return light + key_colour * 0.16 * box + rim_colour * 0.22 * strip + key_colour * 0.075 * back;
#endif
}}

void main() {{
    vec4 a = look_a[v_material], b = look_b[v_material];
    vec3 colour = a.rgb;
    vec3 n = normalize(v_normal), to_eye = normalize(eye - v_world);
    vec3 to_key = key_at - v_world;
    float distance_2 = dot(to_key, to_key);
    to_key *= inversesqrt(distance_2);
    float spot = smoothstep(0.70, 0.93, dot(-to_key, key_axis));
    vec3 key = key_colour * (spot * 9.0 / (distance_2 + 1.0));
    float facing = dot(n, to_key);
    float sheen = b.w, metal = b.x;
    float wrap = 0.30 * sheen;
    float direct = max((facing + wrap) / (1.0 + wrap), 0.0) * lit();
    float from_rim = max(dot(n, rim_way) + 0.15, 0.0) * 0.87;
    vec3 ambient = mix(ground, sky, n.z * 0.5 + 0.5) * v_ao;
    float view = max(dot(n, to_eye), 0.0);
    float graze = 1.0 - view;
    float graze_2 = graze * graze, fresnel = graze_2 * graze_2 * graze;

    vec3 diffuse = colour * (1.0 - metal) * (key * direct + rim_colour * from_rim * v_ao + ambient);
    diffuse += colour * sheen * graze_2 * graze * (ambient * 2.2 + rim_colour * from_rim * 0.8 + key * direct * 0.25);

    float smooth_2 = 1.0 - a.w;
    float power = exp2(10.0 * smooth_2 + 1.0);
    vec3 half_key = normalize(to_key + to_eye), half_rim = normalize(rim_way + to_eye);
    vec2 cosine = max(vec2(dot(n, half_key), dot(n, half_rim)), 0.0);
    // grooves: bright where the half vector lies across them
    vec2 along = vec2(dot(v_tangent, half_key), dot(v_tangent, half_rim));
    vec2 across = sqrt(max(1.0 - along * along, 0.0));
    cosine = mix(cosine, across * (0.55 + 0.45 * cosine), b.z);
    vec2 highlight = exp2(power * 1.4427 * (cosine - 1.0)) * (power * 0.04 + 0.35);
    float coat = b.y > 1.5 ? 0.0 : b.y, gloss = max(coat, metal);
    vec3 mirror = mix(vec3(0.04 + 0.10 * coat), colour, metal);
    mirror += (1.0 - mirror) * fresnel * (1.0 - 0.6 * a.w) * gloss;
    vec3 glints = key * (direct * highlight.x) + rim_colour * (from_rim * highlight.y);
    vec3 mirrored = studio(reflect(-to_eye, n), a.w) * (0.35 + 0.65 * v_ao) * gloss;
    vec3 total = diffuse + mirror * (glints * max(gloss, 0.35 * smooth_2) + mirrored);
    total += b.y > 1.5 ? colour * 2.5 : vec3(0.0);
    float glow = max(v_glow.r, max(v_glow.g, v_glow.b));
    total = total * (1.0 - 0.8 * min(glow, 1.0)) + v_glow * (0.35 + 0.65 * view) * (0.6 * colour + 0.25);
    total = mix(total, tint * (0.25 + 0.9 * graze), 1.0 - opacity);
    shade = vec4((film(total) + noise()) * opacity, opacity);
}}
"""
)

SHADOW_FRAGMENT = "#version 330 core\nvoid main() {}\n"

_SHADOW_PLACE = """
uniform mat4 light_projection;
void place(vec3 world) { gl_Position = light_projection * vec4(world, 1.0); }
"""

RIGID_SHADOW = (
    "#version 330 core\n"
    + _BONES
    + _SHADOW_PLACE
    + "in vec3 position;\nin int bone;\nvoid main() { place((bone_matrix[bone] * vec4(position, 1.0)).xyz); }\n"
)

SKIN_SHADOW = (
    "#version 330 core\n"
    + _BONES
    + _SHADOW_PLACE
    + """
in vec3 position;
in ivec4 bones;
in vec4 weights;
void main() {
    mat4 m = bone_matrix[bones.x] * weights.x + bone_matrix[bones.y] * weights.y
           + bone_matrix[bones.z] * weights.z + bone_matrix[bones.w] * weights.w;
    place((m * vec4(position, 1.0)).xyz);
}
"""
)


def solid_fragment(quality: int) -> str:
    """The fragment shader of kit and figure at quality 0, 1 or 2."""
    return _FRAGMENT.replace("__QUALITY__", str(quality))


def floor_fragment(quality: int) -> str:
    """The fragment shader of the floor at quality 0, 1 or 2."""
    return FLOOR_FRAGMENT.replace("__QUALITY__", str(quality))

"""What all shaders of solids share, GLSL 3.30: the bones that carry corners, and how a point of a surface is lit.

A key spotlight with a shadow map, a cool rim light from behind, a sky that is brighter above than below, and for
varnish and metal a made-up studio of soft boxes to mirror. Highlights follow Blinn and Phong, stretched along the
tangent for lathe-cut metal (Kajiya and Kay); Fresnel after Schlick. The film curve is Reinhard's extended one (2002),
whose white lies at about three times the key light; a square root brings it to the screen, as materials' colours are
squared to make them light, and two fifths of a smooth step give it contrast. A shader that takes this in defines
`QUALITY` first.
"""

from station.render.geometry.materials import Material

MAX_BONES = 250
"""Matrices in the palette: with the ripples the 16 KiB that every OpenGL 3.3 grants a block."""

RIPPLING_BONES = 24
"""The first bones alone may be drums: one more than there are pieces in a kit, rounded up."""

_BONES = f"""
layout(std140) uniform Bones {{
    mat3x4 bone_matrix[{MAX_BONES}];         // the upper three rows, so that a row vector goes before it
    vec4 bone_glow[{MAX_BONES}];             // and since when a head ripples, seconds
    vec4 bone_ripple[{RIPPLING_BONES}];             // where a head was struck, and how deep
}};
uniform int first_bone;                     // where the bones of what is drawn begin
"""

RIGID_IN = (
    _BONES
    + """
in vec3 position;
in vec4 normal;                             // and how freely the corner moves when its head is struck, 0-1
in vec4 tangent;
in int bone;
in int material;
in float ao;
"""
)

RIPPLE = (
    """
// how far a struck head's corner is moved along its normal, and how that changes across the head
vec4 ripple() {
    vec4 struck = bone_ripple[bone];
    float since = bone_glow[bone].w;
    vec3 away = position - struck.xyz;
    float r = length(away), u = (r - RING_M_S * since) / RING_M;
    float bell = exp(-u * u);
    float depth = struck.w * normal.w * since / (since + RISE_S);
    float slope = depth * bell * u * (6.0 - 4.0 * u * u) / RING_M;
    return vec4(away / max(r, 1e-4) * slope * SHADED, -depth * bell * (1.0 - 2.0 * u * u));
}
""".replace("RING_M_S", "1.6")
    .replace("RING_M", "0.032")
    .replace("RISE_S", "0.008")
    .replace("SHADED", "5.0")
)
"""One ring that runs outward from the struck point; nothing at the instant of the stroke, when the tip is on the head.

The real wave crosses a head in two milliseconds: ours is so slow and broad that pictures show it, and shaded as if it
were five times steeper, for heads are white (our choice, by eye).
"""

SKIN_IN = (
    _BONES
    + """
in vec3 position;
in vec4 normal;
in ivec4 bones;
in vec4 weights;
in int material;
in float ao;

mat3x4 skinned() {
    return bone_matrix[bones.x + first_bone] * weights.x + bone_matrix[bones.y + first_bone] * weights.y
         + bone_matrix[bones.z + first_bone] * weights.z + bone_matrix[bones.w + first_bone] * weights.w;
}

mat3x4 roughly_skinned() {                  // by the two strongest bones: within a few millimetres
    return (bone_matrix[bones.x + first_bone] * weights.x + bone_matrix[bones.y + first_bone] * weights.y)
         / (weights.x + weights.y);
}
"""
)

FILM = """
vec3 film(vec3 c) {                         // to the screen: a curve that leaves the dark its drawing
    c = min(sqrt(c * (1.0 + c * 0.12) / (0.80 + c)), 1.0);
    return c * (0.60 + c * (1.20 - 0.80 * c));
}
"""

LIGHT = (
    FILM
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

// what a point at `world` with the unit normal `n` sends to the eye, `lit` being the share of the key light it gets
vec3 light(vec3 world, vec3 n, vec3 tangent, float ao, int material, float lit, vec3 glowing) {{
    vec4 a = look_a[material], b = look_b[material];
    vec3 colour = a.rgb;
    vec3 to_eye = normalize(eye - world);
    vec3 to_key = key_at - world;
    float distance_2 = dot(to_key, to_key);
    to_key *= inversesqrt(distance_2);
    float spot = smoothstep(0.70, 0.93, dot(-to_key, key_axis));
    vec3 key = key_colour * (spot * 9.0 / (distance_2 + 1.0));
    float facing = dot(n, to_key);
    float sheen = b.w, metal = b.x;
    float wrap = 0.30 * sheen;
    float direct = max((facing + wrap) / (1.0 + wrap), 0.0) * lit;
    float from_rim = max(dot(n, rim_way) + 0.15, 0.0) * 0.87;
    vec3 ambient = mix(ground, sky, n.z * 0.5 + 0.5) * ao;
    float view = max(dot(n, to_eye), 0.0);
    float graze = 1.0 - view;
    float graze_2 = graze * graze, fresnel = graze_2 * graze_2 * graze;

    vec3 diffuse = colour * (1.0 - metal) * (key * direct + rim_colour * from_rim * ao + ambient);
    diffuse += colour * sheen * graze_2 * graze * (ambient * 2.2 + rim_colour * from_rim * 0.8 + key * direct * 0.25);

    float smooth_2 = 1.0 - a.w;
    float power = exp2(10.0 * smooth_2 + 1.0);
    vec3 half_key = normalize(to_key + to_eye), half_rim = normalize(rim_way + to_eye);
    vec2 cosine = max(vec2(dot(n, half_key), dot(n, half_rim)), 0.0);
    // grooves: bright where the half vector lies across them
    vec2 along = vec2(dot(tangent, half_key), dot(tangent, half_rim));
    vec2 across = sqrt(max(1.0 - along * along, 0.0));
    cosine = mix(cosine, across * (0.55 + 0.45 * cosine), b.z);
    vec2 highlight = exp2(power * 1.4427 * (cosine - 1.0)) * (power * 0.04 + 0.35);
    float coat = b.y > 1.5 ? 0.0 : b.y, gloss = max(coat, metal);
    vec3 mirror = mix(vec3(0.04 + 0.10 * coat), colour, metal);
    mirror += (1.0 - mirror) * fresnel * (1.0 - 0.6 * a.w) * gloss;
    vec3 glints = key * (direct * highlight.x) + rim_colour * (from_rim * highlight.y * 0.35);
    vec3 mirrored = studio(reflect(-to_eye, n), a.w) * (0.35 + 0.65 * ao) * gloss;
    vec3 total = diffuse + mirror * (glints * max(gloss, 0.35 * smooth_2) + mirrored);
    total += b.y > 1.5 ? colour * 2.5 : vec3(0.0);
    float glow = max(glowing.r, max(glowing.g, glowing.b));
    return film(total * (1.0 - 0.55 * min(glow, 1.0)) + glowing * (0.35 + 0.65 * view) * (0.6 * colour + 0.25));
}}
"""
)

"""What shaders share that light pixel by pixel, GLSL 3.30: noise against banding, and the key light's soft shadows.

`QUALITY` 0 takes one sample of the shadow map, 1 four, 2 sixteen on a disc that is turned from pixel to pixel.
"""

NOISE = """
float pixel_random() { return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))); }
float noise() { return (pixel_random() - 0.5) / 255.0; }  // hides the steps of 8 bits in the dark (Jimenez 2014)
"""

SHADOW = """
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

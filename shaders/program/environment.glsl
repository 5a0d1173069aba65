/* SPDX-License-Identifier: MIT */
/* environment.glsl - ambient light from far away: the responses of lobes to its coefficients (lmp_environment),
 * and what is seen of it. */
#include "texels.glsl"

/* red, green, blue of coefficient l² + l + m, windowed: surroundings.w of them; then as many that
 * are not windowed, for tables and the diffuse lobe; then, in x, the matrices of a quarter turn
 * about x. surroundings.x: bands */
TEXELS(environment_block, environment_sh, SHARED_ENVIRONMENT)

int environment_whole() {
    return int(surroundings.w);
}

int environment_tilts() {
    return 2 * int(surroundings.w);
}
layout(binding = SHARED_BACKDROP) uniform sampler2D backdrop_map;

/* Returns the response of a Phong lobe of integral 1 around an axis to the coefficients from
 * `first` on; with exponent 1 it is the diffuse lobe. Its factors fall by two bands at a time,
 * lambda_l = lambda_(l-2) (e - l + 2) / (e + l + 1), and each column m begins with the factors of l
 * = m. */
vec3 environment_response(int first, vec3 axis, float exponent) {
    int bands = int(surroundings.x);
    vec3 sum = vec3(0.0);
    float diagonal = 0.28209479, c = 1.0, s = 0.0;
    float lambda0 = 1.0, lambda1 = (exponent + 1.0) / (exponent + 2.0);
    for (int m = 0; m < bands; m++) {
        float q0 = 0.0, q1 = diagonal, before = lambda0, next = lambda1;
        vec3 cosine = vec3(0.0), sine = vec3(0.0);
        for (int l = m; l < bands; l++) {
            int at = first + l * l + l;
            cosine += TEXEL(environment_sh, at + m).rgb * (q1 * before);
            if (m > 0)
                sine += TEXEL(environment_sh, at - m).rgb * (q1 * before);
            float k = float(l + 1), mm = float(m * m);
            float scale = inversesqrt(k * k - mm);
            float a = sqrt(4.0 * k * k - 1.0) * scale;
            float b = l == m ? 0.0
                             : sqrt((2.0 * k + 1.0) * (float(l * l) - mm) / (2.0 * k - 3.0)) * scale;
            float q2 = a * axis.z * q1 - b * q0;
            q0 = q1;
            q1 = q2;
            float following = before * (exponent - float(l)) / (exponent + float(l + 3));
            before = next;
            next = following;
        }
        sum += cosine * c + sine * s;
        float rotated = axis.x * c - axis.y * s;
        s = axis.x * s + axis.y * c;
        c = rotated;
        diagonal *= m == 0 ? -sqrt(3.0) : -sqrt(float(2 * m + 3) / float(2 * m + 2));
        float following = lambda0 * (exponent - float(m)) / (exponent + float(m + 3));
        lambda0 = lambda1;
        lambda1 = following;
    }
    return sum;
}

vec3 environment_shade(lmp_surface surface, lmp_lobes lobes) {
    if (surroundings.x == 0.0)
        return vec3(0.0);
#ifdef SHADE_WINDOWS_DIFFUSE
    int first = 0;
#else
    int first = environment_whole();
#endif
    vec3 sum = lobes.diffuse * environment_response(first, surface.normal, 1.0);
    do {
        for (int k = 0; k < LMP_LOBES; k++)
            sum += lobes.weight[k] * environment_response(0, lobes.axis[k], lobes.exponent[k]);
    } while (lmp_lobes_next(lobes));
    return max(sum, vec3(0.0));
}

/* Returns the background seen along w, as the program's environment_seen does. */
vec3 environment_seen(vec3 w) {
    if (surroundings.z == 0.0)
        return background.rgb;
    ivec2 size = textureSize(backdrop_map, 0);
    vec2 angles = vec2(atan(w.z, w.x) - surroundings.y, atan(length(w.xz), w.y));
    float turns = angles.x / (2.0 * LMP_PI) + 0.5;
    vec2 at = vec2(fract(turns), angles.y / LMP_PI) * vec2(size) - 0.5;
    at.y = clamp(at.y, 0.0, float(size.y - 1));
    vec2 corner = floor(at), between = at - corner;
    int left = corner.x < 0.0 ? size.x - 1 : int(corner.x), right = left + 1 == size.x ? 0 : left + 1;
    int top = int(corner.y), bottom = min(top + 1, size.y - 1);
    return mix(mix(texelFetch(backdrop_map, ivec2(left, top), 0).rgb,
                   texelFetch(backdrop_map, ivec2(right, top), 0).rgb, between.x),
               mix(texelFetch(backdrop_map, ivec2(left, bottom), 0).rgb,
                   texelFetch(backdrop_map, ivec2(right, bottom), 0).rgb, between.x),
               between.y);
}

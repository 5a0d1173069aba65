/* SPDX-License-Identifier: MIT */
/* preintegrated_lobe.glsl - shading from a response (lampion/preintegrated.h): two readings a light, whatever the
 * number of bands. Include it after lampion.glsl.
 *
 * Put the cells' pairs into a texture of two signed normalized 16-bit channels, `columns` texels a
 * row, cells side by side as you like. Define before including, the rest of what
 * lmp_preintegrated_lobe_describe returns:
 *   LMP_PREINTEGRATED_LOBE_PAIR(p)   vec2: the texture at p, filtered linearly; texel centers at .5
 *   LMP_PREINTEGRATED_LOBE_CELL(i)   vec4: scale and offset of cell i; x and y of its first texel
 *   LMP_PREINTEGRATED_LOBE_REMAP(i)   float: entry i of the warp, 0 … 320
 *   LMP_PREINTEGRATED_LOBE_SHAPE     vec4: width2, the number of cells */
#ifndef LAMPION_PREINTEGRATED_GLSL
#define LAMPION_PREINTEGRATED_GLSL

/* Of a coefficient read as -1 … 1. */
#define LMP_PREINTEGRATED_LOBE_UNIT 2.0

/* As in lampion/preintegrated.h. */
#define LMP_PREINTEGRATED_LOBE_EXPONENT_MAX 1048575.0

/* Where the lobe of an exponent lies. */
struct lmp_place {
    vec2 corner;
    float share, density, angle;
};

lmp_place lmp_preintegrated_lobe_lookup(float exponent) {
    float e = clamp(exponent, 0.0, LMP_PREINTEGRATED_LOBE_EXPONENT_MAX);
    float entry = float(floatBitsToInt(1.0 + e) - floatBitsToInt(1.0)) / 524288.0;
    int i = int(min(entry, 319.0));
    float slice = mix(LMP_PREINTEGRATED_LOBE_REMAP(i), LMP_PREINTEGRATED_LOBE_REMAP(i + 1), entry - float(i));
    int k = int(min(slice, LMP_PREINTEGRATED_LOBE_SHAPE.y - 1.0));
    vec4 cell = LMP_PREINTEGRATED_LOBE_CELL(k);
    lmp_place place;
    place.corner = cell.zw;
    place.share = slice - float(k);
    place.density = cell.x * sqrt(e + 1.5) + cell.y;
    place.angle = LMP_PI * (1.0 / (e + 1.0) + LMP_PREINTEGRATED_LOBE_SHAPE.x);
    return place;
}

/* acos(1 - y) / sqrt(y), of x = 1 - y in 0 … 1 (Abramowitz and Stegun 4.4.46). */
float lmp_angle(float x) {
    float p = -0.0012624911;
    p = p * x + 0.0066700901;
    p = p * x - 0.0170881256;
    p = p * x + 0.0308918810;
    p = p * x - 0.0501743046;
    p = p * x + 0.0889789874;
    p = p * x - 0.2145988016;
    return p * x + 1.5707963050;
}

float lmp_angle_of_cosine(float u) {
    float y = max(1.0 - abs(u), 0.0), across = sqrt(y) * lmp_angle(1.0 - y);
    return u < 0.0 ? LMP_PI - across : across;
}

/* The cubic B-spline's weights of four neighbors, the point x past the second, as two linear
 * readings (Sigg and Hadwiger 2005): their places from the first neighbor on, and the weight of the
 * second reading. */
vec3 lmp_spline(float x) {
    float y = 1.0 - x, w0 = y * y * y, w3 = x * x * x;
    float w2 = 4.0 + 3.0 * y * y * (y - 2.0), second = w2 + w3;
    return vec3(1.0 - w0 / (6.0 - second), 2.0 + w3 / second, second / 6.0);
}

/* The lobe's mean over a cap, times the cap's solid angle plus the lobe's. */
float lmp_preintegrated_lobe_read(lmp_place place, float g, float a) {
    float x = g * place.density, y = a * place.density;
    vec2 corner = place.corner + floor(vec2(x, y)) + 0.5;
    vec3 across = lmp_spline(fract(x)), down = lmp_spline(fract(y));
    vec2 upper = mix(LMP_PREINTEGRATED_LOBE_PAIR(corner + vec2(across.x, down.x)),
                     LMP_PREINTEGRATED_LOBE_PAIR(corner + vec2(across.y, down.x)), across.z);
    vec2 lower = mix(LMP_PREINTEGRATED_LOBE_PAIR(corner + vec2(across.x, down.y)),
                     LMP_PREINTEGRATED_LOBE_PAIR(corner + vec2(across.y, down.y)), across.z);
    vec2 slices = mix(upper, lower, down.z);
    return mix(slices.x, slices.y, place.share) * LMP_PREINTEGRATED_LOBE_UNIT;
}

#ifdef LMP_LIGHT_COUNT
/* lmp_shade_zonal, within the response's error. */
vec3 lmp_shade_preintegrated(lmp_surface surface, lmp_material material) {
    lmp_place diffuse = lmp_preintegrated_lobe_lookup(1.0), specular = lmp_preintegrated_lobe_lookup(material.exponent);
    vec3 mirror = reflect(-surface.view, surface.normal), sum = vec3(0.0);
    for (int i = 0; i < LMP_LIGHT_COUNT; i++) {
        lmp_cap cap = LMP_LIGHT_CAP(i, surface.position);
        /* more than a hemisphere: light all around less the complementary cap */
        bool inside = cap.base > 2.0;
        float t = cap.one_minus_cos, all_around = inside ? 1.0 : 0.0;
        float covered = 2.0 * LMP_PI * t, mean = inside ? -covered : covered;
        float a = sqrt(t) * lmp_angle(1.0 - t);
        float d = lmp_preintegrated_lobe_read(diffuse, lmp_angle_of_cosine(dot(cap.axis, surface.normal)), a);
        float s = lmp_preintegrated_lobe_read(specular, lmp_angle_of_cosine(dot(cap.axis, mirror)), a);
        d = d * mean / (covered + diffuse.angle) + all_around;
        s = s * mean / (covered + specular.angle) + all_around;
        sum += LMP_LIGHT_COLOR(i, surface.position) * (material.diffuse * d + material.specular * s);
    }
    return max(sum, vec3(0.0));
}
#endif
#endif

/* SPDX-License-Identifier: MIT */
/* preintegrated_brdf.glsl - shading measured materials from their responses (lampion/preintegrated.h): four slices
 * a light, whatever the number of bands. Include it after lampion.glsl and preintegrated_lobe.glsl.
 *
 * Put the slices' texels into a texture of signed normalized 16-bit channels, `columns` texels a row,
 * slices side by side as you like, and the rest of what lmp_preintegrated_brdf_describe returns into an
 * array of floats: first LMP_PREINTEGRATED_BRDF_HEADER numbers (below), then view_remap, cap_remap, ambient, and
 * of every slice the corner x and y, rows, columns, row_density, row_origin, column_density, unit.
 * Define before including:
 *   LMP_PREINTEGRATED_BRDF_TEXEL(p)   vec3: the texture at p, filtered linearly; texel centers at .5
 *   LMP_PREINTEGRATED_BRDF_VALUE(i)   float: number i of the array */
#ifndef LAMPION_MEASURED_GLSL
#define LAMPION_MEASURED_GLSL

/* view_count, cap_count, view_steps, cap_steps, width, radius, reach, slope, lobe_angle, mirrored */
#define LMP_PREINTEGRATED_BRDF_HEADER 10
#define LMP_PREINTEGRATED_BRDF_SLICE  8

/* Where a view lies in the response whose numbers begin at `first`. */
struct lmp_preintegrated_brdf {
    int first, view, caps, cap_remap, slices;
    float share, cosine, sine;
    vec3 ambient;
};

/* The slice coordinate at `share` of the warp that begins at `first`: the slice, and the share of
 * the next one. */
float lmp_preintegrated_brdf_lookup(int first, int steps, int count, float share, out int slice) {
    float at = clamp(share, 0.0, 1.0) * float(steps);
    int i = min(int(at), steps - 1);
    float place = mix(LMP_PREINTEGRATED_BRDF_VALUE(first + i), LMP_PREINTEGRATED_BRDF_VALUE(first + i + 1), at - float(i));
    slice = min(int(place), count - 2);
    return place - float(slice);
}

lmp_preintegrated_brdf lmp_preintegrated_brdf_view(int first, float cos_theta_o) {
    int views = int(LMP_PREINTEGRATED_BRDF_VALUE(first)), view_steps = int(LMP_PREINTEGRATED_BRDF_VALUE(first + 2));
    int cap_steps = int(LMP_PREINTEGRATED_BRDF_VALUE(first + 3));
    int view_remap = first + LMP_PREINTEGRATED_BRDF_HEADER;
    lmp_preintegrated_brdf m;
    m.first = first;
    m.caps = int(LMP_PREINTEGRATED_BRDF_VALUE(first + 1));
    m.cap_remap = view_remap + view_steps + 1;
    int ambient = m.cap_remap + cap_steps + 1;
    m.slices = ambient + 3 * views;
    m.cosine = clamp(cos_theta_o, 0.0, 1.0);
    m.sine = sqrt(1.0 - m.cosine * m.cosine);
    m.share = lmp_preintegrated_brdf_lookup(view_remap, view_steps, views,
                                lmp_angle_of_cosine(m.cosine) * (2.0 / LMP_PI), m.view);
    ambient += 3 * m.view;
    for (int c = 0; c < 3; c++)
        m.ambient[c] =
            mix(LMP_PREINTEGRATED_BRDF_VALUE(ambient + c), LMP_PREINTEGRATED_BRDF_VALUE(ambient + 3 + c), m.share);
    return m;
}

/* A slice's value: 4 x 4 coefficients of cubic B-splines by four readings (preintegrated_lobe.glsl). */
vec3 lmp_preintegrated_brdf_slice(int slice, float s, float azimuth) {
    vec2 size = vec2(LMP_PREINTEGRATED_BRDF_VALUE(slice + 3), LMP_PREINTEGRATED_BRDF_VALUE(slice + 2));
    vec2 at = vec2(azimuth * LMP_PREINTEGRATED_BRDF_VALUE(slice + 6) + 1.0,
                   s * LMP_PREINTEGRATED_BRDF_VALUE(slice + 4) - LMP_PREINTEGRATED_BRDF_VALUE(slice + 5));
    vec2 base = clamp(floor(at), vec2(1.0), size - 3.0), f = clamp(at - base, 0.0, 1.0);
    vec2 corner = vec2(LMP_PREINTEGRATED_BRDF_VALUE(slice), LMP_PREINTEGRATED_BRDF_VALUE(slice + 1)) + base - 0.5;
    vec3 across = lmp_spline(f.x), down = lmp_spline(f.y);
    vec3 upper = mix(LMP_PREINTEGRATED_BRDF_TEXEL(corner + vec2(across.x, down.x)),
                     LMP_PREINTEGRATED_BRDF_TEXEL(corner + vec2(across.y, down.x)), across.z);
    vec3 lower = mix(LMP_PREINTEGRATED_BRDF_TEXEL(corner + vec2(across.x, down.y)),
                     LMP_PREINTEGRATED_BRDF_TEXEL(corner + vec2(across.y, down.y)), across.z);
    return mix(upper, lower, down.z) * LMP_PREINTEGRATED_BRDF_VALUE(slice + 7);
}

/* The mean over a cap of BRDF times cosine; the axis is in the frame of the view. */
vec3 lmp_preintegrated_brdf_mean(lmp_preintegrated_brdf m, vec3 axis, float one_minus_cos) {
    float width = LMP_PREINTEGRATED_BRDF_VALUE(m.first + 4), radius = LMP_PREINTEGRATED_BRDF_VALUE(m.first + 5);
    float reach = LMP_PREINTEGRATED_BRDF_VALUE(m.first + 6), slope = LMP_PREINTEGRATED_BRDF_VALUE(m.first + 7);
    float lobe_angle = LMP_PREINTEGRATED_BRDF_VALUE(m.first + 8);
    bool mirrored = LMP_PREINTEGRATED_BRDF_VALUE(m.first + 9) > 0.5;

    /* the axis from the mirror direction: 1 - |z| without cancellation */
    float z = axis.z * m.cosine - axis.x * m.sine;
    vec2 side = vec2(axis.x * m.cosine + axis.z * m.sine, axis.y);
    float y = min(dot(side, side) / (1.0 + abs(z)), 1.0), near = sqrt(y) * lmp_angle(1.0 - y);
    float g = z < 0.0 ? LMP_PI - near : near, across = length(side);
    float half_turn = lmp_angle_of_cosine(across > 0.0 ? clamp(side.x / across, -1.0, 1.0) : 1.0);
    float azimuth = side.y < 0.0 && !mirrored ? 2.0 * LMP_PI - half_turn : half_turn;

    float a = sqrt(one_minus_cos) * lmp_angle(1.0 - one_minus_cos);
    float x = g - a * a / (sqrt(a * a + radius * radius) + radius);
    float s = x * (reach / (width * sqrt(x * x + reach * reach)) + slope);
    int cap, steps = int(LMP_PREINTEGRATED_BRDF_VALUE(m.first + 3));
    float share = lmp_preintegrated_brdf_lookup(m.cap_remap, steps, m.caps,
                                    a / (a + 0.5) * ((LMP_PI + 1.0) / LMP_PI), cap);
    int near_view = m.slices + LMP_PREINTEGRATED_BRDF_SLICE * (m.view * m.caps + cap);
    int far_view = near_view + LMP_PREINTEGRATED_BRDF_SLICE * m.caps;
    vec3 value = mix(mix(lmp_preintegrated_brdf_slice(near_view, s, azimuth),
                         lmp_preintegrated_brdf_slice(near_view + LMP_PREINTEGRATED_BRDF_SLICE, s, azimuth), share),
                     mix(lmp_preintegrated_brdf_slice(far_view, s, azimuth),
                         lmp_preintegrated_brdf_slice(far_view + LMP_PREINTEGRATED_BRDF_SLICE, s, azimuth), share),
                     m.share);
    return value / (2.0 * LMP_PI * one_minus_cos + lobe_angle);
}

#ifdef LMP_LIGHT_COUNT
/* lmp_shade_table_preintegrated of the response whose numbers begin at `first`. */
vec3 lmp_shade_preintegrated_brdf(lmp_surface surface, int first) {
    mat3 world_to_local = lmp_view_frame(surface);
    lmp_preintegrated_brdf m = lmp_preintegrated_brdf_view(first, dot(surface.view, surface.normal));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LMP_LIGHT_COUNT; i++) {
        lmp_cap cap = LMP_LIGHT_CAP(i, surface.position);
        vec3 covered = lmp_preintegrated_brdf_mean(m, world_to_local * cap.axis, cap.one_minus_cos) *
                       (2.0 * LMP_PI * cap.one_minus_cos);
        /* more than a hemisphere: light all around less the complementary cap */
        sum += LMP_LIGHT_COLOR(i, surface.position) * (cap.base > 2.0 ? m.ambient - covered : covered);
    }
    return max(sum, vec3(0.0));
}
#endif
#endif

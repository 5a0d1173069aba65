/* SPDX-License-Identifier: MIT */
/* measured.glsl - shading measured materials from their responses (lampion/response.h): four slices
 * a light, whatever the number of bands. Include it after lampion.glsl and response.glsl.
 *
 * Put the slices' texels into a texture of signed normalised 16-bit channels, `columns` texels a row,
 * slices side by side as you like, and the rest of what lmp_brdf_response_describe returns into an
 * array of floats: first LMP_MEASURED_HEADER numbers (below), then view_warp, cap_warp, ambient, and
 * of every slice the corner x and y, rows, columns, row_density, row_origin, column_density, unit.
 * Define before including:
 *   LMP_MEASURED_TEXEL(p)   vec3: the texture at p, filtered linearly; texel centres at .5
 *   LMP_MEASURED_VALUE(i)   float: number i of the array */
#ifndef LAMPION_MEASURED_GLSL
#define LAMPION_MEASURED_GLSL

/* view_count, cap_count, view_steps, cap_steps, width, radius, reach, slope, lobe_angle, mirrored */
#define LMP_MEASURED_HEADER 10
#define LMP_MEASURED_SLICE  8

/* Where a view lies in the response whose numbers begin at `first`. */
struct lmp_measured {
    int first, view, caps, cap_warp, slices;
    float share, cosine, sine;
    vec3 ambient;
};

/* The slice coordinate at `share` of the warp that begins at `first`: the slice, and the share of
 * the next one. */
float lmp_measured_seek(int first, int steps, int count, float share, out int slice) {
    float at = clamp(share, 0.0, 1.0) * float(steps);
    int i = min(int(at), steps - 1);
    float place = mix(LMP_MEASURED_VALUE(first + i), LMP_MEASURED_VALUE(first + i + 1), at - float(i));
    slice = min(int(place), count - 2);
    return place - float(slice);
}

lmp_measured lmp_measured_view(int first, float cos_theta_o) {
    int views = int(LMP_MEASURED_VALUE(first)), view_steps = int(LMP_MEASURED_VALUE(first + 2));
    int cap_steps = int(LMP_MEASURED_VALUE(first + 3));
    int view_warp = first + LMP_MEASURED_HEADER;
    lmp_measured m;
    m.first = first;
    m.caps = int(LMP_MEASURED_VALUE(first + 1));
    m.cap_warp = view_warp + view_steps + 1;
    int ambient = m.cap_warp + cap_steps + 1;
    m.slices = ambient + 3 * views;
    m.cosine = clamp(cos_theta_o, 0.0, 1.0);
    m.sine = sqrt(1.0 - m.cosine * m.cosine);
    m.share = lmp_measured_seek(view_warp, view_steps, views,
                                lmp_angle_of_cosine(m.cosine) * (2.0 / LMP_PI), m.view);
    ambient += 3 * m.view;
    for (int c = 0; c < 3; c++)
        m.ambient[c] =
            mix(LMP_MEASURED_VALUE(ambient + c), LMP_MEASURED_VALUE(ambient + 3 + c), m.share);
    return m;
}

/* A slice's value: 4 x 4 coefficients of cubic B-splines by four readings (response.glsl). */
vec3 lmp_measured_slice(int slice, float s, float azimuth) {
    vec2 size = vec2(LMP_MEASURED_VALUE(slice + 3), LMP_MEASURED_VALUE(slice + 2));
    vec2 at = vec2(azimuth * LMP_MEASURED_VALUE(slice + 6) + 1.0,
                   s * LMP_MEASURED_VALUE(slice + 4) - LMP_MEASURED_VALUE(slice + 5));
    vec2 base = clamp(floor(at), vec2(1.0), size - 3.0), f = clamp(at - base, 0.0, 1.0);
    vec2 corner = vec2(LMP_MEASURED_VALUE(slice), LMP_MEASURED_VALUE(slice + 1)) + base - 0.5;
    vec3 across = lmp_spline(f.x), down = lmp_spline(f.y);
    vec3 upper = mix(LMP_MEASURED_TEXEL(corner + vec2(across.x, down.x)),
                     LMP_MEASURED_TEXEL(corner + vec2(across.y, down.x)), across.z);
    vec3 lower = mix(LMP_MEASURED_TEXEL(corner + vec2(across.x, down.y)),
                     LMP_MEASURED_TEXEL(corner + vec2(across.y, down.y)), across.z);
    return mix(upper, lower, down.z) * LMP_MEASURED_VALUE(slice + 7);
}

/* The mean over a cap of BRDF times cosine; the axis is in the frame of the view. */
vec3 lmp_measured_mean(lmp_measured m, vec3 axis, float one_minus) {
    float width = LMP_MEASURED_VALUE(m.first + 4), radius = LMP_MEASURED_VALUE(m.first + 5);
    float reach = LMP_MEASURED_VALUE(m.first + 6), slope = LMP_MEASURED_VALUE(m.first + 7);
    float lobe_angle = LMP_MEASURED_VALUE(m.first + 8);
    bool mirrored = LMP_MEASURED_VALUE(m.first + 9) > 0.5;

    /* the axis from the mirror direction: 1 - |z| without cancellation */
    float z = axis.z * m.cosine - axis.x * m.sine;
    vec2 side = vec2(axis.x * m.cosine + axis.z * m.sine, axis.y);
    float y = min(dot(side, side) / (1.0 + abs(z)), 1.0), near = sqrt(y) * lmp_angle(1.0 - y);
    float g = z < 0.0 ? LMP_PI - near : near, across = length(side);
    float half_turn = lmp_angle_of_cosine(across > 0.0 ? clamp(side.x / across, -1.0, 1.0) : 1.0);
    float azimuth = side.y < 0.0 && !mirrored ? 2.0 * LMP_PI - half_turn : half_turn;

    float a = sqrt(one_minus) * lmp_angle(1.0 - one_minus);
    float x = g - a * a / (sqrt(a * a + radius * radius) + radius);
    float s = x * (reach / (width * sqrt(x * x + reach * reach)) + slope);
    int cap, steps = int(LMP_MEASURED_VALUE(m.first + 3));
    float share = lmp_measured_seek(m.cap_warp, steps, m.caps,
                                    a / (a + 0.5) * ((LMP_PI + 1.0) / LMP_PI), cap);
    int near_view = m.slices + LMP_MEASURED_SLICE * (m.view * m.caps + cap);
    int far_view = near_view + LMP_MEASURED_SLICE * m.caps;
    vec3 value = mix(mix(lmp_measured_slice(near_view, s, azimuth),
                         lmp_measured_slice(near_view + LMP_MEASURED_SLICE, s, azimuth), share),
                     mix(lmp_measured_slice(far_view, s, azimuth),
                         lmp_measured_slice(far_view + LMP_MEASURED_SLICE, s, azimuth), share),
                     m.share);
    return value / (2.0 * LMP_PI * one_minus + lobe_angle);
}

#ifdef LMP_LIGHT_COUNT
/* lmp_shade_table_preintegrated of the response whose numbers begin at `first`. */
vec3 lmp_shade_measured(lmp_surface surface, int first) {
    mat3 world_to_local = lmp_view_frame(surface);
    lmp_measured m = lmp_measured_view(first, dot(surface.view, surface.normal));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LMP_LIGHT_COUNT; i++) {
        lmp_cap cap = lmp_cap_of_sphere(LMP_LIGHT_SPHERE(i), surface.position);
        vec3 covered = lmp_measured_mean(m, world_to_local * cap.axis, cap.one_minus) *
                       (2.0 * LMP_PI * cap.one_minus);
        /* inside a sphere: light all around less the complementary cap */
        sum += LMP_LIGHT_RADIANCE(i) * (cap.strength < 0.0 ? m.ambient - covered : covered);
    }
    return max(sum, vec3(0.0));
}
#endif
#endif

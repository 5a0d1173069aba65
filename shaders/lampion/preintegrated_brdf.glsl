/* SPDX-License-Identifier: MIT */
/* preintegrated_brdf.glsl - shading from preintegrated BRDFs (lampion/preintegrated.h): four slices
 * per light, whatever the number of bands. Include it after lampion.glsl, preintegrated_lookup.h
 * and preintegrated_lobe.glsl.
 *
 * Put the slices' texels into a texture of signed normalized 16-bit channels, `columns` texels a
 * row, slices side by side as you like, and the rest of what lmp_preintegrated_brdf_describe returns
 * into an array of floats, in the layout of preintegrated_lookup.h. Define before including:
 *   LMP_PREINTEGRATED_BRDF_TEXEL(p)  vec3: the texture at p, filtered linearly; texel centers at .5
 *   LMP_PREINTEGRATED_BRDF_VALUE(i)  float: number i of the array */
#ifndef LAMPION_PREINTEGRATED_BRDF_GLSL
#define LAMPION_PREINTEGRATED_BRDF_GLSL

/* What the includer defined is only read here, where no local name can hide one of its own. */
vec3 lmp_preintegrated_brdf_texel(vec2 lmp_p) {
    return LMP_PREINTEGRATED_BRDF_TEXEL(lmp_p);
}
float lmp_preintegrated_brdf_value(int lmp_i) {
    return LMP_PREINTEGRATED_BRDF_VALUE(lmp_i);
}

/* Where a view lies in the BRDF whose numbers begin at `first`. */
struct lmp_preintegrated_brdf {
    int first, view, caps, cap_remap, slices;
    float fraction, cosine, sine;
    vec3 ambient;
};

float lmp_preintegrated_brdf_header(lmp_preintegrated_brdf m, int index) {
    return lmp_preintegrated_brdf_value(m.first + index);
}

/* Looks up the slice coordinate at `at` = 0 ... 1 of the remap that begins at `first`: returns the
 * slice, and the fraction of the next one. */
float lmp_preintegrated_brdf_lookup(int first, int steps, int count, float at, out int slice) {
    float entry = clamp(at, 0.0, 1.0) * float(steps);
    int i = lmp_lookup_first(entry, float(steps - 1));
    float coordinate =
        lmp_lookup_between(lmp_preintegrated_brdf_value(first + i),
                           lmp_preintegrated_brdf_value(first + i + 1), entry - float(i));
    slice = lmp_lookup_first(coordinate, float(count - 2));
    return coordinate - float(slice);
}

lmp_preintegrated_brdf lmp_preintegrated_brdf_view(int first, float cos_theta_o) {
    lmp_preintegrated_brdf m;
    m.first = first;
    int views = int(lmp_preintegrated_brdf_header(m, LMP_LOOKUP_VIEW_COUNT));
    int view_steps = int(lmp_preintegrated_brdf_header(m, LMP_LOOKUP_VIEW_STEPS));
    int cap_steps = int(lmp_preintegrated_brdf_header(m, LMP_LOOKUP_CAP_STEPS));
    int view_remap = first + LMP_LOOKUP_HEADER;
    m.caps = int(lmp_preintegrated_brdf_header(m, LMP_LOOKUP_CAP_COUNT));
    m.cap_remap = view_remap + view_steps + 1;
    int ambient = m.cap_remap + cap_steps + 1;
    m.slices = ambient + 3 * views;
    m.cosine = clamp(cos_theta_o, 0.0, 1.0);
    m.sine = sqrt(1.0 - m.cosine * m.cosine);
    int view;
    m.fraction = lmp_preintegrated_brdf_lookup(view_remap, view_steps, views,
                                               lmp_lookup_arc(1.0 - m.cosine) * (2.0 / LMP_PI), view);
    m.view = view;
    ambient += 3 * view;
    for (int c = 0; c < 3; c++)
        m.ambient[c] =
            lmp_lookup_between(lmp_preintegrated_brdf_value(ambient + c),
                               lmp_preintegrated_brdf_value(ambient + 3 + c), m.fraction);
    return m;
}

/* Returns a slice's value: 4 x 4 coefficients of cubic B-splines, by four readings
 * (preintegrated_lobe.glsl). */
vec3 lmp_preintegrated_brdf_slice(int slice, float s, float azimuth) {
    float rows = lmp_preintegrated_brdf_value(slice + LMP_LOOKUP_ROWS);
    float columns = lmp_preintegrated_brdf_value(slice + LMP_LOOKUP_COLUMNS);
    float row = s * lmp_preintegrated_brdf_value(slice + LMP_LOOKUP_ROW_DENSITY) -
                lmp_preintegrated_brdf_value(slice + LMP_LOOKUP_ROW_ORIGIN);
    float column = azimuth * lmp_preintegrated_brdf_value(slice + LMP_LOOKUP_COLUMN_DENSITY) + 1.0;
    int i = lmp_lookup_base(row, rows - 3.0), j = lmp_lookup_base(column, columns - 3.0);
    vec2 corner = vec2(lmp_preintegrated_brdf_value(slice + LMP_LOOKUP_CORNER_X),
                       lmp_preintegrated_brdf_value(slice + LMP_LOOKUP_CORNER_Y)) +
                  vec2(float(j), float(i)) - 0.5;
    vec3 across = lmp_spline(lmp_lookup_past(column, j)), down = lmp_spline(lmp_lookup_past(row, i));
    vec3 upper = mix(lmp_preintegrated_brdf_texel(corner + vec2(across.x, down.x)),
                     lmp_preintegrated_brdf_texel(corner + vec2(across.y, down.x)), across.z);
    vec3 lower = mix(lmp_preintegrated_brdf_texel(corner + vec2(across.x, down.y)),
                     lmp_preintegrated_brdf_texel(corner + vec2(across.y, down.y)), across.z);
    return mix(upper, lower, down.z) * lmp_preintegrated_brdf_value(slice + LMP_LOOKUP_VALUE_MAX);
}

/* Returns the mean over a cap of BRDF times cosine; the axis is in the frame of the view. */
vec3 lmp_preintegrated_brdf_mean(lmp_preintegrated_brdf m, vec3 axis, float one_minus_cos) {
    bool mirrored = lmp_preintegrated_brdf_header(m, LMP_LOOKUP_MIRRORED) > 0.5;
    /* The axis as seen from the mirror direction. */
    float z = axis.z * m.cosine - axis.x * m.sine, x = axis.x * m.cosine + axis.z * m.sine;
    float across2 = x * x + axis.y * axis.y, a = lmp_lookup_arc(one_minus_cos);
    float azimuth = lmp_lookup_azimuth(x, axis.y, across2, mirrored);
    float s = lmp_lookup_row(lmp_lookup_polar(z, across2), a,
                             lmp_preintegrated_brdf_header(m, LMP_LOOKUP_RADIUS),
                             lmp_preintegrated_brdf_header(m, LMP_LOOKUP_WIDTH),
                             lmp_preintegrated_brdf_header(m, LMP_LOOKUP_REACH),
                             lmp_preintegrated_brdf_header(m, LMP_LOOKUP_SLOPE));
    int cap, steps = int(lmp_preintegrated_brdf_header(m, LMP_LOOKUP_CAP_STEPS));
    float second =
        lmp_preintegrated_brdf_lookup(m.cap_remap, steps, m.caps, lmp_lookup_cap(a), cap);
    int near_view = m.slices + LMP_LOOKUP_SLICE * (m.view * m.caps + cap);
    int far_view = near_view + LMP_LOOKUP_SLICE * m.caps;
    vec3 value = mix(mix(lmp_preintegrated_brdf_slice(near_view, s, azimuth),
                         lmp_preintegrated_brdf_slice(near_view + LMP_LOOKUP_SLICE, s, azimuth), second),
                     mix(lmp_preintegrated_brdf_slice(far_view, s, azimuth),
                         lmp_preintegrated_brdf_slice(far_view + LMP_LOOKUP_SLICE, s, azimuth), second),
                     m.fraction);
    return value / (2.0 * LMP_PI * one_minus_cos +
                    lmp_preintegrated_brdf_header(m, LMP_LOOKUP_LOBE_ANGLE));
}

#ifdef LMP_LIGHT_COUNT
/* Does lmp_shade_table_preintegrated with the BRDF whose numbers begin at `first`. */
vec3 lmp_shade_preintegrated_brdf(lmp_surface surface, int first) {
    mat3 world_to_local = lmp_view_frame(surface);
    lmp_preintegrated_brdf m = lmp_preintegrated_brdf_view(first, dot(surface.view, surface.normal));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < lmp_light_count(); i++) {
        lmp_cap cap = lmp_light_find_cap(i, surface.position);
        bool obtuse = cap.base > 2.0 && cap.strength <= 0.0;
        vec3 covered = lmp_preintegrated_brdf_mean(m, LMP_MATRIX_TIMES(world_to_local, cap.axis), cap.one_minus_cos) *
                       (obtuse ? 2.0 * LMP_PI * cap.one_minus_cos : LMP_PI * cap.base);
        /* More than a hemisphere is ambient light less the complementary cap. */
        sum += lmp_light_color(i, surface.position) * (obtuse ? m.ambient - covered : covered);
    }
    return max(sum, vec3(0.0));
}
#endif
#endif

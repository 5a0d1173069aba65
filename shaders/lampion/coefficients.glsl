/* SPDX-License-Identifier: MIT */
/* coefficients.glsl - the n² coefficients of sphere lights, for probes and by the paper's method.
 *
 * Include it after lampion.glsl, which takes the bands, the windowing filter and the lights, and
 * after ggx.glsl if that is used. It defines
 *   lmp_sphere_project       the LMP_SH_COUNT coefficients of a sphere light
 *   lmp_sh_eval              Y_lm of a direction
 *   lmp_cap_project          the coefficients of a lmp_cap
 *   lmp_lobe_make_diffuse         coefficients lambda_l of the cosine: max(n.w, 0): lambda_l Y_lm(n)
 *   lmp_shade_coefficients   radiance to the viewer under all lights: O(LMP_BANDS²) per light, that of
 *                            lmp_shade_zonal but for the diffuse lobe's bands and window */
#ifndef LAMPION_COEFFICIENTS_GLSL
#define LAMPION_COEFFICIENTS_GLSL

#define LMP_HALF_COUNT (LMP_BANDS * (LMP_BANDS + 1) / 2)

/* X(l, m) for l = 0 … 31 and one m; each body starts with the constant test LMP_INSIDE(l, m). */
#define LMP_FOR_COLUMN(X, m)                                                                       \
    X(0, m) X(1, m) X(2, m) X(3, m) X(4, m) X(5, m) X(6, m) X(7, m) X(8, m) X(9, m) X(10, m)       \
    X(11, m) X(12, m) X(13, m) X(14, m) X(15, m) X(16, m) X(17, m) X(18, m) X(19, m) X(20, m)      \
    X(21, m) X(22, m) X(23, m) X(24, m) X(25, m) X(26, m) X(27, m) X(28, m) X(29, m) X(30, m)      \
    X(31, m)
/* X(m) for m = 0 … LMP_BANDS-1: only for columns that exist, or 32² dead blocks would be parsed. */
#if LMP_BANDS <= 4
#define LMP_FOR_COLUMNS(X) X(0) X(1) X(2) X(3)
#elif LMP_BANDS <= 8
#define LMP_FOR_COLUMNS(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7)
#elif LMP_BANDS <= 16
#define LMP_FOR_COLUMNS(X)                                                                         \
    X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) X(13) X(14) X(15)
#else
#define LMP_FOR_COLUMNS(X)                                                                         \
    X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) X(13) X(14) X(15) X(16)    \
    X(17) X(18) X(19) X(20) X(21) X(22) X(23) X(24) X(25) X(26) X(27) X(28) X(29) X(30) X(31)
#endif
#define LMP_INSIDE(l, m) (l >= m && l < LMP_BANDS)
/* Indices that stay legal in the blocks that the constant tests remove. */
#define LMP_INDEX(l, m) (l < LMP_BANDS && l >= (m < 0 ? -(m) : m) ? l * l + l + m : 0)
#define LMP_HALF_INDEX(l, m) (LMP_INSIDE(l, m) ? l * (l + 1) / 2 + m : 0)

/* Y_lm(w) (paper Eq. 1), in Cartesian form: no angles, no poles. */
void lmp_sh_eval(vec3 w, out float sh[LMP_SH_COUNT]) {
    float c = 1.0, s = 0.0, diagonal = sqrt(0.25 / LMP_PI), q, q1, q2, t;
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        q = l == m ? diagonal                                                                      \
                   : sqrt(float(l == m ? 1 : 4 * l * l - 1) / float(l == m ? 1 : l * l - m * m)) * \
                         (w.z * q1 - sqrt(float(l == m ? 0 : (l - 1) * (l - 1) - m * m) /          \
                                          float(l == 0 ? 1 : 4 * (l - 1) * (l - 1) - 1)) * q2);    \
        q2 = q1;                                                                                   \
        q1 = q;                                                                                    \
        sh[LMP_INDEX(l, m)] = q * c;                                                               \
        if (m > 0)                                                                                 \
            sh[LMP_INDEX(l, -m)] = q * s;                                                          \
    }
#define LMP_COLUMN(m)                                                                              \
    if (m < LMP_BANDS) {                                                                           \
        q1 = q2 = 0.0;                                                                             \
        LMP_FOR_COLUMN(LMP_ROW, m)                                                                 \
        diagonal *= m == 0 ? -sqrt(3.0) : -sqrt(float(2 * m + 3) / float(2 * m + 2));              \
        t = w.x * c - w.y * s;                                                                     \
        s = w.x * s + w.y * c;                                                                     \
        c = t;                                                                                     \
    }
    LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_COLUMN
#undef LMP_ROW
}

/* Coefficients of a cap of radiance 1 (paper Eq. 12 and 13). */
void lmp_cap_project(lmp_cap cap, out float sh[LMP_SH_COUNT]) {
    float R[LMP_BANDS];
    lmp_cap_series(cap, R);
    lmp_sh_eval(cap.axis, sh);
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        sh[LMP_INDEX(l, m)] *= LMP_PI * R[LMP_BAND(l)];                                            \
        if (m > 0)                                                                                 \
            sh[LMP_INDEX(l, -m)] *= LMP_PI * R[LMP_BAND(l)];                                       \
    }
#define LMP_COLUMN(m) LMP_FOR_COLUMN(LMP_ROW, m)
    LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_COLUMN
#undef LMP_ROW
}

/* Coefficients at a point of a sphere of radiance 1. */
void lmp_sphere_project(vec4 sphere, vec3 from, out float sh[LMP_SH_COUNT]) {
    lmp_cap_project(lmp_cap_of_sphere(sphere, from), sh);
}

/* lambda_l of max(t, 0): a diffuse lobe's coefficients are lambda_l Y_lm(normal). */
void lmp_lobe_make_diffuse(out float lambda[LMP_BANDS]) {
    float even = LMP_PI / 4.0;
    lambda[0] = LMP_PI;
    if (LMP_BANDS > 1)
        lambda[LMP_BAND(1)] = LMP_PI * 2.0 / 3.0;
#define LMP_STEP(l)                                                                                \
    if (l < LMP_BANDS) {                                                                           \
        lambda[LMP_BAND(l)] = l % 2 == 0 ? even : 0.0;                                             \
        if (l % 2 == 0)                                                                            \
            even *= -float(l - 1) / float(l + 4);                                                  \
    }
    LMP_FOR_BANDS(LMP_STEP)
#undef LMP_STEP
}

#ifdef LMP_LIGHT_COUNT
/* The next q_l(z), monic, from the two before it, both 0 at first. */
#define LMP_MONIC(l, m, z, q, q1, q2)                                                              \
    q = l == m ? q1 + 1.0                                                                          \
               : z * q1 - float((l - 1) * (l - 1) - m * m) / float(4 * (l - 1) * (l - 1) - 1) * q2; \
    q2 = q1;                                                                                       \
    q1 = q;
/* The next real part of (x + iy)^m from the two before it, with around = x² + y². */
#define LMP_POWER(x, around, c, next)                                                              \
    t = 2.0 * x * next - around * c;                                                               \
    c = next;                                                                                      \
    next = t;

/* All lobes lie in the plane of normal and view. In a frame whose z is the normal and whose x lies
 * in that plane their coefficients vanish for m < 0, so only the others are summed; the lights'
 * directions are rotated into that frame, which is cheaper than rotating coefficients. Y_lm is
 * computed as q_l(z) times the real part of (x + iy)^m, with q_l monic; the squares of its norms
 * are applied once, to the sums. */

/* The sums of all lights' coefficients at a surface. */
void lmp_lights_project(lmp_surface surface, mat3 world_to_local, out vec3 sum[LMP_HALF_COUNT]) {
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m))                                                                          \
        sum[LMP_HALF_INDEX(l, m)] = vec3(0.0);
#define LMP_COLUMN(m) LMP_FOR_COLUMN(LMP_ROW, m)
    LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_COLUMN
#undef LMP_ROW

    float q, q1, q2, c, d, t;
    /* Two lights are summed at once, so that each sum is read and written half as often. An odd
     * last light is paired with darkness. */
    for (int i = 0; i < lmp_light_count(); i += 2) {
        int j = min(i + 1, lmp_light_count() - 1);
        lmp_cap cap = lmp_light_find_cap(i, surface.position), cap2 = lmp_light_find_cap(j, surface.position);
        vec3 w = LMP_MATRIX_TIMES(world_to_local, cap.axis);
        vec3 w2 = LMP_MATRIX_TIMES(world_to_local, cap2.axis);
        vec3 radiance = lmp_light_color(i, surface.position);
        vec3 radiance2 =
            i + 1 < lmp_light_count() ? lmp_light_color(j, surface.position) : vec3(0.0);
        float R[LMP_BANDS], R2[LMP_BANDS];
        lmp_cap_series(cap, R);
        lmp_cap_series(cap2, R2);
        /* c and c1 are the real parts of (x + iy)^m and of the next power. */
        float c1 = w.x, c2 = w2.x, p, p1, p2;
        float around = w.x * w.x + w.y * w.y, around2 = w2.x * w2.x + w2.y * w2.y;
        vec3 color, color2;
        c = d = 1.0;
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        LMP_MONIC(l, m, w.z, q, q1, q2)                                                            \
        LMP_MONIC(l, m, w2.z, p, p1, p2)                                                           \
        sum[LMP_HALF_INDEX(l, m)] +=                                                               \
            color * (q * R[LMP_BAND(l)]) + color2 * (p * R2[LMP_BAND(l)]);                         \
    }
#define LMP_COLUMN(m)                                                                              \
    if (m < LMP_BANDS) {                                                                           \
        q1 = q2 = p1 = p2 = 0.0;                                                                   \
        color = radiance * c;                                                                      \
        color2 = radiance2 * d;                                                                    \
        LMP_FOR_COLUMN(LMP_ROW, m)                                                                 \
        LMP_POWER(w.x, around, c, c1)                                                              \
        LMP_POWER(w2.x, around2, d, c2)                                                            \
    }
        LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_COLUMN
#undef LMP_ROW
    }
}

#ifdef LMP_AREA_COUNT
/* Adds up all areas: each degree of what they give is a sum around the axis of a lobe, that of the
 * coefficients but for rounding, by fewer operations; for the diffuse lobe, too. */
vec3 lmp_areas_shade_coefficients(lmp_surface surface, lmp_lobes lobes) {
    vec3 sum = vec3(0.0), diffuse = lobes.diffuse / LMP_PI;
    float cosine[LMP_BANDS];
    LMP_EACH weights[LMP_BANDS];
    lmp_lobe_make_diffuse(cosine);
    lmp_lobe_make_phong(lobes.exponent, weights);
    lobes.diffuse = vec3(0.0);
    for (int pass = 0; pass < 2; pass++) {
        if (pass == 1) {
            lobes = lmp_lobes_of_one(vec3(0.0), surface.normal, diffuse, 1.0);
            weights[0] = LMP_EACH(cosine[0]);
            if (LMP_BANDS > 1)
                weights[LMP_BAND(1)] = LMP_EACH(lmp_window_weight(1) * cosine[LMP_BAND(1)]);
#define LMP_STEP(l)                                                                                \
    if (l < LMP_BANDS)                                                                             \
        weights[LMP_BAND(l)] = LMP_EACH(lmp_window_weight(l) * cosine[LMP_BAND(l)]);
            LMP_FOR_BANDS(LMP_STEP)
#undef LMP_STEP
        }
        lmp_lobe_weigh(weights);
        sum += lmp_areas_shade(surface, lobes, weights);
    }
    return sum;
}
#endif

/* Returns the radiance to the viewer under all lights by the paper's method: the coefficients of
 * all lights are summed, then multiplied with those of the material. */
vec3 lmp_shade_some_coefficients(lmp_surface surface, lmp_lobes lobes) {
    mat3 world_to_local = lmp_view_frame(surface);
    vec3 sum[LMP_HALF_COUNT];
    lmp_lights_project(surface, world_to_local, sum);

    float diffuse[LMP_BANDS];
    LMP_EACH glossy[LMP_BANDS];
    lmp_lobe_make_diffuse(diffuse);
    lmp_lobe_make_phong(lobes.exponent, glossy);
    /* x and z of the lobes' axes; y is 0 */
    LMP_EACH x = LMP_DOT(LMP_TIMES_MATRIX(vec3(1.0, 0.0, 0.0), world_to_local), lobes.axis);
    LMP_EACH z = LMP_DOT(surface.normal, lobes.axis), power = LMP_EACH(1.0), p, p1, p2;
    float q, q1, q2;
    vec3 diffuse_response = vec3(0.0), glossy_response = vec3(0.0);
    float diagonal = 0.25, norm = 0.0;
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        LMP_MONIC(l, m, z, p, p1, p2)                                                              \
        norm = l == m ? diagonal                                                                   \
                      : norm * float(4 * l * l - 1) / float(l == m ? 1 : l * l - m * m);           \
        glossy_response += sum[LMP_HALF_INDEX(l, m)] *                                             \
                           LMP_SUM(lobes.weight, norm * power * p * glossy[LMP_BAND(l)]);          \
        if (m == 0) {                                                                              \
            LMP_MONIC(l, m, 1.0, q, q1, q2)                                                        \
            diffuse_response += sum[LMP_HALF_INDEX(l, m)] *                                        \
                                (norm * q * lmp_window_weight(l) * diffuse[LMP_BAND(l)]);          \
        }                                                                                          \
    }
#define LMP_COLUMN(m)                                                                              \
    if (m < LMP_BANDS) {                                                                           \
        p1 = p2 = LMP_EACH(0.0);                                                                   \
        q1 = q2 = 0.0;                                                                             \
        LMP_FOR_COLUMN(LMP_ROW, m)                                                                 \
        diagonal *= m == 0 ? 3.0 : float(2 * m + 3) / float(2 * m + 2);                            \
        power *= x;                                                                                \
    }
    LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_COLUMN
#undef LMP_ROW
    vec3 shaded = lobes.diffuse / LMP_PI * diffuse_response + glossy_response;
#ifdef LMP_AREA_COUNT
    shaded += lmp_areas_shade_coefficients(surface, lobes);
#endif
    return shaded;
}
#undef LMP_POWER
#undef LMP_MONIC

LMP_SHADE_MATERIALS(lmp_shade_coefficients, lmp_shade_some_coefficients)

#endif
#endif

/* SPDX-License-Identifier: MIT */
/* bench_calls.c - calls of one element, or one per probe, that have no batch kernel of their own.
 */
#include "app/study/bench_kernels.h"
#include "app/study/bench_slots.h"

#include <math.h>

/* --- the calls -------------------------------------------------------------------------------- */

static lmp_vec3 axis_of(const bench_batch *b, size_t i) {
    return (lmp_vec3) { b->axes.x[i], b->axes.y[i], b->axes.z[i] };
}

static const float *vector_of(const bench_batch *b, size_t i) {
    return b->vectors + i * LMP_SH_COUNT(b->bands);
}

static float *out_of(const bench_batch *b, size_t i) {
    return b->out + i * LMP_SH_COUNT(b->bands);
}

static void run_irradiance(const bench_batch *b) {
    lmp_rgb *to = (lmp_rgb *)(void *)b->out;
    for (size_t i = 0; i < b->count; i++)
        to[i] = lmp_probe_irradiance(b->bands, b->vectors, axis_of(b, i));
}
static void run_constants(const bench_batch *b) {
    lmp_probe_constants *to = (lmp_probe_constants *)(void *)b->out;
    for (size_t i = 0; i < b->count; i++)
        lmp_probe_make_constants(b->bands, 1, b->vectors + i, to + i);
}
static void run_reconstruct(const bench_batch *b) {
    for (size_t i = 0; i < b->count; i++)
        b->out[i] = lmp_sh_reconstruct(b->bands, b->vectors, axis_of(b, i));
}
/* Projects a function with an axis, whose zonal coefficients are those of a Phong lobe. */
static void run_expand_zonal(const bench_batch *b) {
    for (size_t i = 0; i < b->count; i++)
        lmp_sh_expand_zonal(b->bands, b->lambda, axis_of(b, i), out_of(b, i));
}
static void run_make_phong(const bench_batch *b) {
    for (size_t i = 0; i < b->count; i++)
        lmp_lobe_make_phong(b->bands, b->distances[i], b->out + i * (size_t)b->bands);
}
static void run_find_ggx(const bench_batch *b) {
    const lmp_vec3_array *n = &b->surfaces.normal;
    lmp_ggx_lobes *to = (lmp_ggx_lobes *)(void *)b->out;
    for (size_t i = 0; i < b->count; i++)
        lmp_lobe_find_ggx((lmp_vec3) { n->x[i], n->y[i], n->z[i] }, axis_of(b, i), 0.5f, to + i);
}
static void run_make_window(const bench_batch *b) {
    for (size_t i = 0; i < b->count; i++)
        lmp_sh_make_window(b->bands, LMP_WINDOW_HANNING, b->distances[i],
                           b->out + i * (size_t)b->bands);
}
static void run_laplacian_window(const bench_batch *b) {
    for (size_t i = 0; i < b->count; i++)
        lmp_sh_make_laplacian_window(b->bands, 0.5f, vector_of(b, i),
                                     b->out + i * (size_t)b->bands);
}
static void run_positive_window(const bench_batch *b) {
    for (size_t i = 0; i < b->count; i++)
        lmp_probe_make_positive_window(b->bands, vector_of(b, i), 3, b->out + i * (size_t)b->bands);
}
/* Convolves with a zonal function. */
static void run_apply_window(const bench_batch *b) {
    for (size_t i = 0; i < b->count; i++)
        lmp_sh_apply_window(b->bands, b->lambda, vector_of(b, i), out_of(b, i));
}
static void run_convert(const bench_batch *b) {
    static const lmp_probe_convention ours = { .axes = { 0 } };
    const lmp_probe_convention *unity = &lmp_probe_engine_format(LMP_PROBE_UNITY)->convention;
    for (size_t i = 0; i < b->count; i++)
        lmp_probe_convert(b->bands, &ours, unity, vector_of(b, i), out_of(b, i));
}
static void run_export(const bench_batch *b) {
    const lmp_probe_format *unity = lmp_probe_engine_format(LMP_PROBE_UNITY);
    for (size_t i = 0; i < b->count; i++)
        lmp_probe_export(b->bands, unity, vector_of(b, i), b->out + i * 27);
}
static void run_make_rotation(const bench_batch *b) {
    for (size_t i = 0; i < b->count; i++) {
        const float angle = 0.01f * (float)i;
        lmp_sh_make_rotation(b->bands, (lmp_quat) { sinf(angle), 0, 0, cosf(angle) }, b->out);
    }
}
static void run_rotate_by_matrix(const bench_batch *b) {
    static const float rotation[9] = { 0, -1, 0, 0.6f, 0, -0.8f, 0.8f, 0, 0.6f };
    for (size_t i = 0; i < b->count; i++)
        lmp_sh_rotate_by_matrix(b->bands, rotation, vector_of(b, i), out_of(b, i));
}
/* Fits as many samples as there are directions, at least twice as many as coefficients. */
static void run_fit(const bench_batch *b) {
    const lmp_probe_samples samples = { .directions = b->axes,
                                        .values = { b->distances, sizeof(float) },
                                        .count = BENCH_ELEMENTS_MAX };
    for (size_t i = 0; i < b->count; i++)
        lmp_probe_fit(NULL, b->bands, 0, &samples, out_of(b, i));
}
static float height(lmp_vec3 direction, void *user) {
    (void)user;
    return direction.z;
}
static void run_function(const bench_batch *b) {
    for (size_t i = 0; i < b->count; i++)
        lmp_sh_project_function(b->bands, 0, height, NULL, out_of(b, i));
}

/* --- operations that each asks for ------------------------------------------------------------ */

enum { SLOTS_COSINE = 20 }; /* about what a cosine takes of the C library */

static size_t values_constants(int n) {
    (void)n;
    return sizeof(lmp_probe_constants) / sizeof(float);
}
static size_t values_ggx(int n) {
    (void)n;
    return sizeof(lmp_ggx_lobes) / sizeof(float);
}
static size_t values_rotation(int n) {
    return LMP_SH_ROTATION_COUNT(n);
}
static double squared(int n) {
    return n * (double)n;
}
/* Three channels of nine products, two of which form a sum; and the factors. */
static double slots_constants(int n) {
    (void)n;
    return 3 * (9 + 1) + 12;
}
static double slots_reconstruct(int n) {
    return bench_slots_basis(n) + 2 * squared(n);
}
static double slots_expand_zonal(int n) {
    return bench_slots_basis(n) + bench_entries(n) + 3 * n;
}
static double slots_make_phong(int n) {
    return 6.0 * n;
}
/* Four rows of a table of two variables, twelve numbers each; and four axes. */
static double slots_find_ggx(int n) {
    (void)n;
    return 4 * 2 * 12 + LMP_GGX_LOBES * 30 + 30;
}
static double slots_make_window(int n) {
    return (SLOTS_COSINE + 4.0) * n;
}
/* The energies of bands, and about five of Newton's steps. */
static double slots_laplacian_window(int n) {
    return 2 * squared(n) + 5 * (8.0 * n + 5);
}
/* Three series: about ten windows, under which the least value is searched by twelve rotations of
 * axes and five steps; or twice all bands in 8 n² directions. */
static double slots_positive_window(int n) {
    const double whole = 10 * (12 * 35 + 5 * 20.0);
    const double toward = 2 * 8 * squared(n) * (bench_slots_basis(n) / 3 + 2 * squared(n) + 6 * n);
    return 3 * (n <= 3 ? whole : toward);
}
/* A factor per coefficient before and after the rotation of axes, and one per band. */
static double slots_convert(int n) {
    return 2 * squared(n) + 2 * n + bench_slots_rotate(n);
}
static double slots_export(int n) {
    return 3 * (slots_convert(n) + squared(n));
}
/* Wigner's d: a step of two recurrences gives eight entries, of which each takes three more. */
static double slots_make_rotation(int n) {
    return (16 / 8.0 + 3) * (double)LMP_SH_ROTATION_COUNT(n);
}
/* The normal equations' lower triangle for each sample, and its factors. */
static double slots_fit(int n) {
    const double count = squared(n);
    return BENCH_ELEMENTS_MAX * (bench_slots_basis(n) + count * (count + 1)) +
           count * count * count / 3;
}
/* The sums of 2 n² nodes; n rings, whose heights take about five of Newton's steps, and their
 * columns. */
static double slots_function(int n) {
    const double ring = SLOTS_COSINE + 5 * (6.0 * n + 10) + 4 * bench_steps(n) + 4 * squared(n);
    return 2 * squared(n) * (12 + 8.0 * n) + n * ring;
}

/* --- the table -------------------------------------------------------------------------------- */

/* The paper has no formula for any. */
#define CALL(name, values, slots, run, most)                                                       \
    {                                                                                              \
        name, values, slots, run, NULL, .lights = 1, .one_layout = true, .call = true,             \
                                        .bands_max = most                                          \
    }

const bench_kernel bench_calls[BENCH_CALLS] = {
    CALL("irradiance-call", bench_values_color, bench_slots_irradiance, run_irradiance, 0),
    CALL("constants", values_constants, slots_constants, run_constants, 3),
    CALL("reconstruct", bench_values_color, slots_reconstruct, run_reconstruct, 0),
    CALL("expand-zonal", bench_values_basis, slots_expand_zonal, run_expand_zonal, 0),
    CALL("make-phong", bench_values_bands, slots_make_phong, run_make_phong, 0),
    CALL("find-ggx", values_ggx, slots_find_ggx, run_find_ggx, 3),
    CALL("make-window", bench_values_bands, slots_make_window, run_make_window, 0),
    CALL("laplacian-window", bench_values_basis, slots_laplacian_window, run_laplacian_window, 0),
    CALL("positive-window", bench_values_basis, slots_positive_window, run_positive_window, 10),
    CALL("apply-window", bench_values_basis, squared, run_apply_window, 0),
    CALL("convert", bench_values_basis, slots_convert, run_convert, LMP_PROBE_AXES_BANDS_MAX),
    CALL("export", values_constants, slots_export, run_export, 3),
    CALL("make-rotation", values_rotation, slots_make_rotation, run_make_rotation, 0),
    CALL("rotate-by-matrix", bench_values_basis, bench_slots_rotate, run_rotate_by_matrix, 0),
    CALL("fit", bench_values_basis, slots_fit, run_fit, 10),
    CALL("function", bench_values_basis, slots_function, run_function, 50),
};

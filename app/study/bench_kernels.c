/* SPDX-License-Identifier: MIT */
#include "app/study/bench_kernels.h"
#include "app/study/bench_slots.h"

/* --- the batch functions ---------------------------------------------------------------------- */

static void run_basis(const bench_batch *b) {
    lmp_sh_eval_n(b->bands, b->axes, b->count, (lmp_sh_array) { b->out, b->stride, b->layout });
}
static void run_basis_gradient(const bench_batch *b) {
    const size_t n = LMP_SH_COUNT(b->bands);
    const size_t stride = b->layout == LMP_SH_PLANAR ? b->stride : 0;
    float *slopes = b->out + n * (stride ? stride / sizeof(float) : b->count);
    lmp_sh_eval_gradient_n(b->bands, b->axes, b->count,
                           (lmp_sh_array) { b->out, stride, b->layout },
                           (lmp_sh_array) { slopes, stride, b->layout });
}
static void run_irradiance(const bench_batch *b) {
    lmp_probe_irradiance_n(b->bands, b->vectors, b->axes, b->count,
                           lmp_rgb_array_of((lmp_rgb *)(void *)b->out));
}
static void run_dot(const bench_batch *b) {
    lmp_sh_dot_n(b->bands, b->layout, b->stride, b->vectors, b->vectors, b->count, b->out);
}
static void run_rotate(const bench_batch *b) {
    lmp_sh_rotate_n(b->bands, b->matrices, b->vectors, b->count,
                    (lmp_sh_array) { b->out, b->stride, b->layout });
}
/* Multiplies, and rotates about z, one element per call. */
static void run_product(const bench_batch *b) {
    const size_t n = LMP_SH_COUNT(b->bands);
    for (size_t i = 0; i < b->count; i++)
        lmp_sh_multiply_few(b->bands, b->vectors + i * n, b->vectors, b->out + i * n);
}
static void run_rotate_z(const bench_batch *b) {
    const size_t n = LMP_SH_COUNT(b->bands);
    for (size_t i = 0; i < b->count; i++)
        lmp_sh_rotate_z(b->bands, 0.5f, b->vectors + i * n, b->out + i * n);
}
/* Projects whole images of three channels. */
static void run_cubemap(const bench_batch *b) {
    lmp_cubemap map = { .size = BENCH_CUBE, .channels = 3 };
    for (int face = 0; face < 6; face++)
        map.faces[face] = b->vectors + face * 3 * BENCH_CUBE * BENCH_CUBE;
    lmp_sh_project_cubemap(b->bands, &map, b->out);
}
static void run_panorama(const bench_batch *b) {
    const lmp_latlong map = { .pixels = b->vectors,
                              .width = BENCH_PANORAMA_WIDTH,
                              .height = BENCH_PANORAMA_HEIGHT,
                              .channels = 3 };
    lmp_sh_project_latlong(b->bands, &map, b->out);
}
static void run_zonal(const bench_batch *b) {
    const lmp_float_array distances = { b->distances, sizeof(float) };
    lmp_sphere_project_zonal_n(b->bands, b->spheres.radius, distances, b->count,
                               (lmp_sh_array) { b->out, b->stride, b->layout });
}
static void run_project(const bench_batch *b) {
    lmp_sphere_project_n(b->bands, &b->spheres, b->points, b->count,
                         (lmp_sh_array) { b->out, b->stride, b->layout });
}
static void run_accumulate(const bench_batch *b) {
    lmp_sphere_sum_n(&b->scratch, b->bands, &b->spheres, BENCH_LIGHTS, NULL, b->points, b->count,
                     (lmp_sh_array) { b->out, b->stride, b->layout });
}
static void run_kinds(const bench_batch *b) {
    lmp_light_project_n(&b->scratch, b->bands, b->kinds, BENCH_LIGHTS, NULL, b->points, b->count,
                        (lmp_sh_array) { b->out, b->stride, b->layout });
}
static void run_pack_half(const bench_batch *b) {
    lmp_sh_pack_half_n(b->vectors, 3 * b->count * LMP_SH_COUNT(b->bands),
                       (uint16_t *)(void *)b->out);
}
/* Makes the calls that an engine makes for one light and one point, one element per call. */
static void run_one_light(const bench_batch *b) {
    const lmp_vec3_array *c = &b->spheres.center, *p = &b->points;
    for (size_t i = 0; i < b->count; i++)
        lmp_sphere_project(b->bands, (lmp_vec3) { c->x[i], c->y[i], c->z[i] },
                           b->spheres.radius.at[i], (lmp_vec3) { p->x[i], p->y[i], p->z[i] },
                           b->out + i * LMP_SH_COUNT(b->bands));
}
static void run_points_alone(const bench_batch *b, size_t lights) {
    const lmp_vec3_array *p = &b->points;
    for (size_t i = 0; i < b->count; i++) {
        const lmp_vec3 point = { p->x[i], p->y[i], p->z[i] };
        lmp_sphere_sum_n(NULL, b->bands, &b->spheres, lights, NULL, lmp_vec3_array_same(&point), 1,
                         lmp_sh_interleaved(b->out + 3 * i * LMP_SH_COUNT(b->bands), 0));
    }
}
static void run_one_point(const bench_batch *b) {
    run_points_alone(b, BENCH_LIGHTS);
}
static void run_one_point_few(const bench_batch *b) {
    run_points_alone(b, BENCH_LIGHTS_FEW);
}
static void run_gradient(const bench_batch *b) {
    const size_t n = LMP_SH_COUNT(b->bands);
    const size_t stride = b->layout == LMP_SH_PLANAR ? b->stride : 0;
    float *slopes = b->out + 3 * n * (stride ? stride / sizeof(float) : b->count);
    lmp_sphere_sum_gradient_n(&b->scratch, b->bands, &b->spheres, BENCH_LIGHTS, b->points, b->count,
                              (lmp_sh_array) { b->out, stride, b->layout },
                              (lmp_sh_array) { slopes, stride, b->layout });
}
static void run_lobe(const bench_batch *b) {
    lmp_lobe_response_n(b->bands, b->lambda, b->axes, &b->spheres, BENCH_LIGHTS, b->points,
                        b->count, (lmp_rgb_array) { b->out, b->stride });
}

static void run_shade_zonal(const bench_batch *b) {
    const lmp_shade_settings settings = { .bands = b->bands };
    lmp_shade_n(&settings, &b->surfaces, b->count, b->lights, BENCH_LIGHTS,
                (lmp_rgb_array) { b->out, 0 });
}
static void run_shade_areas(const bench_batch *b, const lmp_light *areas) {
    const lmp_shade_settings settings = { .bands = b->bands };
    lmp_shade_n(&settings, &b->surfaces, b->count, areas, BENCH_LIGHTS,
                (lmp_rgb_array) { b->out, 0 });
}
static void run_shade_rectangle(const bench_batch *b) {
    run_shade_areas(b, b->areas->large);
}
static void run_shade_rectangle_small(const bench_batch *b) {
    run_shade_areas(b, b->areas->small);
}
static void run_shade_rectangle_cut(const bench_batch *b) {
    run_shade_areas(b, b->areas->cut);
}
static void run_shade_disk(const bench_batch *b) {
    run_shade_areas(b, b->areas->disk);
}
static void run_shade_tube(const bench_batch *b) {
    run_shade_areas(b, b->areas->tube);
}
static void run_shade_tube_small(const bench_batch *b) {
    run_shade_areas(b, b->areas->tube_small);
}
static void run_shade_environment(const bench_batch *b) {
    const lmp_shade_settings settings = { .bands = b->bands };
    const lmp_environment environment = { b->vectors, b->bands };
    lmp_shade_environment_n(&settings, &b->surfaces, b->count, &environment,
                            (lmp_rgb_array) { b->out, 0 });
}
static void run_shade_preintegrated(const bench_batch *b) {
    const lmp_shade_settings settings = { .method = LMP_SHADE_PREINTEGRATED, .lobe = b->lobe };
    lmp_shade_n(&settings, &b->surfaces, b->count, b->lights, BENCH_LIGHTS,
                (lmp_rgb_array) { b->out, 0 });
}
/* Recomputes a field of new lights at all nodes; then shades surfaces, one per point. */
static void run_field_update(const bench_batch *b) {
    lmp_field_update(NULL, b->field, b->lights, BENCH_LIGHTS);
}
static void run_shade_field(const bench_batch *b) {
    lmp_field_shade_n(NULL, b->field, &b->surfaces, b->count, (lmp_rgb_array) { b->out, 0 });
}

/* --- operations that src/kernels asks for; none are fused ------------------------------------- */

static size_t values_basis_gradient(int n) {
    return 4 * LMP_SH_COUNT(n);
}
static size_t values_rgb(int n) {
    return 3 * LMP_SH_COUNT(n);
}
static size_t values_gradient(int n) {
    return 12 * LMP_SH_COUNT(n);
}

static double slots_basis_gradient(int n) {
    /* q_l^m; two slopes and three products per (l, m); 11 per value, and those of m = 0 once */
    return 4 * bench_steps(n) + 6 * bench_later(n) + 5 * bench_entries(n) + 12.0 * n * n;
}
/* Counts three GGX lobes in addition, whose factors are all used. */
static double slots_shade_environment(int n) {
    const double phong =
        4 * bench_steps(n) + 6 * bench_later(n) + (1 + 12) * bench_entries(n) + 12.0 * n + 10.0 * n;
    return bench_slots_irradiance(n) + 3 * phong;
}
static double slots_dot(int n) {
    return 2.0 * n * n + 15;
}
/* Counts four products and two sums per pair of coefficients. */
static double slots_rotate_z(int n) {
    return 6 * bench_steps(n);
}
/* Counts the table's triples, fifteen operations each. */
static double slots_product(int n) {
    static const double triples[LMP_SH_FEW_BANDS + 1] = { 0, 1, 4, 25, 77, 238, 549 };
    return 15 * triples[n];
}
/* Counts C_m and S_m, recomputed every three orders; q_l^m; three channels of cosine and sine per
 * (l, m). */
static double slots_image(int n) {
    return n * (double)n + 6 * bench_later(n) + 4 * bench_steps(n) + 14 * bench_entries(n);
}
static double slots_zonal(int n) {
    return 14 + 5 * bench_later(n) + n;
}
static double slots_project(int n) {
    return 24 + 5 * bench_later(n) + bench_slots_basis(n) + bench_entries(n);
}
static double slots_accumulate(int n) {
    return 24 + 11 * bench_later(n) + 6 * n + bench_entries(n) + 6 * n + 12 * bench_steps(n) +
           3 * bench_steps(n) + 3.0 * n * n / BENCH_LIGHTS;
}
static double slots_pack_half(int n) {
    return 3.0 * n * n;
}
static double slots_gradient(int n) {
    return 29 + 16 * bench_later(n) + 5 + 8 * n + 4 * bench_steps(n) + 11 * bench_entries(n) +
           32 * n + 64 * bench_steps(n);
}
static double slots_lobe(int n) {
    return 19 + 6 + 2 + (n > 1 ? 3 : 0) + 11 * bench_later(n) + 7;
}

/* A cap; its cosines with two axes; three channels of two lobes. */
enum { SLOTS_CAP = 17, SLOTS_DIRECTION = 12, SLOTS_ACCUMULATE = 12 };
/* A lobe's cosine, its response and three channels. */
enum { SLOTS_LOBE = 5 + 3 + 6 };
static double slots_shade_phong(int n) {
    return SLOTS_LOBE + 5 + (n <= 48 ? 5 : 6) * bench_later(n);
}
static double slots_shade_zonal(int n) {
    /* R_l, and the diffuse lobe's sum for every other band */
    const double band = n <= 48 ? 3 + 3 : 5 + 3.5;
    return SLOTS_CAP + 4 + SLOTS_LOBE + 3 + band * bench_later(n) + slots_shade_phong(n);
}
static double slots_shade_ggx(int n) {
    return slots_shade_zonal(n) + 2 * slots_shade_phong(n);
}
/* Doubles, which take two slots each. A rectangle's place, its corners, edges and angles, and what
 * the diffuse lobe receives; its solid angle; a lobe's slopes, then its bands. Four points: their
 * directions and strengths; a lobe's cosines, then its bands. The horizon: crossings, and the
 * angles of what it leaves. A disk's nodes, and a lobe's bands at each. A tube's frame, edges and
 * ends; what the diffuse lobe receives; the solid angle; nodes; a lobe's cosines, then its bands.
 */
static double slots_shade_rectangle(int n) {
    return 2 * (40 + 336 + 48 + 42 + 105 + 92 + 144 + 57 * bench_later(n));
}
static double slots_shade_points(int n) {
    return 2 * (40 + 144 + 42 + 28 + 18.0 * n);
}
static double slots_shade_cut(int n) {
    return slots_shade_rectangle(n) + 2 * 460;
}
static double slots_shade_disk(int n) {
    return 2 * (40 + 60 + 42 + 32 * (60 + 12 + 4.5 * n));
}
static double slots_shade_tube(int n) {
    return 2 *
           (70 + 45 + 2 * 70 + 40 + 110 + 2 * 64 + 2 * 60 + 70 + (34 + 12 * 4.5) * bench_later(n));
}
/* A lookup of floats (products of 16-bit coefficients with their weights are integers):
 * coordinates, weights of two splines, rounding, four rows; before that, an angle. */
enum { SLOTS_READING = 21 + 4 + 30 + 19 + 9 };
static double slots_shade_lobe(int n) {
    (void)n;
    return SLOTS_CAP + SLOTS_DIRECTION + SLOTS_ACCUMULATE + 17 + 2 * SLOTS_READING + 10;
}
static double slots_shade_ggx_lobe(int n) {
    return slots_shade_lobe(n) + 2 * (6 + 6 + SLOTS_READING) + 10;
}
static double slots_shade_brdf(int n) {
    (void)n;
    /* three cosines and three angles; the row's coordinate and the cap's fraction; four slices,
     * with splines' weights and sums of 12 numbers; and the product with the radiance */
    return SLOTS_CAP + 18 + 66 + 50 + 5 + 4 * (59 + 24) + 24;
}
/* Count a node's gradient and a light's falloff; and per point 32 rows of all coefficients, and a
 * lobe of each kind. */
static double slots_field_update(int n) {
    return slots_gradient(n) + 20;
}
static double slots_shade_field(int n) {
    const double phong =
        4 * bench_steps(n) + 6 * bench_later(n) + (1 + 12) * bench_entries(n) + 22.0 * n;
    return 192.0 * n * n + bench_slots_irradiance(n) + phong;
}

/* --- the table -------------------------------------------------------------------------------- */

const bench_kernel bench_kernels[BENCH_KERNELS] = {
    { "project", bench_values_basis, slots_project, run_project, bench_paper_project, .lights = 1,
      .large = true },
    { "accumulate", values_rgb, slots_accumulate, run_accumulate, bench_paper_accumulate,
      .lights = BENCH_LIGHTS },
    { "kinds", values_rgb, slots_accumulate, run_kinds, bench_paper_accumulate,
      .lights = BENCH_LIGHTS },
    { "gradient", values_gradient, slots_gradient, run_gradient, bench_paper_gradient,
      .lights = BENCH_LIGHTS },
    { "one-light", bench_values_basis, slots_project, run_one_light, bench_paper_project,
      .lights = 1, .one_layout = true },
    { "one-point", values_rgb, slots_accumulate, run_one_point, bench_paper_accumulate,
      .lights = BENCH_LIGHTS, .one_layout = true },
    { "one-point-8-lights", values_rgb, slots_accumulate, run_one_point_few,
      bench_paper_accumulate_few, .lights = BENCH_LIGHTS_FEW, .one_layout = true },
    { "lobe", bench_values_color, slots_lobe, run_lobe, bench_paper_lobe, .lights = BENCH_LIGHTS,
      .one_layout = true },
    { "zonal", bench_values_bands, slots_zonal, run_zonal, bench_paper_zonal, .lights = 1 },
    { "basis", bench_values_basis, bench_slots_basis, run_basis, bench_paper_basis, .lights = 1,
      .large = true },
    { "basis-gradient", values_basis_gradient, slots_basis_gradient, run_basis_gradient,
      bench_paper_basis_gradient, .lights = 1 },
    { "irradiance", bench_values_color, bench_slots_irradiance, run_irradiance,
      bench_paper_irradiance, .lights = 1, .one_layout = true },
    { "cubemap", bench_values_color, slots_image, run_cubemap, bench_paper_cubemap,
      .lights = 6 * BENCH_CUBE * BENCH_CUBE / BENCH_ELEMENTS_MAX, .one_layout = true },
    { "panorama", bench_values_color, slots_image, run_panorama, bench_paper_panorama,
      .lights = BENCH_PANORAMA_WIDTH * BENCH_PANORAMA_HEIGHT / BENCH_ELEMENTS_MAX,
      .one_layout = true },
    { "product", bench_values_basis, slots_product, run_product, bench_paper_product, .lights = 1,
      .one_layout = true, .bands_max = LMP_SH_FEW_BANDS },
    { "rotate-z", bench_values_basis, slots_rotate_z, run_rotate_z, bench_paper_rotate, .lights = 1,
      .one_layout = true },
    { "rotate", bench_values_basis, bench_slots_rotate, run_rotate, bench_paper_rotate,
      .lights = 1 },
    { "pack-half", values_rgb, slots_pack_half, run_pack_half, bench_paper_pack_half, .lights = 1,
      .one_layout = true },
    { "dot", bench_values_basis, slots_dot, run_dot, bench_paper_dot, .lights = 1 },
    { "shade-zonal", bench_values_color, slots_shade_zonal, run_shade_zonal, bench_paper_shade,
      .lights = BENCH_LIGHTS, .one_layout = true },
    { "shade-rectangle", bench_values_color, slots_shade_rectangle, run_shade_rectangle, NULL,
      .lights = BENCH_LIGHTS, .one_layout = true },
    { "shade-rectangle-small", bench_values_color, slots_shade_points, run_shade_rectangle_small,
      NULL, .lights = BENCH_LIGHTS, .one_layout = true },
    { "shade-rectangle-cut", bench_values_color, slots_shade_cut, run_shade_rectangle_cut, NULL,
      .lights = BENCH_LIGHTS, .one_layout = true },
    { "shade-disk", bench_values_color, slots_shade_disk, run_shade_disk, NULL,
      .lights = BENCH_LIGHTS, .one_layout = true },
    { "shade-tube", bench_values_color, slots_shade_tube, run_shade_tube, NULL,
      .lights = BENCH_LIGHTS, .one_layout = true },
    { "shade-tube-small", bench_values_color, slots_shade_tube, run_shade_tube_small, NULL,
      .lights = BENCH_LIGHTS, .one_layout = true },
    { "shade-preintegrated", bench_values_color, slots_shade_lobe, run_shade_preintegrated,
      bench_paper_shade, .lights = BENCH_LIGHTS, .one_layout = true, .table = BENCH_TABLE_LOBES },
    { "shade-brdf", bench_values_color, slots_shade_brdf, run_shade_preintegrated,
      bench_paper_shade, .lights = BENCH_LIGHTS, .one_layout = true, .table = BENCH_TABLE_BRDF },
    { "shade-ggx", bench_values_color, slots_shade_ggx, run_shade_zonal, bench_paper_shade,
      .lights = BENCH_LIGHTS, .one_layout = true, .ggx = true },
    { "shade-environment", bench_values_color, slots_shade_environment, run_shade_environment,
      bench_paper_shade_environment, .lights = 1, .one_layout = true, .ggx = true },
    { "shade-ggx-preintegrated", bench_values_color, slots_shade_ggx_lobe, run_shade_preintegrated,
      bench_paper_shade, .lights = BENCH_LIGHTS, .one_layout = true, .table = BENCH_TABLE_LOBES,
      .ggx = true },
    { "field-update", bench_values_color, slots_field_update, run_field_update,
      bench_paper_field_update, .lights = BENCH_FIELD_NODES / BENCH_ELEMENTS_MAX * BENCH_LIGHTS,
      .one_layout = true, .table = BENCH_TABLE_FIELD, .bands_max = LMP_FIELD_BANDS_MAX },
    { "shade-field", bench_values_color, slots_shade_field, run_shade_field, bench_paper_shade,
      .lights = 1, .one_layout = true, .table = BENCH_TABLE_FIELD,
      .bands_max = LMP_FIELD_BANDS_MAX },
};

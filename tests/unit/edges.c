/* SPDX-License-Identifier: MIT */
/* What a release build promises past its preconditions (lampion/base.h): finite gives finite, NaN
 * gives NaN, no number leads outside an array, and nothing is read where there is nothing. */
#include "tests/oracle/check.h"

#include <lampion/lampion.h>

#include <float.h>
#include <math.h>

enum { BANDS = 4, VALUES = BANDS * BANDS, COUNT = 21 };

/* Numbers that violate some precondition. */
static const float wild[] = { 0,      -0.f,  1,       -1,       1e-45f, 1e-30f,   0.5f,     2,
                              -1e10f, 1e30f, FLT_MAX, -FLT_MAX, NAN,    INFINITY, -INFINITY };
enum { WILD = sizeof wild / sizeof *wild };

static bool is_finite_rgb(lmp_rgb c) {
    return isfinite(c.r) && isfinite(c.g) && isfinite(c.b);
}

static bool is_nan_rgb(lmp_rgb c) {
    return isnan(c.r) && isnan(c.g) && isnan(c.b);
}

static lmp_brdf *phong(void) {
    lmp_brdf *brdf;
    assert_int_equal(lmp_brdf_create_phong(NULL, (lmp_rgb) { 1, 1, 1 }, 9, &brdf), LMP_OK);
    return brdf;
}

static lmp_brdf_table *table_of(lmp_brdf *brdf) {
    const lmp_brdf_table_desc desc = { .bands = 3, .views = 4, .azimuths = 4, .rings_max = 32 };
    lmp_brdf_table *table;
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    return table;
}

/* --- NaN, and numbers out of range ------------------------------------------------------------ */

static void preintegrated_lobes_read_nan_as_nan(void **state) {
    (void)state;
    if (CHECK_ASSERTS) {
        check_skip("this build asserts its preconditions");
        return;
    }
    const lmp_preintegrated_lobe_desc desc = { .bands = 2, .error = 0.1f };
    lmp_preintegrated_lobe *lobe;
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &lobe), LMP_OK);
    for (int i = 0; i < WILD * WILD * WILD; i++) {
        const float a = wild[i % WILD], b = wild[i / WILD % WILD], c = wild[i / WILD / WILD];
        const float value = lmp_preintegrated_lobe_eval(lobe, a, b, c);
        assert_int_equal(isnan(value), isnan(a) || isnan(b) || isnan(c));
    }
    lmp_preintegrated_lobe_destroy(lobe);
}

static void preintegrated_brdfs_read_nan_as_nan(void **state) {
    (void)state;
    if (CHECK_ASSERTS) {
        check_skip("this build asserts its preconditions");
        return;
    }
    lmp_brdf *brdf = phong();
    lmp_brdf_table *table = table_of(brdf);
    lmp_preintegrated_brdf *made;
    assert_int_equal(lmp_preintegrated_brdf_create(NULL, NULL, table, &made), LMP_OK);
    for (int i = 0; i < WILD * WILD * WILD; i++) {
        const float a = wild[i % WILD], b = wild[i / WILD % WILD], c = wild[i / WILD / WILD];
        const lmp_vec3 axes[] = { { a, b, 0 }, { 0, a, b }, { b, 0, a } };
        const lmp_rgb value = lmp_preintegrated_brdf_eval(made, c, axes[i % 3], 0.1f);
        if (isnan(a) || isnan(b) || isnan(c))
            assert_true(is_nan_rgb(value));
        (void)lmp_preintegrated_brdf_eval(made, 0.5f, (lmp_vec3) { 0, 0, 1 }, c);
        assert_int_equal(is_nan_rgb(lmp_preintegrated_brdf_ambient(made, c)), isnan(c));
    }
    lmp_preintegrated_brdf_destroy(made);
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
}

static void tables_read_what_has_no_place_as_nan(void **state) {
    (void)state;
    if (CHECK_ASSERTS) {
        check_skip("this build asserts its preconditions");
        return;
    }
    const lmp_ggx ggx = { 0.6f, 0.3f, { 0.9f, 0.8f, 0.6f }, { 0, 0, 0 } };
    lmp_brdf *brdf;
    assert_int_equal(lmp_brdf_create_ggx(NULL, &ggx, &brdf), LMP_OK);
    lmp_brdf_table *table = table_of(brdf);
    float rgb[3 * 9];
    for (int i = 0; i < WILD * WILD; i++) {
        const float cosine = wild[i % WILD], phi = wild[i / WILD];
        lmp_brdf_table_interpolate(table, cosine, phi, rgb);
        for (int k = 0; k < 27; k++)
            assert_int_equal(!isfinite(rgb[k]), isnan(cosine) || !isfinite(phi));
    }
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
}

static void shading_keeps_nan(void **state) {
    (void)state;
    if (CHECK_ASSERTS) {
        check_skip("this build asserts its preconditions");
        return;
    }
    const lmp_vec3 up = { 0, 0, 1 }, nowhere = { NAN, 0, 1 };
    const lmp_material material = { .diffuse = { 1, 1, 1 },
                                    .specular = { 1, 1, 1 },
                                    .exponent = 5 };
    const lmp_light light = { .position = { 0, 0, 4 }, .radius = 1, .radiance = { 1, 1, 1 } };
    for (int method = 0; method <= LMP_SHADE_COEFFICIENTS; method++)
        for (int member = 0; member < 3; member++) {
            const lmp_shade_settings settings = { .method = (lmp_shade_method)method, .bands = 5 };
            lmp_surface surface = { .position = { 0, 0, 0 }, .normal = up, .view = up };
            *(member == 0   ? &surface.position
              : member == 1 ? &surface.normal
                            : &surface.view) = nowhere;
            assert_true(is_nan_rgb(lmp_shade(&settings, &material, &surface, &light, 1)));
        }
}

/* --- the horizon ------------------------------------------------------------------------------ */

static void the_horizon_is_finite(void **state) {
    (void)state;
    const lmp_rgb white = { 1, 1, 1 };
    const lmp_ggx ggx = { 0.5f, 0, { 1, 1, 1 }, { 0, 0, 0 } };
    const lmp_ggx stretched = { 0.001f, 1, { 1, 1, 1 }, { 0, 0, 0 } };
    const float heights[] = { 1e-45f, 1e-38f, 1e-30f, 1e-20f, 1e-10f };
    lmp_sgd sgd;
    lmp_brdf *brdfs[5];
    assert_int_equal(lmp_brdf_find_sgd("nickel", &sgd), LMP_OK);
    assert_int_equal(lmp_brdf_create_lambert(NULL, white, &brdfs[0]), LMP_OK);
    assert_int_equal(lmp_brdf_create_phong(NULL, white, 50, &brdfs[1]), LMP_OK);
    assert_int_equal(lmp_brdf_create_ggx(NULL, &ggx, &brdfs[2]), LMP_OK);
    assert_int_equal(lmp_brdf_create_ggx(NULL, &stretched, &brdfs[3]), LMP_OK);
    assert_int_equal(lmp_brdf_create_sgd(NULL, &sgd, &brdfs[4]), LMP_OK);
    for (int i = 0; i < 5; i++) {
        for (int k = 0; k < 25; k++) {
            const lmp_vec3 wi = { 1, 0, heights[k % 5] }, wo = { -1, 0, heights[k / 5] };
            assert_true(is_finite_rgb(lmp_brdf_eval(brdfs[i], wi, wo)));
            assert_true(is_finite_rgb(lmp_brdf_eval(brdfs[i], wi, wi)));
            assert_true(is_finite_rgb(lmp_brdf_eval(brdfs[i], wi, (lmp_vec3) { 0, 0, 1 })));
        }
        const double low[3] = { 1, 0, 5e-324 };
        double rgb[3];
        lmp_brdf_eval_double(brdfs[i], low, low, rgb);
        assert_true(isfinite(rgb[0]));
        lmp_brdf_destroy(brdfs[i]);
    }
}

/* --- nothing ---------------------------------------------------------------------------------- */

static void a_count_of_0_needs_no_arrays(void **state) {
    (void)state;
    const lmp_vec3_array none = lmp_vec3_array_of(NULL);
    const lmp_float_array no_floats = { NULL, sizeof(float) };
    const lmp_spheres no_spheres = lmp_spheres_of(NULL);
    const lmp_surfaces no_surfaces = { .position = none, .normal = none, .view = none };
    const lmp_material material = { .exponent = 1 };
    const lmp_surface surface = { .normal = { 0, 0, 1 }, .view = { 0, 0, 1 } };
    float unturned[LMP_SH_ROTATION_COUNT(BANDS)], factors[BANDS], sh[3 * VALUES];
    lmp_sh_make_rotation(BANDS, (lmp_quat) { 0, 0, 0, 1 }, unturned);
    lmp_lobe_make_phong(BANDS, 2, factors);
    for (lmp_sh_layout layout = LMP_SH_INTERLEAVED; layout <= LMP_SH_PLANAR; layout++) {
        lmp_sh_eval_n(BANDS, none, 0, (lmp_sh_array) { NULL, 0, layout });
        lmp_sh_dot_n(BANDS, layout, 0, NULL, NULL, 0, NULL);
        lmp_sh_rotate_n(BANDS, unturned, NULL, 0, (lmp_sh_array) { NULL, 0, layout });
        lmp_sphere_project_zonal_n(BANDS, no_floats, no_floats, 0,
                                   (lmp_sh_array) { NULL, 0, layout });
        lmp_sphere_project_n(BANDS, &no_spheres, none, 0, (lmp_sh_array) { NULL, 0, layout });
        lmp_sphere_project_all_n(BANDS, &no_spheres, 0, none, 0,
                                 (lmp_sh_array) { NULL, 0, layout });
        lmp_sphere_sum_n(NULL, BANDS, &no_spheres, 0, NULL, none, 0,
                         (lmp_sh_array) { NULL, 0, layout });
        lmp_sphere_sum_gradient_n(NULL, BANDS, &no_spheres, 0, none, 0,
                                  (lmp_sh_array) { NULL, 0, layout },
                                  (lmp_sh_array) { NULL, 0, layout });
        lmp_lobe_response_n(BANDS, factors, none, &no_spheres, 0, none, 0,
                            (lmp_rgb_array) { NULL, 0 });
    }
    lmp_probe_irradiance_n(BANDS, sh, none, 0, lmp_rgb_array_of(NULL));
    lmp_shade_n(NULL, &no_surfaces, 0, NULL, 0, (lmp_rgb_array) { NULL, 0 });
    lmp_light_project(BANDS, NULL, 0, surface.position, sh);
    for (int i = 0; i < 3 * VALUES; i++)
        assert_true(sh[i] == 0);
    assert_true(lmp_lobe_response(BANDS, factors, surface.normal, NULL, 0, surface.position).r ==
                0);
    assert_true(lmp_shade(NULL, &material, &surface, NULL, 0).r == 0);
}

/* --- strides ---------------------------------------------------------------------------------- */

static lmp_vec3 points[COUNT], axes[COUNT];
static lmp_light lights[COUNT];
static float lambda[BANDS], matrices[LMP_SH_ROTATION_COUNT(BANDS)];
static float tight[9 * VALUES * COUNT], padded[9 * VALUES * 2 * COUNT], other[9 * VALUES * COUNT];

static void place(void) {
    for (int i = 0; i < COUNT; i++) {
        points[i] = check_random_direction();
        axes[i] = check_random_direction();
        lights[i] = (lmp_light) { .position = { 3, 0, (float)i }, .radius = 0.2f };
    }
}

static void eval(lmp_sh_layout layout, size_t stride, float *out) {
    lmp_sh_eval_n(BANDS, lmp_vec3_array_of(axes), COUNT, (lmp_sh_array) { out, stride, layout });
}

static void rotate(lmp_sh_layout layout, size_t stride, float *out) {
    static float from[9 * VALUES * 2 * COUNT];
    eval(layout, stride, from);
    lmp_sh_rotate_n(BANDS, matrices, from, COUNT, (lmp_sh_array) { out, stride, layout });
}

static void zonal(lmp_sh_layout layout, size_t stride, float *out) {
    const lmp_float_array radii = { &lights->radius, sizeof *lights };
    lmp_sphere_project_zonal_n(BANDS, radii, radii, COUNT, (lmp_sh_array) { out, stride, layout });
}

static void project(lmp_sh_layout layout, size_t stride, float *out) {
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_project_n(BANDS, &spheres, lmp_vec3_array_of(points), COUNT,
                         (lmp_sh_array) { out, stride, layout });
}

static void project_all(lmp_sh_layout layout, size_t stride, float *out) {
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_project_all_n(BANDS, &spheres, COUNT / 7, lmp_vec3_array_of(points), 7,
                             (lmp_sh_array) { out, stride, layout });
}

static void sum(lmp_sh_layout layout, size_t stride, float *out) {
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_sum_n(NULL, BANDS, &spheres, 3, NULL, lmp_vec3_array_of(points), COUNT,
                     (lmp_sh_array) { out, stride, layout });
}

static void gradient(lmp_sh_layout layout, size_t stride, float *out) {
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_sum_gradient_n(NULL, BANDS, &spheres, 3, lmp_vec3_array_of(points), COUNT,
                              (lmp_sh_array) { other, 0, layout },
                              (lmp_sh_array) { out, stride, layout });
}

static void irradiance(lmp_sh_layout layout, size_t stride, float *out) {
    (void)layout;
    lmp_probe_irradiance_n(BANDS, matrices, lmp_vec3_array_of(axes), COUNT,
                           (lmp_rgb_array) { out, stride });
}

static void respond(lmp_sh_layout layout, size_t stride, float *out) {
    (void)layout;
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_lobe_response_n(BANDS, lambda, lmp_vec3_array_of(axes), &spheres, 3,
                        lmp_vec3_array_of(points), COUNT, (lmp_rgb_array) { out, stride });
}

static void strides_are_in_bytes_everywhere(void **state) {
    (void)state;
    static const struct {
        size_t values;
        void (*fill)(lmp_sh_layout layout, size_t stride, float *out);
        bool colors; /* which are interleaved alone */
    } functions[] = { { VALUES, eval, false },         { VALUES, rotate, false },
                      { BANDS, zonal, false },         { VALUES, project, false },
                      { VALUES, project_all, false },  { 3 * VALUES, sum, false },
                      { 9 * VALUES, gradient, false }, { 3, respond, true },
                      { 3, irradiance, true } };
    lmp_lobe_make_phong(BANDS, 2, lambda);
    lmp_sh_make_rotation(BANDS, (lmp_quat) { 0.5f, 0.5f, 0.5f, 0.5f }, matrices);
    place();
    for (size_t f = 0; f < sizeof functions / sizeof *functions; f++)
        for (lmp_sh_layout layout = LMP_SH_INTERLEAVED;
             layout <= (functions[f].colors ? LMP_SH_INTERLEAVED : LMP_SH_PLANAR); layout++) {
            const size_t values = functions[f].values;
            const size_t side = layout == LMP_SH_PLANAR ? COUNT : values, stride = side + 5;
            const size_t runs = layout == LMP_SH_PLANAR ? values : COUNT;
            for (size_t i = 0; i < sizeof padded / sizeof *padded; i++)
                padded[i] = -7;
            functions[f].fill(layout, 0, tight);
            functions[f].fill(layout, stride * sizeof(float), padded);
            for (size_t run = 0; run < runs; run++) {
                assert_memory_equal(tight + run * side, padded + run * stride,
                                    side * sizeof(float));
                for (size_t i = side; i < stride; i++)
                    assert_true(padded[run * stride + i] == -7);
            }
        }
}

/* A planar result holds the values of an interleaved one, whatever the other result's layout. */
static void check_planes(const float *rows, const float *planes, size_t values) {
    for (size_t i = 0; i < COUNT; i++)
        for (size_t v = 0; v < values; v++)
            assert_memory_equal(rows + i * values + v, planes + v * COUNT + i, sizeof *rows);
}

static void a_gradient_has_a_layout_of_its_own(void **state) {
    (void)state;
    static float sums[3 * VALUES * COUNT], slopes[9 * VALUES * COUNT];
    const lmp_spheres spheres = lmp_spheres_of(lights);
    const lmp_vec3_array at = lmp_vec3_array_of(points), around = lmp_vec3_array_of(axes);
    place();
    lmp_sphere_sum_gradient_n(NULL, BANDS, &spheres, 3, at, COUNT, lmp_sh_interleaved(sums, 0),
                              lmp_sh_planar(tight, 0));
    lmp_sphere_sum_gradient_n(NULL, BANDS, &spheres, 3, at, COUNT, lmp_sh_planar(other, 0),
                              lmp_sh_interleaved(slopes, 0));
    check_planes(sums, other, 3 * VALUES);
    check_planes(slopes, tight, 9 * VALUES);
    lmp_sh_eval_gradient_n(BANDS, around, COUNT, lmp_sh_interleaved(sums, 0),
                           lmp_sh_planar(tight, 0));
    lmp_sh_eval_gradient_n(BANDS, around, COUNT, lmp_sh_planar(other, 0),
                           lmp_sh_interleaved(slopes, 0));
    check_planes(sums, other, VALUES);
    check_planes(slopes, tight, 3 * VALUES);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(preintegrated_lobes_read_nan_as_nan),
        cmocka_unit_test(preintegrated_brdfs_read_nan_as_nan),
        cmocka_unit_test(tables_read_what_has_no_place_as_nan),
        cmocka_unit_test(shading_keeps_nan),
        cmocka_unit_test(the_horizon_is_finite),
        cmocka_unit_test(a_count_of_0_needs_no_arrays),
        cmocka_unit_test(strides_are_in_bytes_everywhere),
        cmocka_unit_test(a_gradient_has_a_layout_of_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

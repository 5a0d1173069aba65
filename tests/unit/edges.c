/* SPDX-License-Identifier: MIT */
/* What a release build promises past its preconditions (lampion/base.h): finite gives finite, NaN
 * gives NaN, no number leads outside an array, and nothing is read where there is nothing. */
#include "tests/oracle/check.h"

#include <lampion/lampion.h>

#include <float.h>
#include <math.h>

enum { BANDS = 4, VALUES = BANDS * BANDS, COUNT = 21 };

/* Numbers that no precondition allows together. */
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
        lmp_brdf_table_view(table, cosine, phi, rgb);
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
    assert_int_equal(lmp_sgd_find("nickel", &sgd), LMP_OK);
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
    lmp_sh_rotation(BANDS, (lmp_quat) { 0, 0, 0, 1 }, unturned);
    lmp_lobe_phong(BANDS, 2, factors);
    for (lmp_sh_layout layout = LMP_SH_INTERLEAVED; layout <= LMP_SH_PLANAR; layout++) {
        lmp_sh_eval_n(BANDS, none, 0, layout, 0, NULL);
        lmp_sh_dot_n(BANDS, NULL, NULL, 0, layout, 0, NULL);
        lmp_sh_rotate_n(BANDS, unturned, NULL, 0, layout, 0, NULL);
        lmp_sphere_zonal_n(BANDS, no_floats, no_floats, 0, layout, 0, NULL);
        lmp_sphere_project_n(BANDS, &no_spheres, none, 0, layout, 0, NULL);
        lmp_sphere_project_all(BANDS, &no_spheres, 0, none, 0, layout, 0, NULL);
        lmp_sphere_accumulate_n(NULL, BANDS, &no_spheres, 0, none, 0, layout, 0, NULL);
        lmp_sphere_accumulate_gradient_n(NULL, BANDS, &no_spheres, 0, none, 0, layout, 0, NULL, 0,
                                         NULL);
        lmp_lobe_response_n(BANDS, factors, none, &no_spheres, 0, none, 0, layout, 0, NULL);
    }
    lmp_probe_irradiance_n(BANDS, sh, none, 0, NULL);
    lmp_shade_n(NULL, &no_surfaces, 0, NULL, 0, 0, NULL);
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

static void eval(lmp_sh_layout layout, size_t stride, float *out) {
    lmp_sh_eval_n(BANDS, lmp_vec3_array_of(axes), COUNT, layout, stride, out);
}

static void rotate(lmp_sh_layout layout, size_t stride, float *out) {
    static float from[9 * VALUES * 2 * COUNT];
    eval(layout, stride, from);
    lmp_sh_rotate_n(BANDS, matrices, from, COUNT, layout, stride, out);
}

static void zonal(lmp_sh_layout layout, size_t stride, float *out) {
    const lmp_float_array radii = { &lights->radius, sizeof *lights };
    lmp_sphere_zonal_n(BANDS, radii, radii, COUNT, layout, stride, out);
}

static void project(lmp_sh_layout layout, size_t stride, float *out) {
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_project_n(BANDS, &spheres, lmp_vec3_array_of(points), COUNT, layout, stride, out);
}

static void project_all(lmp_sh_layout layout, size_t stride, float *out) {
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_project_all(BANDS, &spheres, COUNT / 7, lmp_vec3_array_of(points), 7, layout, stride,
                           out);
}

static void accumulate(lmp_sh_layout layout, size_t stride, float *out) {
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_accumulate_n(NULL, BANDS, &spheres, 3, lmp_vec3_array_of(points), COUNT, layout,
                            stride, out);
}

static void gradient(lmp_sh_layout layout, size_t stride, float *out) {
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_sphere_accumulate_gradient_n(NULL, BANDS, &spheres, 3, lmp_vec3_array_of(points), COUNT,
                                     layout, 0, other, stride, out);
}

static void respond(lmp_sh_layout layout, size_t stride, float *out) {
    const lmp_spheres spheres = lmp_spheres_of(lights);
    lmp_lobe_response_n(BANDS, lambda, lmp_vec3_array_of(axes), &spheres, 3,
                        lmp_vec3_array_of(points), COUNT, layout, stride, out);
}

static void strides_are_in_bytes_everywhere(void **state) {
    (void)state;
    static const struct {
        size_t values;
        void (*fill)(lmp_sh_layout layout, size_t stride, float *out);
    } functions[] = { { VALUES, eval },         { VALUES, rotate },      { BANDS, zonal },
                      { VALUES, project },      { VALUES, project_all }, { 3 * VALUES, accumulate },
                      { 9 * VALUES, gradient }, { 3, respond } };
    lmp_lobe_phong(BANDS, 2, lambda);
    lmp_sh_rotation(BANDS, (lmp_quat) { 0.5f, 0.5f, 0.5f, 0.5f }, matrices);
    for (int i = 0; i < COUNT; i++) {
        points[i] = check_random_direction();
        axes[i] = check_random_direction();
        lights[i] = (lmp_light) { .position = { 3, 0, (float)i }, .radius = 0.2f };
    }
    for (size_t f = 0; f < sizeof functions / sizeof *functions; f++)
        for (lmp_sh_layout layout = LMP_SH_INTERLEAVED; layout <= LMP_SH_PLANAR; layout++) {
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(preintegrated_lobes_read_nan_as_nan),
        cmocka_unit_test(preintegrated_brdfs_read_nan_as_nan),
        cmocka_unit_test(tables_read_what_has_no_place_as_nan),
        cmocka_unit_test(shading_keeps_nan),
        cmocka_unit_test(the_horizon_is_finite),
        cmocka_unit_test(a_count_of_0_needs_no_arrays),
        cmocka_unit_test(strides_are_in_bytes_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

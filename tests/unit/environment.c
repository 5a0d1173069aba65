/* SPDX-License-Identifier: MIT */
/* Ambient light: closed forms, the sum of n² products in double, and lights whose
 * coefficients an environment holds. */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/shade.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static lmp_surface random_surface(void) {
    return (lmp_surface) { .normal = check_random_direction(), .view = check_random_direction() };
}

static const lmp_material painted = { .diffuse = { 0.5f, 0.25f, 0.125f },
                                      .specular = { 0.25f, 0.5f, 0.75f },
                                      .exponent = 40 };

static double dot(lmp_vec3 a, lmp_vec3 b) {
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

static lmp_vec3 mirrored(const lmp_surface *s) {
    const float twice = 2 * (float)dot(s->normal, s->view);
    return (lmp_vec3) { twice * s->normal.x - s->view.x, twice * s->normal.y - s->view.y,
                        twice * s->normal.z - s->view.z };
}

static void random_coefficients(int bands, float *sh) {
    for (size_t i = 0; i < 3 * LMP_SH_COUNT(bands); i++)
        sh[i] = (float)check_random_between(-1, 1);
}

/* A lobe reflects its integral of ambient radiance 1, in any number of bands. */
static void a_constant_environment_gives_the_albedo(void **state) {
    (void)state;
    static float sh[3 * 128 * 128];
    const int counts[] = { 1, 2, 10, 33, 128 };
    for (int i = 0; i < 5; i++) {
        const size_t n = LMP_SH_COUNT(counts[i]);
        const lmp_environment even = { sh, counts[i] };
        memset(sh, 0, sizeof sh);
        for (size_t c = 0; c < 3; c++)
            sh[c * n] = (float)sqrt(4 * ORACLE_PI) * (float)(c + 1);
        for (int window = LMP_WINDOW_NONE; window <= LMP_WINDOW_HANNING; window++) {
            const lmp_shade_settings settings = { .bands = counts[i],
                                                  .window = (lmp_window)window };
            const lmp_surface surface = random_surface();
            const lmp_rgb color = lmp_shade_environment(&settings, &painted, &surface, &even);
            CHECK_WITHIN(fabs((double)color.r - 0.75), 1e-6);
            CHECK_WITHIN(fabs((double)color.g - 1.5), 2e-6);
            CHECK_WITHIN(fabs((double)color.b - 2.625), 3e-6);
        }
    }
}

/* L(w) = 2 + w·d: a cosine lobe keeps two thirds of the slope, a Phong lobe (e+1)/(e+2). */
static void a_slope_is_reflected_as_the_lobes_keep_it(void **state) {
    (void)state;
    for (int i = 0; i < 100; i++) {
        const lmp_vec3 d = check_random_direction();
        const lmp_surface surface = random_surface();
        const float k = (float)sqrt(4 * ORACLE_PI / 3);
        float sh[12];
        for (int c = 0; c < 3; c++) {
            const float plane[4] = { 2 * (float)sqrt(4 * ORACLE_PI), -k * d.y, k * d.z, -k * d.x };
            memcpy(sh + 4 * c, plane, sizeof plane);
        }
        const lmp_environment slope = { sh, 2 };
        const lmp_rgb color = lmp_shade_environment(NULL, &painted, &surface, &slope);
        const double diffuse = 2 + 2 / 3.0 * dot(surface.normal, d);
        const double specular = 2 + 41 / 42.0 * dot(mirrored(&surface), d);
        CHECK_WITHIN(fabs((double)color.r - 0.5 * diffuse - 0.25 * specular), 2e-6);
        CHECK_WITHIN(fabs((double)color.b - 0.125 * diffuse - 0.75 * specular), 2e-6);
    }
}

/* Compares with Σ lambda_l window_l L_lm Y_lm of both lobes, by the oracle; the window is that of
 * the specular lobe and, with coefficients, also that of the diffuse one. */
static void expect_sums(const lmp_shade_settings *settings, const lmp_surface *s,
                        const lmp_environment *e, double sums[3]) {
    const int bands = settings->bands;
    const bool windowed[2] = { settings->window && settings->method == LMP_SHADE_COEFFICIENTS,
                               settings->window != LMP_WINDOW_NONE };
    static double basis[128 * 128], lambda[128];
    const lmp_vec3 axes[2] = { s->normal, mirrored(s) };
    const lmp_rgb weights[2] = { painted.diffuse, painted.specular };
    sums[0] = sums[1] = sums[2] = 0;
    for (int k = 0; k < 2; k++) {
        const double w[3] = { (double)axes[k].x, (double)axes[k].y, (double)axes[k].z };
        oracle_sh_eval(bands, w, basis);
        if (k == 0)
            oracle_lobe_diffuse(bands, lambda);
        else
            oracle_lobe_phong(bands, (double)painted.exponent, lambda);
        for (int c = 0; c < 3; c++)
            for (int l = 0; l < bands && l < e->bands; l++)
                for (int m = -l; m <= l; m++)
                    sums[c] +=
                        (k == 0 ? 1 / ORACLE_PI : 1) * (double)(&weights[k].r)[c] * lambda[l] *
                        (windowed[k] ? (1 + cos(ORACLE_PI * l / bands)) / 2 : 1) *
                        basis[LMP_SH_INDEX(l, m)] *
                        (double)e->sh[(size_t)c * LMP_SH_COUNT(e->bands) + LMP_SH_INDEX(l, m)];
    }
}

static void any_environment_matches_the_definition(void **state) {
    (void)state;
    static float sh[3 * 128 * 128];
    const int counts[][2] = { { 1, 1 }, { 4, 3 }, { 3, 4 }, { 10, 10 }, { 20, 33 }, { 128, 128 } };
    check_errors errors = { 0 };
    for (int i = 0; i < 6; i++)
        for (int n = 0; n < 20; n++) {
            const lmp_environment e = { sh, counts[i][1] };
            const lmp_surface surface = random_surface();
            const lmp_shade_settings settings = {
                .bands = counts[i][0],
                .method = n % 4 < 2 ? LMP_SHADE_ZONAL : LMP_SHADE_COEFFICIENTS,
                .window = n % 2 ? LMP_WINDOW_HANNING : LMP_WINDOW_NONE
            };
            double sums[3];
            random_coefficients(e.bands, sh);
            expect_sums(&settings, &surface, &e, sums);
            const lmp_rgb color = lmp_shade_environment(&settings, &painted, &surface, &e);
            for (int c = 0; c < 3; c++)
                check_errors_add(&errors, fabs((double)(&color.r)[c] - fmax(sums[c], 0)));
        }
    printf("error max %.2g, rms %.2g of coefficients to 1\n", errors.largest,
           check_errors_rms(&errors));
    CHECK_WITHIN(errors.largest, 2e-5);
}

/* Lights that are the same from every point shine alike as lights and as coefficients. */
static void an_environment_of_lights_shines_as_they_do(void **state) {
    (void)state;
    lmp_brdf *brdf = NULL;
    lmp_brdf_table *table = NULL;
    const lmp_ggx metal = { 0.4f, 0.2f, { 0.9f, 0.6f, 0.3f }, { 0.1f, 0.1f, 0.2f } };
    const lmp_brdf_table_desc desc = { .bands = 10, .views = 24, .azimuths = 8 };
    assert_int_equal(lmp_brdf_create_ggx(NULL, &metal, &brdf), LMP_OK);
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    const lmp_material materials[] = { painted, { .kind = LMP_MATERIAL_TABLE, .table = table } };
    for (int i = 0; i < 200; i++) {
        const lmp_light lights[2] = { { .kind = LMP_LIGHT_CAP,
                                        .direction = check_random_direction(),
                                        .angle = 0.5f,
                                        .radiance = { 3, 2, 1 } },
                                      { .kind = LMP_LIGHT_HEMISPHERE,
                                        .direction = check_random_direction(),
                                        .radiance = { 1, 2, 3 },
                                        .ground = { 0.5f, 0.5f, 0.5f } } };
        float sh[300];
        lmp_surface surface = random_surface();
        surface.tangent = check_random_direction();
        lmp_light_project(10, lights, 2, surface.position, sh);
        const lmp_environment e = { sh, 10 };
        const lmp_shade_settings settings = { .method = LMP_SHADE_COEFFICIENTS };
        const lmp_rgb a = lmp_shade(&settings, &materials[i % 2], &surface, lights, 2);
        const lmp_rgb b = lmp_shade_environment(NULL, &materials[i % 2], &surface, &e);
        for (int c = 0; c < 3; c++)
            CHECK_WITHIN(fabs((double)(&a.r)[c] - (double)(&b.r)[c]), 1e-5);
    }
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
}

static void a_rotation_of_everything_changes_nothing(void **state) {
    (void)state;
    for (int i = 0; i < 50; i++) {
        float sh[300], rotated[300], matrices[LMP_SH_ROTATION_COUNT(10)];
        const lmp_quat q = check_random_rotation();
        const lmp_surface s = random_surface();
        double r[9];
        oracle_quaternion_matrix((double[]) { (double)q.x, (double)q.y, (double)q.z, (double)q.w },
                                 r);
        lmp_surface t = s;
        for (int k = 0; k < 3; k++) {
            (&t.normal.x)[k] =
                (float)(r[3 * k] * (double)s.normal.x + r[3 * k + 1] * (double)s.normal.y +
                        r[3 * k + 2] * (double)s.normal.z);
            (&t.view.x)[k] = (float)(r[3 * k] * (double)s.view.x + r[3 * k + 1] * (double)s.view.y +
                                     r[3 * k + 2] * (double)s.view.z);
        }
        random_coefficients(10, sh);
        lmp_sh_make_rotation(10, q, matrices);
        for (int c = 0; c < 3; c++)
            lmp_sh_rotate(10, matrices, sh + 100 * c, rotated + 100 * c);
        const lmp_rgb a = lmp_shade_environment(NULL, &painted, &s, &(lmp_environment) { sh, 10 });
        const lmp_rgb b =
            lmp_shade_environment(NULL, &painted, &t, &(lmp_environment) { rotated, 10 });
        for (int c = 0; c < 3; c++)
            CHECK_WITHIN(fabs((double)(&a.r)[c] - (double)(&b.r)[c]), 1e-5);
    }
}

/* The colors are the same for any number of surfaces, any materials, and any stride. */
static void many_surfaces_are_shaded_as_each_of_them(void **state) {
    (void)state;
    enum { COUNT = 37, BANDS = 12 };
    lmp_surface surfaces[COUNT];
    lmp_material materials[COUNT];
    float sh[3 * BANDS * BANDS], rgb[4 * COUNT];
    for (int i = 0; i < COUNT; i++) {
        surfaces[i] = random_surface();
        materials[i] = painted;
        materials[i].exponent = (float)(1 + i * i);
        materials[i].kind = i % 5 == 4 ? LMP_MATERIAL_PREINTEGRATED : LMP_MATERIAL_LOBES;
    }
    random_coefficients(BANDS, sh);
    const lmp_environment e = { sh, BANDS };
    const lmp_shade_settings settings = { .bands = BANDS };
    for (size_t first = 0; first < 12; first++) {
        const lmp_surfaces many = {
            .normal = { &surfaces[first].normal.x, &surfaces[first].normal.y,
                        &surfaces[first].normal.z, sizeof *surfaces },
            .view = { &surfaces[first].view.x, &surfaces[first].view.y, &surfaces[first].view.z,
                      sizeof *surfaces },
            .material = &materials[first],
            .material_stride = sizeof *materials,
        };
        lmp_shade_environment_n(&settings, &many, COUNT - first, &e,
                                (lmp_rgb_array) { rgb, 4 * sizeof *rgb });
        for (size_t i = first; i < COUNT; i++) {
            const lmp_rgb one = lmp_shade_environment(&settings, &materials[i], &surfaces[i], &e);
            assert_memory_equal(&one, rgb + 4 * (i - first), sizeof one);
            assert_true(i % 5 != 4 || (one.r == 0 && one.g == 0 && one.b == 0));
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_constant_environment_gives_the_albedo),
        cmocka_unit_test(a_slope_is_reflected_as_the_lobes_keep_it),
        cmocka_unit_test(any_environment_matches_the_definition),
        cmocka_unit_test(an_environment_of_lights_shines_as_they_do),
        cmocka_unit_test(a_rotation_of_everything_changes_nothing),
        cmocka_unit_test(many_surfaces_are_shaded_as_each_of_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

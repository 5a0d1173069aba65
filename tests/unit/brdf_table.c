/* SPDX-License-Identifier: MIT */
/* Tables of BRDFs: projection against the vector files and laws. */
#include "tests/oracle/oracle.h"
#include "tests/unit/brdfs.h"

#include <math.h>
#include <string.h>

/* Returns the error of the m >= 0 coefficients of the red plane, l outer, against a row of a vector
 * file; those of m < 0 must vanish. */
static double error_of_row(const float *sh, const double expected[55]) {
    float reduced[55];
    double odd = 0;
    for (int l = 0; l < 10; l++)
        for (int m = 0; m <= l; m++) {
            reduced[LMP_SH_HALF_INDEX(l, m)] = sh[LMP_SH_INDEX(l, m)];
            if (m > 0)
                odd = fmax(odd, fabs((double)sh[LMP_SH_INDEX(l, -m)]));
        }
    return fmax(odd, check_error(55, expected, reduced));
}

static lmp_vec3 view_at(double theta) {
    return (lmp_vec3) { (float)sin(theta), 0, (float)cos(theta) };
}

/* Exponent 0 is diffuse; the clamp of a wide lobe is an edge on which quadrature converges slowly.
 */
static void lambert_and_phong_match_the_vectors(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("brdf_table.csv");
    for (int row = 0; row < csv->rows; row++) {
        double expected[55];
        float sh[300];
        const double exponent = check_csv_number(csv, row, 0);
        const lmp_vec3 view = view_at(check_csv_number(csv, row, 1));
        lmp_brdf *brdf = exponent > 0 ? phong((float)exponent) : lambert(1, 1, 1);
        check_csv_numbers(csv, row, 2, 55, expected);
        assert_int_equal(lmp_brdf_project(NULL, 10, exponent > 0 ? 128 : 16, brdf, view, sh),
                         LMP_OK);
        CHECK_WITHIN(error_of_row(sh, expected), exponent == 1 ? 3e-5 : 2e-6);
        lmp_brdf_destroy(brdf);
    }
    check_csv_close(csv);
}

static void tables_hold_the_projection_of_each_view(void **state) {
    (void)state;
    lmp_brdf *brdf = phong(20);
    lmp_brdf_table *table = NULL;
    const lmp_brdf_table_desc desc = { .bands = 12, .views = 7 };
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    assert_true(info.mirrored && info.azimuths == 1 && info.count == 78);
    assert_true(info.change <= 1e-4f);
    for (int view = 0; view < 7; view++) {
        float sh[3 * 144];
        const lmp_vec3 wo = view_at(view * (double)info.theta_step);
        assert_int_equal(lmp_brdf_project(NULL, 12, 256, brdf, wo, sh), LMP_OK);
        const float *row = lmp_brdf_table_coefficients(table) + (size_t)view * 3 * info.count;
        for (int l = 0; l < 12; l++)
            for (int m = 0; m <= l; m++)
                for (int c = 0; c < 3; c++)
                    CHECK_WITHIN(fabsf(row[(size_t)c * 78 + LMP_SH_HALF_INDEX(l, m)] -
                                       sh[(size_t)c * 144 + LMP_SH_INDEX(l, m)]),
                                 1e-4);
    }
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
}

static void white_furnace_lambert_reflects_all(void **state) {
    (void)state;
    lmp_brdf *brdf = lambert(1, 1, 1);
    lmp_brdf_table *table = NULL;
    assert_int_equal(lmp_brdf_table_create(NULL, NULL, brdf, &table), LMP_OK);
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    assert_int_equal(info.bands, 10);
    assert_int_equal(info.window, LMP_WINDOW_NONE);
    for (int view = 0; view < info.views; view++) {
        lmp_rgb exact, series;
        lmp_brdf_table_find_albedo(table, view, 0, &exact, &series);
        CHECK_WITHIN(fabsf(exact.g - 1), 1e-6);
        /* what the truncated series leaks below the horizon */
        CHECK_WITHIN(fabsf(series.g - 1), 2e-2);
    }
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
}

static void level_views_read_the_last_row(void **state) {
    (void)state;
    lmp_brdf *brdf = phong(5);
    lmp_brdf_table *table = NULL;
    const lmp_brdf_table_desc desc = { .bands = 4, .views = 9 };
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    const size_t count = 3 * lmp_brdf_table_describe(table).count;
    float rgb[3 * 10];
    assert_int_equal(count, 3 * 10);
    lmp_brdf_table_interpolate(table, 0, 0, rgb);
    assert_memory_equal(rgb, lmp_brdf_table_coefficients(table) + 8 * count, sizeof rgb);
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
}

static void the_albedo_is_that_of_each_channel(void **state) {
    (void)state;
    lmp_brdf *brdf = lambert(0.9f, 0.5f, 0.2f);
    lmp_brdf_table *table = NULL;
    assert_int_equal(lmp_brdf_table_create(NULL, NULL, brdf, &table), LMP_OK);
    lmp_rgb exact, series;
    lmp_brdf_table_find_albedo(table, 3, 0, &exact, &series);
    CHECK_WITHIN(fabsf(exact.r - 0.9f), 1e-6);
    CHECK_WITHIN(fabsf(exact.g - 0.5f), 1e-6);
    CHECK_WITHIN(fabsf(exact.b - 0.2f), 1e-6);
    CHECK_WITHIN(fabsf(series.r - 0.9f), 0.9 * 2e-2);
    CHECK_WITHIN(fabsf(series.g - 0.5f), 0.5 * 2e-2);
    CHECK_WITHIN(fabsf(series.b - 0.2f), 0.2 * 2e-2);
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
}

/* Checks the window of a table, whose bands have l + 1 coefficients where m < 0 is left out, else 2
 * l + 1. */
static void check_window(lmp_brdf *brdf, bool mirrored) {
    enum { BANDS = 8, VIEWS = 3, AZIMUTHS = 4 };
    lmp_brdf_table *plain = NULL, *windowed = NULL;
    lmp_brdf_table_desc desc = {
        .bands = BANDS, .views = VIEWS, .azimuths = AZIMUTHS, .rings_max = 64
    };
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &plain), LMP_OK);
    desc.window = LMP_WINDOW_LANCZOS;
    desc.window_size = 9;
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &windowed), LMP_OK);
    float weights[BANDS];
    lmp_sh_make_window(BANDS, LMP_WINDOW_LANCZOS, 9, weights);
    const float *a = lmp_brdf_table_coefficients(plain), *b = lmp_brdf_table_coefficients(windowed);
    for (int plane = 0; plane < 3 * VIEWS * (mirrored ? 1 : AZIMUTHS); plane++)
        for (int l = 0; l < BANDS; l++)
            for (int m = mirrored ? 0 : -l; m <= l; m++, a++, b++)
                CHECK_WITHIN(fabsf(*a * weights[l] - *b), 1e-7);
    lmp_brdf_table_destroy(plain);
    lmp_brdf_table_destroy(windowed);
    lmp_brdf_destroy(brdf);
}

/* The window of the paper scales each band as lmp_sh_make_window does. */
static void windows_scale_the_bands(void **state) {
    (void)state;
    check_window(phong(10), true);
    check_window(ggx(0.5f, 0.3f), false);
}

/* Returns the largest error of interpolated coefficients over views off the nodes, relative to the
 * largest coefficient. */
static double interpolation_error(const lmp_brdf *brdf, int views, int azimuths, double phi) {
    lmp_brdf_table *table = NULL;
    const lmp_brdf_table_desc desc = {
        .bands = 10, .views = views, .azimuths = azimuths, .symmetry = LMP_BRDF_SYMMETRY_NONE
    };
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    float matrices[LMP_SH_ROTATION_COUNT(10)], sh[300], rotated[300], rgb[300];
    const lmp_quat back = { 0, 0, (float)sin(-phi / 2), (float)cos(phi / 2) };
    lmp_sh_make_rotation(10, back, matrices);
    double worst = 0, largest = 0;
    for (int n = 0; n < 40; n++) {
        const double theta = 0.01 + 1.45 * n / 39;
        const lmp_vec3 wo = { (float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)),
                              (float)cos(theta) };
        assert_int_equal(lmp_brdf_project(NULL, 10, 128, brdf, wo, sh), LMP_OK);
        for (int c = 0; c < 3; c++)
            lmp_sh_rotate(10, matrices, sh + 100 * c, rotated + 100 * c);
        lmp_brdf_table_interpolate(table, (float)cos(theta), (float)phi, rgb);
        for (int i = 0; i < 300; i++) {
            worst = fmax(worst, fabs((double)rgb[i] - (double)rotated[i]));
            largest = fmax(largest, fabs((double)rotated[i]));
        }
    }
    lmp_brdf_table_destroy(table);
    return worst / largest;
}

static void views_between_nodes_are_smooth(void **state) {
    (void)state;
    lmp_brdf *brdf = phong(60);
    CHECK_WITHIN(interpolation_error(brdf, 64, 0, 0), 2e-4);
    CHECK_WITHIN(interpolation_error(brdf, 64, 0, 2.5), 2e-4);
    lmp_brdf_destroy(brdf);
}

/* An anisotropic table read at any azimuth is the projection in the material's frame, rotated. */
static void anisotropic_tables_rotate_with_the_view(void **state) {
    (void)state;
    lmp_brdf *brdf = ggx(0.6f, 0.3f);
    CHECK_WITHIN(interpolation_error(brdf, 24, 24, 0), 1e-2);
    CHECK_WITHIN(interpolation_error(brdf, 24, 24, 0.63), 1e-2);
    CHECK_WITHIN(interpolation_error(brdf, 24, 24, -2.2), 1e-2);
    lmp_brdf_destroy(brdf);
}

/* Rotating an anisotropic lobe around the normal rotates its coefficients. */
static void lobes_that_rotate_have_rotated_coefficients(void **state) {
    (void)state;
    const lmp_ggx along = { 0.6f, 0.3f, { 1, 1, 1 }, { 0, 0, 0 } };
    const lmp_ggx across = { 0.3f, 0.6f, { 1, 1, 1 }, { 0, 0, 0 } };
    lmp_brdf *a = NULL, *b = NULL;
    assert_int_equal(lmp_brdf_create_ggx(NULL, &along, &a), LMP_OK);
    assert_int_equal(lmp_brdf_create_ggx(NULL, &across, &b), LMP_OK);
    float sh_a[300], sh_b[300], rotated[100], matrices[LMP_SH_ROTATION_COUNT(10)];
    assert_int_equal(lmp_brdf_project(NULL, 10, 128, a, (lmp_vec3) { 0.6f, 0, 0.8f }, sh_a),
                     LMP_OK);
    assert_int_equal(lmp_brdf_project(NULL, 10, 128, b, (lmp_vec3) { 0, 0.6f, 0.8f }, sh_b),
                     LMP_OK);
    lmp_sh_make_rotation(10, (lmp_quat) { 0, 0, sqrtf(0.5f), sqrtf(0.5f) }, matrices);
    lmp_sh_rotate(10, matrices, sh_a, rotated);
    for (int i = 0; i < 100; i++)
        CHECK_WITHIN(fabsf(rotated[i] - sh_b[i]), 2e-6);
    lmp_brdf_destroy(a);
    lmp_brdf_destroy(b);
}

/* The measurement is noisy: its table of m >= 0 averages f_r with its mirror image, which is the
 * cosine part of the whole. */
static void mirrored_tables_of_measurements_are_their_even_part(void **state) {
    (void)state;
    enum { CELLS = 6 * 5 * 9, BANDS = 7, VIEWS = 5 };
    unsigned char bytes[12 + 24 * CELLS];
    const int32_t shape[3] = { 6, 5, 9 };
    memcpy(bytes, shape, sizeof shape);
    for (size_t i = 0; i < 3 * CELLS; i++) {
        const double value = 1500 * check_random();
        memcpy(bytes + 12 + 8 * i, &value, sizeof value);
    }
    lmp_brdf *brdf = NULL;
    lmp_brdf_table *tables[2] = { NULL };
    assert_int_equal(lmp_brdf_read_merl(NULL, bytes, sizeof bytes, NULL, &brdf), LMP_OK);
    lmp_brdf_table_desc desc = { .bands = BANDS, .views = VIEWS, .rings_max = 64 };
    for (int i = 0; i < 2; i++) {
        desc.symmetry = i == 0 ? LMP_BRDF_SYMMETRY_NONE : LMP_BRDF_SYMMETRY_MIRROR;
        assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &tables[i]), LMP_OK);
    }
    const float *whole = lmp_brdf_table_coefficients(tables[0]);
    const float *even = lmp_brdf_table_coefficients(tables[1]);
    double odd = 0;
    for (int plane = 0; plane < 3 * VIEWS; plane++, whole += BANDS * BANDS)
        for (int l = 0; l < BANDS; l++)
            for (int m = 0; m <= l; m++) {
                /* seen head-on every phi_d is 0, on an edge between cells */
                const float change = plane < 3 ? 0 : fabsf(*even - whole[LMP_SH_INDEX(l, m)]);
                CHECK_WITHIN(change, 1e-6);
                even++;
                odd = fmax(odd, m > 0 ? fabs((double)whole[LMP_SH_INDEX(l, -m)]) : 0);
            }
    assert_true(odd > 1e-3);
    lmp_brdf_table_destroy(tables[0]);
    lmp_brdf_table_destroy(tables[1]);
    lmp_brdf_destroy(brdf);
}

/* Whether a table is mirrored, and how finely it is integrated, depends on the shape of a
 * measurement and not on its brightness; a black one is even, and done at once. */
static void a_dim_measurement_is_tabulated_like_a_bright_one(void **state) {
    (void)state;
    enum { CELLS = 4 * 4 * 8 };
    static const double scales[] = { 1500, 1, 1e-3, 1e-6, 0 };
    double cells[3 * CELLS];
    for (size_t i = 0; i < 3 * CELLS; i++)
        cells[i] = check_random();
    for (int even = 0; even < 2; even++) {
        lmp_brdf_table_info first = { .bands = 0 };
        for (size_t i = 0; i < 3 * CELLS && even; i++) /* light and view may be exchanged */
            cells[i] = cells[i / 8 * 8 + (i % 8 < 4 ? i % 8 : 7 - i % 8)];
        for (int k = 0; k < 5; k++) {
            const int32_t shape[3] = { 4, 4, 8 };
            unsigned char bytes[12 + 24 * CELLS];
            lmp_brdf *brdf = NULL;
            lmp_brdf_table *table = NULL;
            memcpy(bytes, shape, sizeof shape);
            for (size_t i = 0; i < 3 * CELLS; i++) {
                const double value = scales[k] * cells[i];
                memcpy(bytes + 12 + 8 * i, &value, sizeof value);
            }
            assert_int_equal(lmp_brdf_read_merl(NULL, bytes, sizeof bytes, NULL, &brdf), LMP_OK);
            const lmp_brdf_table_desc desc = {
                .bands = 4, .views = 4, .rings_max = 256, .tolerance = 0.02f
            };
            assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
            const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
            first = k == 0 ? info : first;
            assert_int_equal(info.mirrored, even || scales[k] <= 0);
            if (scales[k] > 0) {
                assert_int_equal(info.rings, first.rings);
                CHECK_WITHIN(fabsf(info.change - first.change), 1e-5);
            }
            CHECK_WITHIN(info.change, scales[k] > 0 ? 0.02 : 0);
            assert_true(info.change > 0 || !(scales[k] > 0));
            lmp_brdf_table_destroy(table);
            lmp_brdf_destroy(brdf);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lambert_and_phong_match_the_vectors),
        cmocka_unit_test(tables_hold_the_projection_of_each_view),
        cmocka_unit_test(white_furnace_lambert_reflects_all),
        cmocka_unit_test(level_views_read_the_last_row),
        cmocka_unit_test(the_albedo_is_that_of_each_channel),
        cmocka_unit_test(windows_scale_the_bands),
        cmocka_unit_test(views_between_nodes_are_smooth),
        cmocka_unit_test(anisotropic_tables_rotate_with_the_view),
        cmocka_unit_test(lobes_that_rotate_have_rotated_coefficients),
        cmocka_unit_test(mirrored_tables_of_measurements_are_their_even_part),
        cmocka_unit_test(a_dim_measurement_is_tabulated_like_a_bright_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

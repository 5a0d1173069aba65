/* SPDX-License-Identifier: MIT */
/* Files of BRDFs, MERL's and RGL's: round trips, lack of memory, and damage. */
#include "tests/oracle/oracle.h"
#include "tests/unit/brdfs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PAIRS 10000

/* --- round trips ------------------------------------------------------------------------------ */

typedef lmp_result (*writer)(const lmp_host *, const lmp_brdf *, void **, size_t *);
typedef lmp_result (*reader)(const lmp_host *, const void *, size_t, lmp_parse_error *,
                             lmp_brdf **);

static lmp_brdf *through(const lmp_brdf *brdf, writer write, reader read) {
    void *data = NULL;
    size_t size = 0;
    lmp_brdf *copy = NULL;
    lmp_parse_error error = { 0 };
    assert_int_equal(write(NULL, brdf, &data, &size), LMP_OK);
    if (read(NULL, data, size, &error, &copy) != LMP_OK)
        fail_msg("%s", error.text);
    free(data);
    return copy;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Returns the median of |copy - original| / original (green) over random pairs. */
static double median_error(const lmp_brdf *original, const lmp_brdf *copy) {
    static double errors[PAIRS];
    for (int n = 0; n < PAIRS; n++) {
        const lmp_vec3 a = random_upper(), b = random_upper();
        const double f = (double)lmp_brdf_eval(original, a, b).g;
        const double g = (double)lmp_brdf_eval(copy, a, b).g;
        assert_true(isfinite(g));
        errors[n] = f == g ? 0 : fabs(g - f) / fmax(f, 1e-9);
    }
    qsort(errors, PAIRS, sizeof *errors, by_value);
    return errors[PAIRS / 2];
}

static void round_trips(writer write, reader read, const double bounds[7]) {
    lmp_brdf *const brdfs[] = { lambert(0.8f, 0.5f, 0.2f),
                                phong(20),
                                ggx(0.3f, 0),
                                sgd_brdf("red-fabric"),
                                sgd_brdf("gold-metallic-paint"),
                                sgd_brdf("specular-blue-phenolic"),
                                ggx(0.5f, 0.2f) };
    for (size_t i = 0; i < 7; i++) {
        if (bounds[i] > 0) {
            lmp_brdf *copy = through(brdfs[i], write, read);
            const double error = median_error(brdfs[i], copy);
            print_message("median error %zu: %.2e\n", i, error);
            CHECK_WITHIN(error, bounds[i]);
            lmp_brdf_destroy(copy);
        }
        lmp_brdf_destroy(brdfs[i]);
    }
}

static void merl_round_trips_to_its_cells(void **state) {
    (void)state;
    const double bounds[7] = { 1e-6, 3e-2, 3e-2, 1e-2, 3e-2, 1e-2, 0 };
    round_trips(lmp_brdf_encode_merl, lmp_brdf_read_merl, bounds);
}

static void rgl_round_trips_to_its_grid(void **state) {
    (void)state;
    const double bounds[7] = { 1e-2, 3e-2, 1e-2, 1e-2, 1e-2, 1e-2, 3e-2 };
    round_trips(lmp_brdf_encode_rgl, lmp_brdf_read_rgl, bounds);
}

/* Finds the pair of directions at the center of a cell of a full file (Matusik et al. 2003), h in
 * x-z. */
static void merl_center(int theta_h, int theta_d, int phi_d, double a[3], double b[3]) {
    const double root = (theta_h + 0.5) / 90, h = ORACLE_PI / 2 * root * root;
    const double d = ORACLE_PI / 2 * (theta_d + 0.5) / 90, phi = ORACLE_PI * (phi_d + 0.5) / 180;
    const double x = sin(d) * cos(phi), y = sin(d) * sin(phi), z = cos(d);
    a[0] = cos(h) * x + sin(h) * z;
    a[1] = y;
    a[2] = cos(h) * z - sin(h) * x;
    b[0] = -cos(h) * x + sin(h) * z;
    b[1] = -y;
    b[2] = cos(h) * z + sin(h) * x;
}

static void merl_cell_centres_are_exact(void **state) {
    (void)state;
    enum { CELLS = 90 * 90 * 180, TRIES = 20000 };
    static const double scale[3] = { 1.0 / 1500, 1.15 / 1500, 1.66 / 1500 };
    static const int32_t shape[3] = { 90, 90, 180 };
    unsigned char *bytes = malloc(LMP_MERL_SIZE);
    assert_non_null(bytes);
    memcpy(bytes, shape, sizeof shape);
    double value;
    for (int i = 0; i < 3 * CELLS; i++) {
        value = check_random();
        memcpy(bytes + 12 + 8 * (size_t)i, &value, sizeof value);
    }
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_read_merl(NULL, bytes, LMP_MERL_SIZE, NULL, &brdf), LMP_OK);
    int above = 0;
    for (int n = 0; n < TRIES; n++) {
        const int i = (int)(90 * check_random()), j = (int)(90 * check_random());
        const int k = (int)(180 * check_random());
        double a[3], b[3], rgb[3];
        merl_center(i, j, k, a, b);
        if (a[2] <= 0 || b[2] <= 0)
            continue;
        above++;
        lmp_brdf_eval_double(brdf, a, b, rgb);
        for (size_t c = 0; c < 3; c++) {
            memcpy(&value, bytes + 12 + 8 * (c * CELLS + (size_t)((i * 90 + j) * 180 + k)),
                   sizeof value);
            assert_true(rgb[c] == (double)(float)(value * scale[c]));
        }
    }
    assert_true(above > TRIES / 4);
    lmp_brdf_destroy(brdf);
    free(bytes);
}

/* --- bad bytes -------------------------------------------------------------------------------- */

/* A MERL file of 2 x 3 x 4 cells, each holding its number. */
enum { SMALL_MERL = 12 + 24 * 24 };
static void small_merl(unsigned char bytes[SMALL_MERL]) {
    const int32_t shape[3] = { 2, 3, 4 };
    memcpy(bytes, shape, sizeof shape);
    for (int i = 0; i < 72; i++) {
        const double value = i + 1;
        memcpy(bytes + 12 + 8 * i, &value, sizeof value);
    }
}

static lmp_result read_small_merl(const lmp_host *host) {
    unsigned char bytes[SMALL_MERL];
    small_merl(bytes);
    lmp_brdf *brdf = NULL;
    const lmp_result result = lmp_brdf_read_merl(host, bytes, sizeof bytes, NULL, &brdf);
    lmp_brdf_destroy(brdf);
    return result;
}

static void expect_parse_error(reader read, const void *data, size_t size, const char *text) {
    lmp_brdf *brdf = NULL;
    lmp_parse_error error = { 0 };
    assert_int_not_equal(read(NULL, data, size, &error, &brdf), LMP_OK);
    assert_null(brdf);
    if (!strstr(error.text, text))
        fail_msg("'%s' does not say '%s'", error.text, text);
}

static void merl_cells_read_exactly(void **state) {
    (void)state;
    unsigned char bytes[SMALL_MERL];
    small_merl(bytes);
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_read_merl(NULL, bytes, sizeof bytes, NULL, &brdf), LMP_OK);
    /* head on: theta_h = theta_d = 0, phi_d = 0: the first cell of each plane */
    const lmp_rgb f = lmp_brdf_eval(brdf, (lmp_vec3) { 0, 0, 1 }, (lmp_vec3) { 0, 0, 1 });
    CHECK_WITHIN(fabsf(f.r - 1.0f / 1500), 1e-9);
    CHECK_WITHIN(fabsf(f.g - 25 * 1.15f / 1500), 1e-8);
    CHECK_WITHIN(fabsf(f.b - 49 * 1.66f / 1500), 1e-8);
    lmp_brdf_destroy(brdf);
}

static void damaged_merl_is_refused_with_its_reason(void **state) {
    (void)state;
    unsigned char bytes[SMALL_MERL];
    small_merl(bytes);
    expect_parse_error(lmp_brdf_read_merl, bytes, 11, "12 bytes");
    expect_parse_error(lmp_brdf_read_merl, bytes, SMALL_MERL - 1, "need 588 bytes");
    const double bad[3] = { (double)NAN, (double)INFINITY, (double)-INFINITY };
    for (int i = 0; i < 3; i++) {
        memcpy(bytes + 12 + 8 * 30, &bad[i], sizeof bad[i]);
        expect_parse_error(lmp_brdf_read_merl, bytes, SMALL_MERL, "cell 6 of channel 1");
    }
    for (size_t length = 0; length < SMALL_MERL; length++)
        expect_parse_error(lmp_brdf_read_merl, bytes, length,
                           length < 12 ? "12 bytes" : "need 588");
    const int32_t zero = 0, huge = 0x7fffffff, negative = -90;
    memcpy(bytes, &zero, 4);
    expect_parse_error(lmp_brdf_read_merl, bytes, SMALL_MERL, "dimension 0 is 0");
    memcpy(bytes, &huge, 4);
    expect_parse_error(lmp_brdf_read_merl, bytes, SMALL_MERL, "dimension 0");
    memcpy(bytes, &negative, 4);
    expect_parse_error(lmp_brdf_read_merl, bytes, SMALL_MERL, "dimension 0 is -90");
}

static void negative_merl_cells_are_black(void **state) {
    (void)state;
    unsigned char bytes[SMALL_MERL];
    small_merl(bytes);
    const double negative = -1;
    memcpy(bytes + 12, &negative, sizeof negative);
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_read_merl(NULL, bytes, sizeof bytes, NULL, &brdf), LMP_OK);
    const lmp_rgb f = lmp_brdf_eval(brdf, (lmp_vec3) { 0, 0, 1 }, (lmp_vec3) { 0, 0, 1 });
    assert_true(f.r == 0 && f.g > 0);
    lmp_brdf_destroy(brdf);
}

/* --- memory ----------------------------------------------------------------------------------- */

typedef lmp_result (*attempt)(const lmp_host *host);

static lmp_result make_every_kind(const lmp_host *host) {
    lmp_sgd parameters;
    assert_int_equal(lmp_brdf_find_sgd("gold-metallic-paint", &parameters), LMP_OK);
    const lmp_ggx desc = { .alpha_x = 0.5f };
    lmp_brdf *brdfs[4] = { NULL };
    lmp_result results[4] = {
        lmp_brdf_create_lambert(host, (lmp_rgb) { 1, 1, 1 }, &brdfs[0]),
        lmp_brdf_create_phong(host, (lmp_rgb) { 1, 1, 1 }, 5, &brdfs[1]),
        lmp_brdf_create_ggx(host, &desc, &brdfs[2]),
        lmp_brdf_create_sgd(host, &parameters, &brdfs[3]),
    };
    lmp_result worst = LMP_OK;
    for (int i = 0; i < 4; i++) {
        assert_true((brdfs[i] == NULL) == (results[i] != LMP_OK));
        worst = results[i] != LMP_OK ? results[i] : worst;
        lmp_brdf_destroy(brdfs[i]);
    }
    return worst;
}

static lmp_result write_with(const lmp_host *host, writer write) {
    lmp_brdf *brdf = lambert(0.8f, 0.5f, 0.2f);
    void *data = brdf;
    size_t size = 7;
    const lmp_result result = write(host, brdf, &data, &size);
    assert_true((data == NULL) == (result != LMP_OK));
    assert_true((size == 0) == (result != LMP_OK));
    if (data)
        host->release(data, host->user);
    lmp_brdf_destroy(brdf);
    return result;
}

static lmp_result write_merl(const lmp_host *host) {
    return write_with(host, lmp_brdf_encode_merl);
}

static lmp_result write_rgl(const lmp_host *host) {
    return write_with(host, lmp_brdf_encode_rgl);
}

static void every_failing_allocation_is_reported(void **state) {
    (void)state;
    static const attempt attempts[] = { make_every_kind, read_small_merl, write_merl, write_rgl };
    for (size_t i = 0; i < sizeof attempts / sizeof *attempts; i++)
        for (int refuse = 0;; refuse++) {
            check_hooks hooks = { .refuse = refuse };
            const lmp_host host = check_host(&hooks);
            const lmp_result result = attempts[i](&host);
            assert_int_equal(hooks.live, 0);
            if (result == LMP_OK) {
                assert_true(refuse > 0);
                break;
            }
            assert_int_equal(result, LMP_ERROR_MEMORY);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(merl_round_trips_to_its_cells),
        cmocka_unit_test(rgl_round_trips_to_its_grid),
        cmocka_unit_test(merl_cell_centres_are_exact),
        cmocka_unit_test(merl_cells_read_exactly),
        cmocka_unit_test(damaged_merl_is_refused_with_its_reason),
        cmocka_unit_test(negative_merl_cells_are_black),
        cmocka_unit_test(every_failing_allocation_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

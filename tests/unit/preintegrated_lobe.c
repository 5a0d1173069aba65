/* SPDX-License-Identifier: MIT */
#include "src/base/bytes.h"
#include "tests/unit/damage.h"

#include <lampion/lampion.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float pi = 3.14159265f;

static lmp_preintegrated_lobe *created(int bands, lmp_window window, float error) {
    lmp_preintegrated_lobe *lobe;
    const lmp_preintegrated_lobe_desc desc = { .bands = bands, .window = window, .error = error };
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &lobe), LMP_OK);
    return lobe;
}

/* One sphere seen from the origin along z, and the same lobe as a series. */
typedef struct probe {
    int bands;
    float exponent;
    float lambda[LMP_BANDS_MAX];
    lmp_light light;
    lmp_cap cap;
} probe;

static probe probe_make(int bands, lmp_window window, float exponent, float radius) {
    probe p = { .bands = bands, .exponent = exponent };
    float weights[LMP_BANDS_MAX];
    lmp_lobe_make_phong(bands, exponent, p.lambda);
    lmp_sh_make_window(bands, window, 0, weights);
    for (int l = 0; l < bands; l++)
        p.lambda[l] *= weights[l];
    p.light = (lmp_light) { .position = { 0, 0, 1 }, .radius = radius, .radiance = { 1, 1, 1 } };
    lmp_light_find_cap(&p.light, (lmp_vec3) { 0, 0, 0 }, &p.cap);
    return p;
}

static lmp_vec3 tilted(float angle) {
    return (lmp_vec3) { sinf(angle), 0, cosf(angle) };
}

static float series(const probe *p, float angle) {
    return lmp_lobe_response(p->bands, p->lambda, tilted(angle), &p->light, 1,
                             (lmp_vec3) { 0, 0, 0 })
        .r;
}

static float read(const lmp_preintegrated_lobe *lobe, const probe *p, float angle) {
    const float cosine = cosf(angle) * p->cap.axis.z;
    return p->cap.strength.r *
               lmp_preintegrated_lobe_eval(lobe, p->exponent, p->cap.one_minus_cos, cosine) +
           p->cap.ambient.r;
}

/* Returns the largest value over all angles. */
static float peak(const probe *p) {
    const float near =
        asinf(fminf(p->light.radius, 1)) + 4 / sqrtf(p->exponent + 1) + 4 / (float)p->bands;
    float largest = 0;
    for (int i = 0; i < 100; i++)
        largest = fmaxf(largest, fabsf(series(p, fminf(near, pi) * (float)i / 99)));
    return largest;
}

/* Compares at angles of which half lie anywhere on the sphere and half where the lobe is. */
static void compare(const lmp_preintegrated_lobe *lobe, const probe *p, int angles,
                    check_errors *errors) {
    const float top = peak(p), near = asinf(fminf(p->light.radius, 1)) +
                                      4 / sqrtf(p->exponent + 1) + 4 / (float)p->bands;
    for (int i = 0; i < angles; i++) {
        const float angle = i % 2 ? acosf((float)check_random_between(-1, 1))
                                  : (float)check_random_between(0, (double)fminf(near, pi));
        check_errors_add(errors, (double)(fabsf(read(lobe, p, angle) - series(p, angle)) / top));
    }
}

static void check_random_probes(int bands, lmp_window window, int probes) {
    lmp_preintegrated_lobe *lobe = created(bands, window, 0);
    check_errors errors = { 0 };
    for (int i = 0; i < probes; i++) {
        const double e = pow(10, check_random_between(0, 4)),
                     r = pow(10, check_random_between(-4, log10(0.99)));
        const probe p = probe_make(bands, window, (float)e, (float)r);
        compare(lobe, &p, 50, &errors);
    }
    const double rms = check_errors_rms(&errors);
    print_message("%d bands, window %d: %zu bytes, %ld values, error max %.3f %%, rms %.4f %%\n",
                  bands, (int)window, lmp_preintegrated_lobe_describe(lobe).bytes, errors.count,
                  100 * errors.largest, 100 * rms);
    CHECK_WITHIN(errors.largest, 5e-3);
    CHECK_WITHIN(rms, 5e-4);
    lmp_preintegrated_lobe_destroy(lobe);
}

static void lobes_match_the_series_within_their_error(void **state) {
    (void)state;
    for (int bands = 1; bands <= 30; bands += 1 + bands / 6)
        check_random_probes(bands, LMP_WINDOW_NONE, 150);
    check_random_probes(50, LMP_WINDOW_NONE, 300);
    check_random_probes(128, LMP_WINDOW_NONE, 400);
    for (int bands = 3; bands <= 50; bands += 1 + bands / 2)
        check_random_probes(bands, LMP_WINDOW_HANNING, 200);
    check_random_probes(40, LMP_WINDOW_LANCZOS, 200);
}

static void lobes_below_exponent_1_are_within_3_percent(void **state) {
    (void)state;
    const int bands[] = { 4, 10, 40 };
    for (int b = 0; b < 3; b++) {
        lmp_preintegrated_lobe *lobe = created(bands[b], LMP_WINDOW_NONE, 0);
        check_errors errors = { 0 };
        for (int i = 0; i < 200; i++) {
            const probe p =
                probe_make(bands[b], LMP_WINDOW_NONE, (float)check_random(), (float)check_random());
            compare(lobe, &p, 20, &errors);
        }
        CHECK_WITHIN(errors.largest, 0.03);
        lmp_preintegrated_lobe_destroy(lobe);
    }
}

static void a_smaller_error_bound_is_kept_and_a_larger_one_takes_less_memory(void **state) {
    (void)state;
    size_t bytes = SIZE_MAX;
    for (float bound = 0.002f; bound < 0.1f; bound *= 4) {
        lmp_preintegrated_lobe *lobe = created(12, LMP_WINDOW_NONE, bound);
        check_errors errors = { 0 };
        for (int i = 0; i < 300; i++) {
            const probe p =
                probe_make(12, LMP_WINDOW_NONE, (float)pow(10, check_random_between(0, 4)),
                           (float)pow(10, check_random_between(-4, 0)));
            compare(lobe, &p, 20, &errors);
        }
        CHECK_WITHIN(errors.largest, bound);
        assert_true(lmp_preintegrated_lobe_describe(lobe).bytes < bytes);
        bytes = lmp_preintegrated_lobe_describe(lobe).bytes;
        lmp_preintegrated_lobe_destroy(lobe);
    }
}

static void lobes_hold_inside_spheres_and_at_their_surface(void **state) {
    (void)state;
    lmp_preintegrated_lobe *lobe = created(16, LMP_WINDOW_NONE, 0);
    check_errors errors = { 0 };
    for (int i = 0; i < 400; i++) {
        const float radius = i < 200 ? (float)check_random_between(1, 100)
                                     : (float)check_random_between(0.999, 1.001);
        const probe p =
            probe_make(16, LMP_WINDOW_NONE, (float)check_random_between(1, 500), radius);
        compare(lobe, &p, 20, &errors);
    }
    CHECK_WITHIN(errors.largest, 5e-3);
    lmp_preintegrated_lobe_destroy(lobe);
}

static void the_mirror_diffuse_and_extreme_exponents_are_finite_everywhere(void **state) {
    (void)state;
    const float exponents[] = { 0, 1e-30f, 0.5f, 1, 3, 20000, 1e6f, 1e30f, INFINITY };
    const int bands[] = { 1, 2, 9, 128 };
    for (size_t b = 0; b < 4; b++) {
        lmp_preintegrated_lobe *lobe = created(bands[b], LMP_WINDOW_NONE, 0.1f);
        for (size_t e = 0; e < 9; e++)
            for (int t = 0; t <= 20; t++)
                for (int c = -20; c <= 20; c++) {
                    const float value = lmp_preintegrated_lobe_eval(lobe, exponents[e],
                                                                    (float)t / 20, (float)c / 20);
                    assert_true(isfinite(value));
                }
        lmp_preintegrated_lobe_destroy(lobe);
    }
}

static void exponents_past_the_last_are_nearly_the_mirrors(void **state) {
    (void)state;
    lmp_preintegrated_lobe *lobe = created(128, LMP_WINDOW_NONE, 0);
    const float exponents[] = { 1e6f, 1e7f, 1e30f };
    check_errors errors = { 0 };
    for (int e = 0; e < 3; e++)
        for (int i = 0; i < 40; i++) {
            const probe p = probe_make(128, LMP_WINDOW_NONE, exponents[e],
                                       powf(10, (float)check_random_between(-4, -0.01)));
            compare(lobe, &p, 50, &errors);
        }
    CHECK_WITHIN(errors.largest, 9e-3);
    lmp_preintegrated_lobe_destroy(lobe);
}

static void slices_join_without_a_step(void **state) {
    (void)state;
    lmp_preintegrated_lobe *lobe = created(20, LMP_WINDOW_NONE, 0);
    float before = lmp_preintegrated_lobe_eval(lobe, 0, 0.02f, 0.99f);
    for (float e = 0.001f; e < 3e4f; e *= 1.0005f) {
        const float now = lmp_preintegrated_lobe_eval(lobe, e, 0.02f, 0.99f);
        CHECK_WITHIN(fabsf(now - before), 0.004 * (double)fmaxf(fabsf(now), 0.1f));
        before = now;
    }
    lmp_preintegrated_lobe_destroy(lobe);
}

/* --- building --------------------------------------------------------------------------------- */

static void *written(const lmp_preintegrated_lobe *lobe, size_t *size) {
    *size = lmp_preintegrated_lobe_size(lobe);
    void *bytes = malloc(*size);
    assert_non_null(bytes);
    assert_int_equal(lmp_preintegrated_lobe_write(lobe, *size - 1, bytes), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_preintegrated_lobe_write(lobe, *size, bytes), LMP_OK);
    return bytes;
}

static void tasks_in_any_order_give_the_same_bytes(void **state) {
    (void)state;
    check_hooks hooks = { .refuse = -1 };
    const lmp_host host = check_host(&hooks);
    const lmp_preintegrated_lobe_desc desc = { .bands = 12 };
    lmp_preintegrated_lobe *plain = created(12, LMP_WINDOW_NONE, 0), *other;
    assert_int_equal(lmp_preintegrated_lobe_create(&host, &desc, &other), LMP_OK);
    assert_true(hooks.tasks > 0);
    CHECK_WITHIN(fabs(hooks.done - 1), 0);
    size_t size, other_size;
    void *bytes = written(plain, &size), *other_bytes = written(other, &other_size);
    assert_int_equal(size, other_size);
    assert_memory_equal(bytes, other_bytes, size);
    free(bytes);
    free(other_bytes);
    lmp_preintegrated_lobe_destroy(plain);
    lmp_preintegrated_lobe_destroy(other);
}

static void arguments_outside_their_range_are_refused(void **state) {
    (void)state;
    const lmp_preintegrated_lobe_desc wrong[] = {
        { .bands = -1 },        { .bands = 129 },   { .window = (lmp_window)7 },
        { .window_size = -1 },  { .error = 1e-5f }, { .error = 0.5f },
        { .window_size = NAN }, { .error = NAN },   { .error = -1 },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        lmp_preintegrated_lobe *lobe = (lmp_preintegrated_lobe *)1;
        assert_int_equal(lmp_preintegrated_lobe_create(NULL, &wrong[i], &lobe), LMP_ERROR_ARGUMENT);
        assert_null(lobe);
    }
}

static void its_bytes_are_those_of_its_parts(void **state) {
    (void)state;
    for (int bands = 1; bands < 40; bands += 9) {
        lmp_preintegrated_lobe *lobe = created(bands, LMP_WINDOW_NONE, 0.1f);
        const lmp_preintegrated_lobe_info info = lmp_preintegrated_lobe_describe(lobe);
        size_t pairs = 0;
        for (uint32_t i = 0; i < info.cell_count; i++)
            pairs += (size_t)info.cells[i].rows * info.cells[i].columns;
        assert_int_equal(info.pair_count, pairs);
        assert_int_equal(info.bytes, info.cell_count * sizeof *info.cells + 4 * pairs +
                                         LMP_PREINTEGRATED_LOBE_REMAP_COUNT * sizeof(float));
        lmp_preintegrated_lobe_destroy(lobe);
    }
}

/* A step follows the width of the lobes, or is the same for a whole cell: the other number is 0. */
static void steps_follow_the_width_or_nothing(void **state) {
    (void)state;
    int kinds[2] = { 0, 0 };
    lmp_preintegrated_lobe *lobe = created(60, LMP_WINDOW_NONE, 0);
    const lmp_preintegrated_lobe_info info = lmp_preintegrated_lobe_describe(lobe);
    for (uint32_t i = 0; i < info.cell_count; i++) {
        assert_true((info.cells[i].scale == 0) != (info.cells[i].offset == 0));
        kinds[info.cells[i].scale == 0]++;
    }
    assert_true(kinds[0] > 0 && kinds[1] > 0);
    lmp_preintegrated_lobe_destroy(lobe);
}

static void a_refused_allocation_leaks_nothing(void **state) {
    (void)state;
    const lmp_preintegrated_lobe_desc desc = { .bands = 2, .error = 0.1f };
    for (int refuse = 0;; refuse++) {
        check_hooks hooks = { .refuse = refuse };
        const lmp_host host = check_host(&hooks);
        lmp_preintegrated_lobe *lobe;
        const lmp_result result = lmp_preintegrated_lobe_create(&host, &desc, &lobe);
        lmp_preintegrated_lobe_destroy(lobe);
        assert_int_equal(hooks.live, 0);
        if (result == LMP_OK)
            break;
        assert_int_equal(result, LMP_ERROR_MEMORY);
        assert_null(lobe);
    }
}

/* --- bytes ------------------------------------------------------------------------------------ */

static void bytes_read_back_are_the_same_lobe(void **state) {
    (void)state;
    lmp_preintegrated_lobe *lobe = created(9, LMP_WINDOW_HANNING, 0), *copy;
    size_t size;
    void *bytes = written(lobe, &size);
    assert_int_equal(lmp_preintegrated_lobe_read(NULL, bytes, size, NULL, &copy), LMP_OK);
    const lmp_preintegrated_lobe_info a = lmp_preintegrated_lobe_describe(lobe),
                                      b = lmp_preintegrated_lobe_describe(copy);
    assert_int_equal(a.pair_count, b.pair_count);
    assert_memory_equal(a.coefficients, b.coefficients, a.pair_count * 4);
    for (int i = 0; i < 1000; i++) {
        const float e = (float)pow(10, check_random_between(-2, 5)), t = (float)check_random(),
                    c = (float)check_random_between(-1, 1);
        const float x = lmp_preintegrated_lobe_eval(lobe, e, t, c),
                    y = lmp_preintegrated_lobe_eval(copy, e, t, c);
        assert_memory_equal(&x, &y, sizeof x);
    }
    free(bytes);
    lmp_preintegrated_lobe_destroy(lobe);
    lmp_preintegrated_lobe_destroy(copy);
}

static lmp_result read_and_use(const unsigned char *bytes, size_t size) {
    lmp_preintegrated_lobe *copy;
    lmp_parse_error error = { size + 1, "" };
    const lmp_result result = lmp_preintegrated_lobe_read(NULL, bytes, size, &error, &copy);
    assert_true(result == LMP_OK || (error.text[0] && error.offset <= size));
    assert_int_equal(result == LMP_OK, copy != NULL);
    for (float e = 0; copy && e < INFINITY; e = 2 * e + 0.3f)
        (void)lmp_preintegrated_lobe_eval(copy, e, 1, -1);
    lmp_preintegrated_lobe_destroy(copy);
    return result;
}

static void damaged_bytes_are_refused(void **state) {
    (void)state;
    const lmp_preintegrated_lobe_desc desc = { .bands = 2, .error = 0.1f };
    lmp_preintegrated_lobe *lobe;
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &lobe), LMP_OK);
    size_t size;
    unsigned char *bytes = written(lobe, &size);
    lmp_preintegrated_lobe_destroy(lobe);
    damage_is_refused(bytes, size, read_and_use);
    damage_stays_in_bounds(bytes, size, 12, 1612, 20000, read_and_use); /* the plan */
    free(bytes);
}

/* Numbers are read whole, so that every bit of the header matters. */
static void every_bit_of_the_header_counts(void **state) {
    (void)state;
    lmp_preintegrated_lobe *lobe = created(3, LMP_WINDOW_HANNING, 0.1f), *copy;
    size_t size;
    unsigned char *bytes = written(lobe, &size);
    for (size_t bit = 8 * 8; bit < 8 * 32; bit++) {
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        damage_sign(bytes, size);
        if (lmp_preintegrated_lobe_read(NULL, bytes, size, NULL, &copy) == LMP_OK) {
            unsigned char *again = written(copy, &(size_t) { 0 });
            assert_memory_equal(bytes, again, size);
            free(again);
            lmp_preintegrated_lobe_destroy(copy);
        }
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    free(bytes);
    lmp_preintegrated_lobe_destroy(lobe);
}

/* 841 cells of 1599 x 3194 pairs are 192950 more than 2^32: a file with the small number must not
 * pass for the large one. */
static void cells_that_outgrow_their_count_are_refused(void **state) {
    (void)state;
    enum { CELLS = 841, PAIRS = 192950 };
    const lmp_preintegrated_lobe_desc desc = { .bands = 2, .error = 0.1f };
    lmp_preintegrated_lobe *lobe, *copy;
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &lobe), LMP_OK);
    size_t size;
    unsigned char *head = written(lobe, &size);
    lmp_preintegrated_lobe_destroy(lobe);
    const size_t plan = 32 + 4 * LMP_PREINTEGRATED_LOBE_REMAP_COUNT;
    size = plan + 8 * CELLS + 4 * PAIRS + 4;
    unsigned char *bytes = calloc(size, 1), *p = bytes + 28;
    assert_non_null(bytes);
    memcpy(bytes, head, 28);
    p = lmpi_bytes_store_u32(p, CELLS);
    for (int i = 0; i < LMP_PREINTEGRATED_LOBE_REMAP_COUNT; i++)
        p = lmpi_bytes_store_f32(p, (float)(CELLS * i) / (LMP_PREINTEGRATED_LOBE_REMAP_COUNT - 1));
    for (int k = 0; k < CELLS; k++)
        p = lmpi_bytes_store_f32(lmpi_bytes_store_f32(p, 0), 1015.42f);
    damage_sign(bytes, size);
    assert_int_equal(lmp_preintegrated_lobe_read(NULL, bytes, size, NULL, &copy), LMP_ERROR_FORMAT);
    assert_null(copy);
    free(bytes);
    free(head);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lobes_match_the_series_within_their_error),
        cmocka_unit_test(lobes_below_exponent_1_are_within_3_percent),
        cmocka_unit_test(a_smaller_error_bound_is_kept_and_a_larger_one_takes_less_memory),
        cmocka_unit_test(lobes_hold_inside_spheres_and_at_their_surface),
        cmocka_unit_test(the_mirror_diffuse_and_extreme_exponents_are_finite_everywhere),
        cmocka_unit_test(exponents_past_the_last_are_nearly_the_mirrors),
        cmocka_unit_test(slices_join_without_a_step),
        cmocka_unit_test(tasks_in_any_order_give_the_same_bytes),
        cmocka_unit_test(arguments_outside_their_range_are_refused),
        cmocka_unit_test(its_bytes_are_those_of_its_parts),
        cmocka_unit_test(steps_follow_the_width_or_nothing),
        cmocka_unit_test(a_refused_allocation_leaks_nothing),
        cmocka_unit_test(bytes_read_back_are_the_same_lobe),
        cmocka_unit_test(damaged_bytes_are_refused),
        cmocka_unit_test(every_bit_of_the_header_counts),
        cmocka_unit_test(cells_that_outgrow_their_count_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

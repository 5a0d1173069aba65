/* SPDX-License-Identifier: MIT */
/* The making of preintegrated BRDFs, and their bytes. */
#include "src/preintegrated/brdf.h"
#include "src/preintegrated/brdf_thin.h"
#include "tests/unit/damage.h"
#include "tests/unit/preintegrated_brdfs.h"

#include <stdlib.h>
#include <string.h>

/* --- making ----------------------------------------------------------------------------------- */

static lmp_brdf_table *small_table(void) {
    const lmp_brdf_table_desc desc = { .bands = 2, .views = 3, .rings_max = 32 };
    return table_of(sgd_brdf("white-fabric"), &desc);
}

static void *written(const lmp_preintegrated_brdf *preintegrated, size_t *size) {
    *size = lmp_preintegrated_brdf_size(preintegrated);
    void *bytes = malloc(*size);
    assert_non_null(bytes);
    assert_int_equal(lmp_preintegrated_brdf_write(preintegrated, *size - 1, bytes),
                     LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_preintegrated_brdf_write(preintegrated, *size, bytes), LMP_OK);
    return bytes;
}

static void tasks_in_any_order_give_the_same_bytes(void **state) {
    (void)state;
    check_hooks hooks = { .refuse = -1 };
    const lmp_host host = check_host(&hooks);
    lmp_brdf_table *table = sgd_table("nickel", 5, LMP_WINDOW_NONE);
    lmp_preintegrated_brdf *plain = created(table, 0), *other;
    assert_int_equal(lmp_preintegrated_brdf_create(&host, NULL, table, &other), LMP_OK);
    CHECK_WITHIN(fabs(hooks.done - 1), 0);
    size_t size, other_size;
    void *bytes = written(plain, &size), *other_bytes = written(other, &other_size);
    assert_int_equal(size, other_size);
    assert_memory_equal(bytes, other_bytes, size);
    assert_memory_equal(bytes, "LMPS\r\n\x1a\n\1\0\0\0\5\0\0\0", 16); /* as docs/formats.md says */
    free(bytes);
    free(other_bytes);
    lmp_preintegrated_brdf_destroy(plain);
    lmp_preintegrated_brdf_destroy(other);
    lmp_brdf_table_destroy(table);
}

static void what_cannot_be_made_is_refused(void **state) {
    (void)state;
    lmp_brdf_table *table = small_table();
    const float wrong[] = { 1e-5f, 0.5f, NAN, -1 };
    for (int i = 0; i < 4; i++) {
        lmp_preintegrated_brdf *preintegrated = (lmp_preintegrated_brdf *)1;
        assert_int_equal(
            lmp_preintegrated_brdf_create(
                NULL, &(lmp_preintegrated_brdf_desc) { .error = wrong[i] }, table, &preintegrated),
            LMP_ERROR_ARGUMENT);
        assert_null(preintegrated);
    }
    lmp_preintegrated_brdf *preintegrated;
    assert_int_equal(
        lmp_preintegrated_brdf_create(NULL, &(lmp_preintegrated_brdf_desc) { .bytes_max = 1000 },
                                      table, &preintegrated),
        LMP_ERROR_MEMORY);
    lmp_brdf_table_destroy(table);

    const lmp_ggx ggx = { 0.6f, 0.3f, { 0.9f, 0.8f, 0.6f }, { 0, 0, 0 } };
    lmp_brdf *brdf;
    assert_int_equal(lmp_brdf_create_ggx(NULL, &ggx, &brdf), LMP_OK);
    const lmp_brdf_table_desc desc = { .bands = 3, .views = 4, .azimuths = 4, .rings_max = 32 };
    table = table_of(brdf, &desc);
    assert_int_equal(lmp_preintegrated_brdf_create(NULL, NULL, table, &preintegrated),
                     LMP_ERROR_ARGUMENT);
    lmp_brdf_table_destroy(table);
}

static void a_refused_allocation_leaks_nothing(void **state) {
    (void)state;
    lmp_brdf_table *table = small_table();
    const lmp_preintegrated_brdf_desc desc = { .error = 0.1f };
    for (int refuse = 0;; refuse += check_count(1 + refuse / 8, 1)) {
        check_hooks hooks = { .refuse = refuse };
        const lmp_host host = check_host(&hooks);
        lmp_preintegrated_brdf *preintegrated;
        const lmp_result result =
            lmp_preintegrated_brdf_create(&host, &desc, table, &preintegrated);
        lmp_preintegrated_brdf_destroy(preintegrated);
        assert_int_equal(hooks.live, 0);
        if (result == LMP_OK)
            break;
        assert_int_equal(result, LMP_ERROR_MEMORY);
        assert_null(preintegrated);
    }
    lmp_brdf_table_destroy(table);
}

/* --- bytes ------------------------------------------------------------------------------------ */

static void bytes_read_back_are_the_same_brdf(void **state) {
    (void)state;
    lmp_brdf_table *table = small_table();
    lmp_preintegrated_brdf *preintegrated = created(table, 0), *copy;
    size_t size, again_size;
    void *bytes = written(preintegrated, &size);
    assert_int_equal(lmp_preintegrated_brdf_read(NULL, bytes, size, NULL, &copy), LMP_OK);
    void *again = written(copy, &again_size);
    assert_int_equal(size, again_size);
    assert_memory_equal(bytes, again, size);
    for (int i = 0; i < 200; i++) {
        const probe p = random_probe(-3, 0);
        const lmp_vec3 axis = random_direction(&p, i, 0.1);
        const lmp_rgb a = lmp_preintegrated_brdf_eval(preintegrated, (float)cos(p.theta), axis,
                                                      0.1f),
                      b = lmp_preintegrated_brdf_eval(copy, (float)cos(p.theta), axis, 0.1f);
        assert_memory_equal(&a, &b, sizeof a);
    }
    free(bytes);
    free(again);
    lmp_preintegrated_brdf_destroy(preintegrated);
    lmp_preintegrated_brdf_destroy(copy);
    lmp_brdf_table_destroy(table);
}

static lmp_result read_and_use(const unsigned char *bytes, size_t size) {
    lmp_preintegrated_brdf *copy;
    lmp_parse_error error = { size + 1, "" };
    const lmp_result result = lmp_preintegrated_brdf_read(NULL, bytes, size, &error, &copy);
    assert_true(result == LMP_OK || (error.text[0] && error.offset <= size));
    assert_int_equal(result == LMP_OK, copy != NULL);
    for (int k = 0; copy && k < 20; k++) {
        const probe p = random_probe(-3, 0);
        (void)lmp_preintegrated_brdf_eval(copy, (float)cos(p.theta), random_direction(&p, k, 0.5),
                                          (float)check_random());
        (void)lmp_preintegrated_brdf_ambient(copy, (float)cos(p.theta));
    }
    lmp_preintegrated_brdf_destroy(copy);
    return result;
}

static void damaged_bytes_are_refused(void **state) {
    (void)state;
    lmp_brdf_table *table = small_table();
    lmp_preintegrated_brdf *preintegrated = created(table, 0.1f);
    size_t size;
    unsigned char *bytes = written(preintegrated, &size);
    const size_t texels = 6 * lmp_preintegrated_brdf_describe(preintegrated).texel_count;
    lmp_preintegrated_brdf_destroy(preintegrated);
    lmp_brdf_table_destroy(table);
    damage_is_refused(bytes, size, read_and_use);
    damage_stays_in_bounds(bytes, size, 12, size - texels - 4, 2000, read_and_use);
    free(bytes);
}

/* The size agrees with the steps, but there are more of them than a reader has room for, or fewer
 * nodes than it interpolates between: the numbers at 48 … 63 are views, caps, and the steps of
 * either. */
static void counts_out_of_range_are_refused_though_the_size_agrees(void **state) {
    (void)state;
    lmp_brdf_table *table = small_table();
    lmp_preintegrated_brdf *preintegrated = created(table, 0.1f);
    const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(preintegrated);
    const uint32_t counts[4] = { info.view_count, info.cap_count, info.view_steps, info.cap_steps };
    const uint32_t wrong[4][3] = {
        { 0, 1, counts[2] + 2 }, { 0, 1, counts[3] + 2 }, { 0, 1025, 5000 }, { 0, 1025, 5000 }
    };
    size_t size;
    unsigned char *bytes = written(preintegrated, &size);
    lmp_preintegrated_brdf_destroy(preintegrated);
    lmp_brdf_table_destroy(table);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            uint32_t now[4];
            memcpy(now, counts, sizeof now);
            now[i] = wrong[i][k];
            const size_t asked = 68 + 4 * ((size_t)now[2] + 1 + now[3] + 1) + 12 * (size_t)now[0] +
                                 24 * (size_t)now[0] * now[1] + 6 * info.texel_count + 4;
            unsigned char *other = calloc(asked, 1);
            assert_non_null(other);
            memcpy(other, bytes, asked < size ? asked : size);
            for (size_t c = 0; c < 4; c++) {
                assert_int_equal(lmpi_bytes_at_u32(bytes + 48 + 4 * c), counts[c]);
                lmpi_bytes_store_u32(other + 48 + 4 * c, now[c]);
            }
            /* remaps that rise to their last slice, and all that follows */
            if (i >= 2 && now[i] > counts[i]) {
                const size_t tail = 68 + 4 * ((size_t)counts[2] + 1 + counts[3] + 1);
                memcpy(other + asked - (size - tail), bytes + tail, size - tail);
                unsigned char *p = other + 68;
                for (size_t r = 0; r < 2; r++)
                    for (uint32_t step = 0; step <= now[2 + r]; step++)
                        p = lmpi_bytes_store_f32(p, (float)step / (float)now[2 + r] *
                                                        (float)(counts[r] - 1));
            }
            damage_sign(other, asked);
            lmp_preintegrated_brdf *read;
            assert_int_equal(lmp_preintegrated_brdf_read(NULL, other, asked, NULL, &read),
                             LMP_ERROR_FORMAT);
            free(other);
        }
    free(bytes);
}

/* A file's numbers must be positive, finite, and those of slices at most 1e9. The window's size is
 * at 20, six numbers follow it, and the first slice's are behind the ambient light. */
static void numbers_out_of_range_are_refused(void **state) {
    (void)state;
    lmp_brdf_table *table = small_table();
    lmp_preintegrated_brdf *preintegrated = created(table, 0.1f);
    const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(preintegrated);
    const size_t slice =
        68 + 4 * ((size_t)info.view_steps + 1 + info.cap_steps + 1) + 12 * (size_t)info.view_count;
    const size_t offsets[] = { 20, 24, 28, 32, 36, 40, 44, slice + 8, slice + 16, slice + 20 };
    const float wrong[] = { 0, -1, NAN, INFINITY, 1.5e9f };
    size_t size;
    unsigned char *bytes = written(preintegrated, &size);
    lmp_preintegrated_brdf *read;
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++)
        for (int k = 0; k < (i ? 5 : 4); k++) {
            const float was = lmpi_bytes_at_f32(bytes + offsets[i]);
            assert_true(was > 0);
            lmpi_bytes_store_f32(bytes + offsets[i], wrong[k]);
            damage_sign(bytes, size);
            assert_int_equal(lmp_preintegrated_brdf_read(NULL, bytes, size, NULL, &read),
                             LMP_ERROR_FORMAT);
            lmpi_bytes_store_f32(bytes + offsets[i], was);
        }
    free(bytes);
    lmp_preintegrated_brdf_destroy(preintegrated);
    lmp_brdf_table_destroy(table);
}

/* Makes the smallest possible file: two views and two caps, one step of either remap between them,
 * and slices of 4 x 4 texels. `origin` is that of their rows. */
static unsigned char *least_bytes(const unsigned char *header, float origin, size_t *size) {
    const uint32_t counts[] = { 2, 2, 1, 1, 4 * 16 };
    *size = 68 + 4 * 4 + 12 * 2 + 24 * 4 + 6 * 4 * 16 + 4;
    unsigned char *bytes = calloc(*size, 1), *p = bytes + 48;
    assert_non_null(bytes);
    memcpy(bytes, header, 48);
    for (int i = 0; i < 5; i++)
        p = lmpi_bytes_store_u32(p, counts[i]);
    for (int i = 0; i < 4; i++)
        p = lmpi_bytes_store_f32(p, (float)(i % 2));
    p += 12 * 2;
    for (int i = 0; i < 4; i++) {
        p = lmpi_bytes_store_u32(lmpi_bytes_store_u32(p, 4), 4);
        p = lmpi_bytes_store_f32(lmpi_bytes_store_f32(p, 1), origin);
        p = lmpi_bytes_store_f32(lmpi_bytes_store_f32(p, 1), 1);
    }
    damage_sign(bytes, *size);
    return bytes;
}

static void the_least_and_the_farthest_are_read(void **state) {
    (void)state;
    static const float origins[] = { 0, 1e9f, -1e9f, 1.0001e9f, -1.0001e9f, NAN };
    lmp_brdf_table *table = small_table();
    lmp_preintegrated_brdf *preintegrated = created(table, 0.1f);
    size_t size;
    unsigned char *header = written(preintegrated, &size);
    for (int i = 0; i < 6; i++) {
        unsigned char *bytes = least_bytes(header, origins[i], &size);
        assert_int_equal(read_and_use(bytes, size), i < 3 ? LMP_OK : LMP_ERROR_FORMAT);
        free(bytes);
    }
    free(header);
    lmp_preintegrated_brdf_destroy(preintegrated);
    lmp_brdf_table_destroy(table);
}

static lmp_rgb at_an_end(const lmp_preintegrated_brdf *brdf, int remap, int end, int i) {
    const float part = (float)i / 19;
    const lmp_vec3 axis = { sinf(part) * cosf(0.3f), sinf(part) * sinf(0.3f), cosf(part) };
    return remap == 0 ? lmp_preintegrated_brdf_eval(brdf, end ? 0 : 1, axis, 0.02f + 0.9f * part)
                      : lmp_preintegrated_brdf_eval(brdf, 1 - part, axis, end ? 1 : 1e-12f);
}

/* The first and the last view, and cap, are those of the first and the last node, wherever the
 * nodes between lie. */
static void ends_of_a_remap_are_its_end_nodes(void **state) {
    (void)state;
    const lmp_brdf_table_desc desc = { .bands = 5, .views = 12, .rings_max = 64 };
    lmp_brdf_table *table = table_of(sgd_brdf("gold-metallic-paint"), &desc);
    lmp_preintegrated_brdf *preintegrated = created(table, 0.02f), *other;
    const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(preintegrated);
    const uint32_t steps[2] = { info.view_steps, info.cap_steps };
    size_t size;
    for (int remap = 0; remap < 2; remap++) {
        unsigned char *bytes = written(preintegrated, &size);
        unsigned char *node = bytes + 68 + (remap ? 4 * ((size_t)steps[0] + 1) : 0);
        assert_true(steps[remap] > 2);
        for (uint32_t i = 1; i < steps[remap]; i++) { /* nearer to the node before, in turn */
            const float before = lmpi_bytes_at_f32(node + 4 * (size_t)(i - 1));
            const float here = lmpi_bytes_at_f32(node + 4 * (size_t)i);
            lmpi_bytes_store_f32(node + 4 * (size_t)i,
                                 before + (i % 2 ? 0.4f : 0.8f) * (here - before));
        }
        damage_sign(bytes, size);
        assert_int_equal(lmp_preintegrated_brdf_read(NULL, bytes, size, NULL, &other), LMP_OK);
        for (int end = 0; end < 2; end++)
            for (int i = 0; i < 20; i++) {
                const lmp_rgb a = at_an_end(preintegrated, remap, end, i),
                              b = at_an_end(other, remap, end, i);
                for (int c = 0; c < 3; c++)
                    CHECK_WITHIN(fabsf((&a.r)[c] - (&b.r)[c]), 1e-4F * fabsf((&a.r)[c]) + 1e-7F);
            }
        lmp_preintegrated_brdf_destroy(other);
        free(bytes);
    }
    lmp_preintegrated_brdf_destroy(preintegrated);
    lmp_brdf_table_destroy(table);
}

/* Slowly varying rows are kept by every other one: a cubic spline through a cosine of step h errs
 * by about h⁴/384 of it; one of fewer than two rows per wave is lost. */
static void smooth_rows_are_thinned_and_rough_ones_are_not(void **state) {
    (void)state;
    enum { ROWS = 129, COLUMNS = 5 };
    static float values[3 * ROWS * COLUMNS], coefficients[ROWS * COLUMNS];
    const brdf_grid grid = {
        .values = values, .rows = ROWS, .columns = COLUMNS, .coefficients = coefficients
    };
    for (double frequency = 0.08; frequency < 0.5; frequency *= 1.3) {
        for (int c = 0; c < 3; c++)
            for (int i = 0; i < ROWS; i++)
                for (int k = 0; k < COLUMNS; k++)
                    values[(c * ROWS + i) * COLUMNS + k] =
                        (float)((k + 1) * cos(frequency * i + 0.7 * k + c));
        const double error = COLUMNS * pow(2 * frequency, 4) / 384;
        assert_true(lmpi_preintegrated_brdf_rows_hold(&grid, 2, (float)(1.4 * error + 5e-6)));
        assert_false(lmpi_preintegrated_brdf_rows_hold(&grid, 2, (float)(0.8 * error)));
        values[(2 * ROWS + 63) * COLUMNS + 3] += 1; /* one row of one color counts */
        assert_false(lmpi_preintegrated_brdf_rows_hold(&grid, 2, 0.9f));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tasks_in_any_order_give_the_same_bytes),
        cmocka_unit_test(what_cannot_be_made_is_refused),
        cmocka_unit_test(a_refused_allocation_leaks_nothing),
        cmocka_unit_test(bytes_read_back_are_the_same_brdf),
        cmocka_unit_test(damaged_bytes_are_refused),
        cmocka_unit_test(numbers_out_of_range_are_refused),
        cmocka_unit_test(the_least_and_the_farthest_are_read),
        cmocka_unit_test(counts_out_of_range_are_refused_though_the_size_agrees),
        cmocka_unit_test(ends_of_a_remap_are_its_end_nodes),
        cmocka_unit_test(smooth_rows_are_thinned_and_rough_ones_are_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

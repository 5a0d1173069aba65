/* SPDX-License-Identifier: MIT */
/* Every function that takes long treats its host alike: it can be cancelled at any question, its
 * progress ends at 1, and in any case it releases what it allocated. */
#include "tests/oracle/check.h"

#include <lampion/lampion.h>

#include <math.h>
#include <string.h>

/* --- the functions ---------------------------------------------------------------------------- */

/* Makes something by a function that takes long, and frees it; on failure the result must be NULL.
 */
typedef lmp_result (*attempt)(const lmp_host *host);

static lmp_brdf *lambert(void) {
    lmp_brdf *brdf;
    assert_int_equal(lmp_brdf_create_lambert(NULL, (lmp_rgb) { 1, 1, 1 }, &brdf), LMP_OK);
    return brdf;
}

static lmp_result make_table(const lmp_host *host) {
    const lmp_brdf_table_desc desc = { .bands = 3, .views = 4, .rings_max = 32 };
    lmp_brdf *brdf = lambert();
    lmp_brdf_table *table;
    const lmp_result result = lmp_brdf_table_create(host, &desc, brdf, &table);
    assert_int_equal(!table, result != LMP_OK);
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
    return result;
}

static lmp_result make_preintegrated_lobe(const lmp_host *host) {
    const lmp_preintegrated_lobe_desc desc = { .bands = 2, .error = 0.1f };
    lmp_preintegrated_lobe *lobe;
    const lmp_result result = lmp_preintegrated_lobe_create(host, &desc, &lobe);
    assert_int_equal(!lobe, result != LMP_OK);
    lmp_preintegrated_lobe_destroy(lobe);
    return result;
}

static lmp_result make_preintegrated_brdf(const lmp_host *host) {
    const lmp_brdf_table_desc table_desc = { .bands = 2, .views = 3, .rings_max = 32 };
    const lmp_preintegrated_brdf_desc desc = { .error = 0.1f };
    lmp_brdf *brdf = lambert();
    lmp_brdf_table *table;
    assert_int_equal(lmp_brdf_table_create(NULL, &table_desc, brdf, &table), LMP_OK);
    lmp_preintegrated_brdf *made;
    const lmp_result result = lmp_preintegrated_brdf_create(host, &desc, table, &made);
    assert_int_equal(!made, result != LMP_OK);
    lmp_preintegrated_brdf_destroy(made);
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
    return result;
}

static lmp_result write_by(lmp_result (*write)(const lmp_host *, const lmp_brdf *, void **,
                                               size_t *),
                           const lmp_host *host) {
    lmp_brdf *brdf = lambert();
    void *data;
    size_t size;
    const lmp_result result = write(host, brdf, &data, &size);
    assert_int_equal(!data, result != LMP_OK);
    assert_int_equal(!size, result != LMP_OK);
    host->release(data, host->user);
    lmp_brdf_destroy(brdf);
    return result;
}

static lmp_result write_merl(const lmp_host *host) {
    return write_by(lmp_brdf_encode_merl, host);
}

static lmp_result write_rgl(const lmp_host *host) {
    return write_by(lmp_brdf_encode_rgl, host);
}

static lmp_result fit_samples(const lmp_host *host) {
    enum { COUNT = 200 };
    lmp_vec3 directions[COUNT];
    float values[COUNT], sh[4];
    for (int i = 0; i < COUNT; i++) {
        directions[i] = check_random_direction();
        values[i] = 1 + directions[i].x;
    }
    const lmp_probe_samples samples = { .directions = lmp_vec3_array_of(directions),
                                        .values = { values, sizeof *values },
                                        .count = COUNT };
    return lmp_probe_fit(host, 2, 0, &samples, sh);
}

static lmp_result make_transfer(const lmp_host *host) {
    enum { COUNT = 600 };
    static lmp_transfer_surfel surfels[COUNT];
    static uint32_t hits[COUNT];
    for (int i = 0; i < COUNT; i++)
        surfels[i] = (lmp_transfer_surfel) { .normal = { 0, 1, 0 }, .radius = 1 };
    const lmp_transfer_desc desc = {
        .surfels = surfels, .surfel_count = COUNT, .hits = hits, .ray_count = 1
    };
    const lmp_transfer_lighting dark = { 0 };
    lmp_transfer *transfer;
    lmp_result result = lmp_transfer_create(host, &desc, &transfer);
    assert_int_equal(!transfer, result != LMP_OK);
    if (result == LMP_OK)
        result = lmp_transfer_update(host, transfer, NULL, &dark);
    lmp_transfer_destroy(transfer);
    return result;
}

static const struct {
    const char *name;
    attempt make;
    int stride; /* between the questions tried */
} attempts[] = {
    { "lmp_brdf_table_create", make_table, 1 },
    { "lmp_preintegrated_lobe_create", make_preintegrated_lobe, 1 },
    { "lmp_preintegrated_brdf_create", make_preintegrated_brdf, 7 },
    { "lmp_brdf_encode_merl", write_merl, 40 },
    { "lmp_brdf_encode_rgl", write_rgl, 40 },
    { "lmp_probe_fit", fit_samples, 1 },
    { "lmp_transfer_update", make_transfer, 1 },
};
enum { ATTEMPTS = sizeof attempts / sizeof *attempts };

/* --- the tests -------------------------------------------------------------------------------- */

static void cancelling_at_any_question_leaves_nothing_behind(void **state) {
    (void)state;
    for (int i = 0; i < ATTEMPTS; i++) {
        int cancelled = 0;
        for (int question = 1;; question += check_count(attempts[i].stride, 1)) {
            check_hooks hooks = { .refuse = -1, .cancel = question };
            const lmp_host host = check_host(&hooks);
            const lmp_result result = attempts[i].make(&host);
            if (hooks.live != 0)
                fail_msg("%s: %d allocations left at question %d", attempts[i].name, hooks.live,
                         question);
            if (result == LMP_OK) {
                assert_true(hooks.questions < question);
                break;
            }
            assert_int_equal(result, LMP_ERROR_CANCELLED);
            /* nothing is begun after that, so nothing asks again */
            assert_int_equal(hooks.questions, question);
            cancelled++;
        }
        assert_true(cancelled > 1);
    }
}

static void progress_rises_to_one(void **state) {
    (void)state;
    for (int i = 0; i < ATTEMPTS; i++) {
        check_hooks hooks = { .refuse = -1 };
        const lmp_host host = check_host(&hooks);
        assert_int_equal(attempts[i].make(&host), LMP_OK);
        CHECK_WITHIN(fabs(hooks.done - 1), 0);
    }
}

static void a_host_may_set_one_hook_alone(void **state) {
    (void)state;
    check_hooks hooks = { .refuse = -1 };
    const lmp_host all = check_host(&hooks);
    const lmp_host hosts[] = {
        { 0 },
        { .allocate = all.allocate, .release = all.release, .user = &hooks },
        { .parallel = all.parallel, .user = &hooks },
        { .progress = all.progress, .user = &hooks },
        { .cancelled = all.cancelled, .user = &hooks },
    };
    for (size_t i = 0; i < sizeof hosts / sizeof *hosts; i++) {
        memset(&hooks, 0, sizeof hooks);
        hooks.refuse = -1;
        assert_int_equal(make_table(&hosts[i]), LMP_OK);
        assert_int_equal(hooks.requests > 0, i == 1);
        assert_int_equal(hooks.tasks > 0, i == 2);
        assert_int_equal(hooks.done > 0, i == 3);
        assert_int_equal(hooks.questions > 0, i == 4);
        assert_int_equal(hooks.live, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cancelling_at_any_question_leaves_nothing_behind),
        cmocka_unit_test(progress_rises_to_one),
        cmocka_unit_test(a_host_may_set_one_hook_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

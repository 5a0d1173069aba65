/* SPDX-License-Identifier: MIT */
/* Transfers that cannot be made, and light that is no light. */
#include "tests/unit/transfers.h"

#include <math.h>

static void is_refused(const lmp_transfer_desc *desc) {
    check_hooks hooks = { .refuse = -1 };
    const lmp_host host = check_host(&hooks);
    lmp_transfer *transfer = (lmp_transfer *)&hooks;
    assert_int_equal(lmp_transfer_create(&host, desc, &transfer), LMP_ERROR_ARGUMENT);
    assert_null(transfer);
    assert_int_equal(hooks.requests, 0);
}

static void descs_out_of_range_are_refused(void **test) {
    static transfer_lists l;
    (void)test;
    transfer_draw(SURFELS, 1, &l);
    const lmp_transfer_desc good = transfer_desc_of(&l, SURFELS);
    is_refused(NULL);
#define REFUSED(member, value)                                                                     \
    do {                                                                                           \
        lmp_transfer_desc desc = good;                                                             \
        desc.member = value;                                                                       \
        is_refused(&desc);                                                                         \
    } while (0)
    REFUSED(surfels, NULL);
    REFUSED(surfel_count, 0);
    REFUSED(surfel_count, LMP_TRANSFER_SOURCES_MAX + 1);
    REFUSED(sky_count, LMP_TRANSFER_SOURCES_MAX - SURFELS + 1);
    REFUSED(sky_count, SIZE_MAX);
    REFUSED(hits, NULL);
    REFUSED(ray_count, 0);
    REFUSED(ray_count, LMP_TRANSFER_RAYS_MAX + 1);
    REFUSED(links, NULL);
    REFUSED(link_count, LMP_TRANSFER_LINKS_MAX + 1);
    REFUSED(probe_hits, NULL);
    REFUSED(probe_directions, NULL);
    REFUSED(probe_count, LMP_TRANSFER_PROBES_MAX + 1);
    REFUSED(probe_ray_count, 0);
    REFUSED(probe_ray_count, LMP_TRANSFER_RAYS_MAX + 1);
    REFUSED(bands, -1);
    REFUSED(bands, LMP_TRANSFER_BANDS_MAX + 1);
#undef REFUSED
}

static void damaged_arrays_are_refused(void **test) {
    static transfer_lists good, bad;
    (void)test;
    transfer_draw(SURFELS, 1, &good);
    bad = good;
    const lmp_transfer_desc desc = transfer_desc_of(&bad, SURFELS);
#define REFUSED(element, value)                                                                    \
    do {                                                                                           \
        bad.element = value;                                                                       \
        is_refused(&desc);                                                                         \
        bad = good;                                                                                \
    } while (0)
    REFUSED(hits[0], SURFELS + SKY);
    REFUSED(hits[SURFELS * RAYS - 1], LMP_TRANSFER_NONE - 1);
    REFUSED(links[SURFELS * LINKS - 1], SURFELS);
    REFUSED(probe_hits[PROBES * PROBE_RAYS - 1], SURFELS + SKY);
    REFUSED(directions[PROBE_RAYS - 1].x, NAN);
    REFUSED(directions[0].y, 2);
    REFUSED(surfels[SURFELS - 1].position.z, INFINITY);
    REFUSED(surfels[3].normal.x, NAN);
    REFUSED(surfels[3].normal.x, -3);
    REFUSED(surfels[4].albedo.r, -0.01f);
    REFUSED(surfels[4].albedo.g, 1.01f);
    REFUSED(surfels[4].albedo.b, NAN);
    REFUSED(surfels[5].radius, 0);
    REFUSED(surfels[5].radius, NAN);
    REFUSED(surfels[5].radius, INFINITY);
#undef REFUSED
    lmp_transfer_destroy(transfer_make(&desc));
}

static void no_memory_is_an_error(void **test) {
    static transfer_lists l;
    check_hooks hooks = { .refuse = 0 };
    const lmp_host host = check_host(&hooks);
    (void)test;
    transfer_draw(SURFELS, 1, &l);
    const lmp_transfer_desc desc = transfer_desc_of(&l, SURFELS);
    lmp_transfer *transfer = (lmp_transfer *)&hooks;
    assert_int_equal(lmp_transfer_create(&host, &desc, &transfer), LMP_ERROR_MEMORY);
    assert_null(transfer);
    assert_int_equal(lmp_transfer_create(&host, &desc, &transfer), LMP_OK);
    assert_int_equal(hooks.requests, 2);
    assert_true(lmp_transfer_describe(transfer).bytes > sizeof l / 2);
    lmp_transfer_destroy(transfer);
    assert_int_equal(hooks.live, 0);
    lmp_transfer_destroy(NULL);
}

/* Light and settings out of range are refused and leave the transfer as it was. */
static void light_that_is_no_number_is_refused(void **test) {
    static transfer_lists l;
    lmp_rgb before[SURFELS], after[SURFELS];
    (void)test;
    transfer_draw(SURFELS, 1, &l);
    const lmp_transfer_desc desc = transfer_desc_of(&l, SURFELS);
    const lmp_transfer_lighting lighting = transfer_lighting_of(&l);
    lmp_transfer *transfer = transfer_make(&desc);
    transfer_iterate(transfer, 3, &lighting);
    transfer_copy(transfer, SURFELS, before);
    float *const values[] = { &l.direct[SURFELS - 1].b, &l.emission[SURFELS - 1].g,
                              &l.sky[SKY - 1].r };
    const float bad[] = { NAN, INFINITY, -INFINITY, 1.1e28f, -1.1e28f };
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 5; k++) {
            const float was = *values[i];
            *values[i] = bad[k];
            assert_int_equal(lmp_transfer_update(NULL, transfer, NULL, &lighting),
                             LMP_ERROR_ARGUMENT);
            *values[i] = was;
        }
    const lmp_transfer_settings settings[] = { { .iterations = -1 },
                                               { .iterations = LMP_TRANSFER_ITERATIONS_MAX + 1 },
                                               { .remainder = -0.1f },
                                               { .remainder = 1.1f },
                                               { .remainder = NAN } };
    for (int i = 0; i < 5; i++)
        assert_int_equal(lmp_transfer_update(NULL, transfer, &settings[i], &lighting),
                         LMP_ERROR_ARGUMENT);
    transfer_copy(transfer, SURFELS, after);
    assert_memory_equal(before, after, sizeof before);
    /* truncated series may ring below 0 */
    l.direct[0].r = -1e28f;
    transfer_iterate(transfer, 100, &lighting);
    transfer_copy(transfer, SURFELS, after);
    for (size_t i = 0; i < SURFELS; i++)
        assert_true(isfinite(after[i].r) && isfinite(after[i].g) && isfinite(after[i].b));
    lmp_transfer_destroy(transfer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(descs_out_of_range_are_refused),
        cmocka_unit_test(damaged_arrays_are_refused),
        cmocka_unit_test(no_memory_is_an_error),
        cmocka_unit_test(light_that_is_no_number_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

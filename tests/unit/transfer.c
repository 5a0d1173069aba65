/* SPDX-License-Identifier: MIT */
/* Transfers of lists drawn at random, against closed forms and systems of equations in double; and
 * what must not change the bits. */
#include "tests/oracle/oracle.h"
#include "tests/unit/transfers.h"

#include <math.h>
#include <string.h>

/* --- closed forms ----------------------------------------------------------------------------- */

/* Returns the largest error of the indirect irradiance of surfels first … end - 1. */
static double error_from(const lmp_transfer *transfer, size_t first, size_t end, double expected) {
    double worst = 0;
    for (size_t i = first; i < end; i++) {
        lmp_rgb e;
        lmp_transfer_copy_irradiance_n(transfer, i, 1, lmp_rgb_array_of(&e));
        const double error = fmax(fmax(fabs((double)e.r - expected), fabs((double)e.g - expected)),
                                  fabs((double)e.b - expected));
        worst = error <= worst ? worst : error;
    }
    return worst / expected;
}

/* Draws transfer_lists that hit surfels alone: those from `first` to `end`. */
static void draw_hits(transfer_lists *l, size_t from, size_t to, size_t first, size_t end) {
    for (size_t i = from * RAYS; i < to * RAYS; i++)
        l->hits[i] = (uint32_t)first + transfer_random_index(end - first);
}

static void set_surfels(transfer_lists *l, size_t from, size_t to, float albedo, float direct) {
    for (size_t i = from; i < to; i++) {
        l->surfels[i].albedo = (lmp_rgb) { albedo, albedo, albedo };
        l->direct[i] = (lmp_rgb) { direct, direct, direct };
    }
}

/* Light that falls in is reflected again and again: rho + rho² + … = rho / (1 - rho) times it. */
static void a_closed_room_of_one_albedo_keeps_the_geometric_series(void **test) {
    static transfer_lists l;
    const float albedos[] = { 0.2f, 0.5f, 0.8f };
    (void)test;
    for (int i = 0; i < 3; i++) {
        const double rho = (double)albedos[i], direct = 3;
        transfer_draw(SURFELS, 1, &l);
        draw_hits(&l, 0, SURFELS, 0, SURFELS);
        set_surfels(&l, 0, SURFELS, albedos[i], (float)direct);
        const lmp_transfer_desc desc = transfer_desc_of(&l, SURFELS);
        const lmp_transfer_lighting lighting = { .direct = l.direct };
        lmp_transfer *transfer = transfer_make(&desc);
        transfer_iterate(transfer, 3, &lighting);
        const double three = direct * rho * (1 - pow(rho, 3)) / (1 - rho);
        CHECK_WITHIN(error_from(transfer, 0, SURFELS, three), 1e-6);
        /* where nothing is lost, the bound of the remainder is the remainder itself */
        const double remainder = (double)lmp_transfer_describe(transfer).remainder;
        CHECK_WITHIN(fabs(remainder * (1 - pow(rho, 3)) / pow(rho, 3) - 1), 1e-5);
        transfer_iterate(transfer, 100, &lighting);
        CHECK_WITHIN(error_from(transfer, 0, SURFELS, direct * rho / (1 - rho)), 2e-6);
        lmp_transfer_destroy(transfer);
    }
}

/* The smallest of transfers: one surfel, whose rays all hit it. */
static void a_single_surfel_lights_itself(void **test) {
    static transfer_lists l;
    (void)test;
    transfer_draw(1, 1, &l);
    draw_hits(&l, 0, 1, 0, 1);
    set_surfels(&l, 0, 1, 0.5f, 3);
    lmp_transfer_desc desc = transfer_desc_of(&l, 1);
    desc.link_count = desc.sky_count = desc.probe_count = 0;
    const lmp_transfer_lighting lighting = { .direct = l.direct };
    lmp_transfer *transfer = transfer_make(&desc);
    transfer_iterate(transfer, 40, &lighting);
    CHECK_WITHIN(error_from(transfer, 0, 1, 3), 1e-6);
    lmp_transfer_destroy(transfer);
}

/* A range of none may begin behind the last surfel or probe; nothing is written. */
static void an_empty_range_may_begin_behind_the_last(void **test) {
    static transfer_lists l;
    lmp_rgb rgb = { 1, 2, 3 };
    (void)test;
    transfer_draw(SURFELS, 1, &l);
    const lmp_transfer_desc desc = transfer_desc_of(&l, SURFELS);
    lmp_transfer *transfer = transfer_make(&desc);
    lmp_transfer_copy_irradiance_n(transfer, SURFELS, 0, lmp_rgb_array_of(&rgb));
    lmp_transfer_eval_probe_n(transfer, PROBES, 0, (lmp_sh_array) { .at = &rgb.r });
    assert_true(rgb.r == 1 && rgb.g == 2 && rgb.b == 3);
    lmp_transfer_destroy(transfer);
}

/* Two infinite plates see nothing but each other: E_a = b (F_b + E_b), E_b = a (F_a + E_a). */
static void two_plates_reflect_each_other(void **test) {
    static transfer_lists l;
    const double a = 0.75, b = 0.5, direct_a = 2, direct_b = 0.25;
    const size_t half = SURFELS / 2;
    (void)test;
    transfer_draw(SURFELS, 1, &l);
    draw_hits(&l, 0, half, half, SURFELS);
    draw_hits(&l, half, SURFELS, 0, half);
    set_surfels(&l, 0, half, (float)a, (float)direct_a);
    set_surfels(&l, half, SURFELS, (float)b, (float)direct_b);
    const lmp_transfer_desc desc = transfer_desc_of(&l, SURFELS);
    const lmp_transfer_lighting lighting = { .direct = l.direct };
    lmp_transfer *transfer = transfer_make(&desc);
    transfer_iterate(transfer, 60, &lighting);
    CHECK_WITHIN(error_from(transfer, 0, half, b * (direct_b + a * direct_a) / (1 - a * b)), 1e-6);
    CHECK_WITHIN(error_from(transfer, half, SURFELS, a * (direct_a + b * direct_b) / (1 - a * b)),
                 1e-6);
    lmp_transfer_destroy(transfer);
}

/* --- the linear system ------------------------------------------------------------------------ */

enum { FEW = 50 };

static double channel_of(lmp_rgb color, int channel) {
    return (double)(channel == 0 ? color.r : channel == 1 ? color.g : color.b);
}

/* Solves the n equations matrix x = right by Gaussian elimination; x replaces right. */
static void solve(int n, double matrix[FEW][FEW], double *right) {
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            const double factor = matrix[k][i] / matrix[i][i];
            for (int j = i; k != i && j < n; j++)
                matrix[k][j] -= factor * matrix[i][j];
            right[k] -= k != i ? factor * right[i] : 0;
        }
    for (int i = 0; i < n; i++)
        right[i] /= matrix[i][i];
}

/* Computes E of one channel from the equations of transfer.h. */
static void solve_irradiance(const transfer_lists *l, int channel, double *e) {
    const double pi = 3.14159265358979323846;
    double matrix[FEW][FEW] = { { 0 } };
    for (int i = 0; i < FEW; i++) {
        e[i] = 0;
        matrix[i][i] = 1;
        for (int k = 0; k < RAYS; k++) {
            const uint32_t s = l->hits[i * RAYS + k];
            if (s < FEW) {
                const double albedo = channel_of(l->surfels[s].albedo, channel);
                matrix[i][s] -= albedo / RAYS;
                e[i] += (albedo * channel_of(l->direct[s], channel) +
                         pi * channel_of(l->emission[s], channel)) /
                        RAYS;
            } else if (s != LMP_TRANSFER_NONE) {
                e[i] += pi * channel_of(l->sky[s - FEW], channel) / RAYS;
            }
        }
    }
    solve(FEW, matrix, e);
}

static double error_of(const transfer_lists *l, const lmp_rgb *rgb, double *largest) {
    double worst = 0;
    *largest = 0;
    for (int channel = 0; channel < 3; channel++) {
        double expected[FEW];
        solve_irradiance(l, channel, expected);
        for (int i = 0; i < FEW; i++) {
            const double error = fabs(channel_of(rgb[i], channel) - expected[i]);
            worst = error <= worst ? worst : error;
            *largest = fmax(*largest, expected[i]);
        }
    }
    return worst;
}

static void iterations_solve_the_radiosity_equation(void **test) {
    static transfer_lists l;
    lmp_rgb rgb[FEW];
    double largest;
    (void)test;
    transfer_draw(FEW, 1, &l);
    const lmp_transfer_desc desc = transfer_desc_of(&l, FEW);
    const lmp_transfer_lighting lighting = transfer_lighting_of(&l);
    lmp_transfer *transfer = transfer_make(&desc);
    transfer_iterate(transfer, 60, &lighting);
    transfer_copy(transfer, FEW, rgb);
    CHECK_WITHIN(error_of(&l, rgb, &largest) / largest, 1e-6);
    lmp_transfer_destroy(transfer);
}

static void the_remainder_bounds_the_error_and_stops(void **test) {
    static transfer_lists l;
    (void)test;
    for (int round = 0; round < 20; round++) {
        lmp_rgb rgb[FEW];
        double largest;
        const lmp_transfer_settings settings = { .iterations = 100,
                                                 .remainder = 0.3f / (float)(1 + round * round) };
        transfer_draw(FEW, 1, &l);
        const lmp_transfer_desc desc = transfer_desc_of(&l, FEW);
        const lmp_transfer_lighting lighting = transfer_lighting_of(&l);
        lmp_transfer *transfer = transfer_make(&desc);
        assert_true(isinf(lmp_transfer_describe(transfer).remainder));
        assert_int_equal(lmp_transfer_update(NULL, transfer, &settings, &lighting), LMP_OK);
        const lmp_transfer_info info = lmp_transfer_describe(transfer);
        assert_true(info.iterations > 1 && info.iterations < 40);
        assert_true(info.remainder <= settings.remainder);
        transfer_copy(transfer, FEW, rgb);
        const double error = error_of(&l, rgb, &largest);
        CHECK_WITHIN(error, (double)info.remainder * largest + 1e-6 * largest);
        /* the iteration before was not yet good enough */
        lmp_transfer *shorter = transfer_make(&desc);
        transfer_iterate(shorter, info.iterations - 1, &lighting);
        assert_true(lmp_transfer_describe(shorter).remainder > settings.remainder);
        lmp_transfer_destroy(shorter);
        lmp_transfer_destroy(transfer);
    }
}

/* A room that reflects all light has no limit, and says so. */
static void a_white_room_has_no_limit(void **test) {
    static transfer_lists l;
    (void)test;
    transfer_draw(FEW, 1, &l);
    draw_hits(&l, 0, FEW, 0, FEW);
    set_surfels(&l, 0, FEW, 1, 1);
    const lmp_transfer_desc desc = transfer_desc_of(&l, FEW);
    const lmp_transfer_lighting lighting = { .direct = l.direct };
    lmp_transfer *transfer = transfer_make(&desc);
    transfer_iterate(transfer, 10, &lighting);
    assert_true(isinf(lmp_transfer_describe(transfer).remainder));
    CHECK_WITHIN(error_from(transfer, 0, FEW, 10), 1e-6);
    lmp_transfer_destroy(transfer);
}

/* --- from frame to frame ---------------------------------------------------------------------- */

static void updates_continue_where_the_last_one_ended(void **test) {
    static transfer_lists l;
    lmp_rgb once[SURFELS], twice[SURFELS];
    (void)test;
    transfer_draw(SURFELS, 1, &l);
    const lmp_transfer_desc desc = transfer_desc_of(&l, SURFELS);
    const lmp_transfer_lighting lighting = transfer_lighting_of(&l);
    lmp_transfer *transfer = transfer_make(&desc);
    transfer_iterate(transfer, 7, &lighting);
    transfer_copy(transfer, SURFELS, once);
    lmp_transfer_destroy(transfer);
    transfer = transfer_make(&desc);
    transfer_iterate(transfer, 3, &lighting);
    transfer_iterate(transfer, 4, &lighting);
    transfer_copy(transfer, SURFELS, twice);
    assert_memory_equal(once, twice, sizeof once);
    lmp_transfer_reset(transfer);
    transfer_copy(transfer, SURFELS, twice);
    for (size_t i = 0; i < SURFELS; i++)
        assert_true(twice[i].r == 0 && twice[i].g == 0 && twice[i].b == 0);
    assert_int_equal(lmp_transfer_describe(transfer).iterations, 0);
    assert_true(isinf(lmp_transfer_describe(transfer).remainder));
    transfer_iterate(transfer, 7, &lighting);
    transfer_copy(transfer, SURFELS, twice);
    assert_memory_equal(once, twice, sizeof once);
    lmp_transfer_destroy(transfer);
}

/* Whether surfel i is computed by an transfer_iterate of `budget` surfels that began at `first`. */
static bool is_due(size_t i, size_t first, size_t budget) {
    return (i + SURFELS - first) % SURFELS < budget;
}

static void a_budget_takes_the_next_surfels(void **test) {
    static transfer_lists l;
    enum { BUDGET = 250 };
    lmp_rgb before[SURFELS], after[SURFELS];
    const lmp_transfer_settings settings[2] = {
        { .iterations = 1, .budget = BUDGET, .remainder = 1 },
        { .iterations = 2, .budget = BUDGET / 2 },
    };
    (void)test;
    transfer_draw(SURFELS, 0.9, &l);
    const lmp_transfer_desc desc = transfer_desc_of(&l, SURFELS);
    const lmp_transfer_lighting lighting = transfer_lighting_of(&l);
    lmp_transfer *transfer = transfer_make(&desc);
    transfer_copy(transfer, SURFELS, before);
    for (size_t n = 0; n < 5; n++) {
        assert_int_equal(lmp_transfer_update(NULL, transfer, &settings[n % 2], &lighting), LMP_OK);
        transfer_copy(transfer, SURFELS, after);
        for (size_t i = 0; i < SURFELS; i++)
            assert_int_equal(memcmp(&before[i], &after[i], sizeof *before) != 0,
                             is_due(i, n * BUDGET % SURFELS, BUDGET));
        memcpy(before, after, sizeof before);
        assert_true(isinf(lmp_transfer_describe(transfer).remainder));
    }
    for (int n = 0; n < 200; n++)
        assert_int_equal(lmp_transfer_update(NULL, transfer, &settings[0], &lighting), LMP_OK);
    transfer_copy(transfer, SURFELS, after);
    lmp_transfer *whole = transfer_make(&desc);
    transfer_iterate(whole, 100, &lighting);
    transfer_copy(whole, SURFELS, before);
    for (size_t i = 0; i < SURFELS; i++)
        CHECK_WITHIN(fabs(channel_of(after[i], 1) - channel_of(before[i], 1)), 1e-5);
    lmp_transfer_destroy(whole);
    lmp_transfer_destroy(transfer);
}

/* Without light, E falls to 0 itself and not to subnormal numbers, which would be slow: where
 * surfels reflect more than half, rounding keeps the smallest of them forever. */
static void darkness_is_reached(void **test) {
    static transfer_lists l;
    lmp_rgb rgb[SURFELS];
    const lmp_rgb none[SURFELS] = { { 0, 0, 0 } };
    (void)test;
    transfer_draw(SURFELS, 1, &l);
    draw_hits(&l, 0, SURFELS, 0, SURFELS);
    set_surfels(&l, 0, SURFELS, 0.9f, 3);
    const lmp_transfer_desc desc = transfer_desc_of(&l, SURFELS);
    const lmp_transfer_lighting lighting = transfer_lighting_of(&l), dark = { 0 };
    lmp_transfer *transfer = transfer_make(&desc);
    transfer_iterate(transfer, 10, &lighting);
    transfer_iterate(transfer, 900, &dark);
    transfer_copy(transfer, SURFELS, rgb);
    assert_memory_equal(rgb, none, sizeof rgb);
    CHECK_WITHIN((double)lmp_transfer_describe(transfer).remainder, 0);
    lmp_transfer_destroy(transfer);
}

/* --- probes ----------------------------------------------------------------------------------- */

/* Sums what a probe's rays hit, in double: c_lm = 4 pi / K Σ L Y_lm. */
static void sum_probe(const transfer_lists *l, int bands, const lmp_rgb *indirect, int probe,
                      double *sums) {
    const double pi = 3.14159265358979323846;
    const int n = bands * bands;
    for (int i = 0; i < 3 * n; i++)
        sums[i] = 0;
    for (int k = 0; k < PROBE_RAYS; k++) {
        const uint32_t s = l->probe_hits[probe * PROBE_RAYS + k];
        const lmp_vec3 w = l->directions[k];
        double y[LMP_TRANSFER_BANDS_MAX * LMP_TRANSFER_BANDS_MAX];
        oracle_sh_eval(bands, (double[]) { (double)w.x, (double)w.y, (double)w.z }, y);
        for (int c = 0; c < 3 && s != LMP_TRANSFER_NONE; c++) {
            const double radiance =
                s < SURFELS ? channel_of(l->surfels[s].albedo, c) / pi *
                                      (channel_of(l->direct[s], c) + channel_of(indirect[s], c)) +
                                  channel_of(l->emission[s], c)
                            : channel_of(l->sky[s - SURFELS], c);
            for (int i = 0; i < n; i++)
                sums[c * n + i] += 4 * pi / PROBE_RAYS * radiance * y[i];
        }
    }
}

static void probes_hold_what_their_rays_hit(void **test) {
    static transfer_lists l;
    lmp_rgb indirect[SURFELS];
    enum { VALUES = 3 * LMP_TRANSFER_BANDS_MAX * LMP_TRANSFER_BANDS_MAX, STRIDE = VALUES + 5 };
    (void)test;
    transfer_draw(SURFELS, 1, &l);
    for (int bands = 1; bands <= LMP_TRANSFER_BANDS_MAX; bands++) {
        const size_t values = 3 * LMP_SH_COUNT(bands);
        lmp_transfer_desc desc = transfer_desc_of(&l, SURFELS);
        desc.bands = bands;
        const lmp_transfer_lighting lighting = transfer_lighting_of(&l);
        lmp_transfer *transfer = transfer_make(&desc);
        float rows[PROBES * STRIDE], planes[VALUES * PROBES], one[VALUES];
        transfer_iterate(transfer, 5, &lighting);
        transfer_copy(transfer, SURFELS, indirect);
        lmp_transfer_eval_probe_n(transfer, 0, PROBES,
                                  lmp_sh_interleaved(rows, STRIDE * sizeof(float)));
        lmp_transfer_eval_probe_n(transfer, 0, PROBES, lmp_sh_planar(planes, 0));
        for (int p = 0; p < PROBES; p++) {
            double expected[VALUES];
            sum_probe(&l, bands, indirect, p, expected);
            CHECK_WITHIN(check_error(values, expected, rows + p * STRIDE), 2e-6);
            lmp_transfer_eval_probe_n(transfer, (size_t)p, 1, lmp_sh_interleaved(one, 0));
            assert_memory_equal(one, rows + p * STRIDE, values * sizeof(float));
            for (size_t v = 0; v < values; v++)
                assert_true(planes[v * PROBES + (size_t)p] == one[v]);
        }
        lmp_transfer_destroy(transfer);
    }
}

/* --- the same bits ---------------------------------------------------------------------------- */

/* Hashes floats, by FNV-1a of their bits as whole numbers. */
static uint64_t hash_of(const float *floats, size_t count) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &floats[i], sizeof bits);
        hash = (hash ^ bits) * 0x100000001b3u;
    }
    return hash;
}

/* Draws transfer_lists by whole numbers alone, so that every machine draws the same bits. */
static void draw_equal_lists(transfer_lists *l) {
    check_seed(7);
    transfer_draw(SURFELS, 1, l);
    for (size_t i = 0; i < SURFELS; i++)
        l->surfels[i].normal = (lmp_vec3) { 0, (float)(i % 2), (float)(1 - i % 2) };
    for (size_t i = 0; i < PROBE_RAYS; i++)
        l->directions[i] = (lmp_vec3) { i % 2 ? 0.6f : -0.8f, 0, i % 2 ? 0.8f : 0.6f };
}

/* The hash of the irradiance and the probes below. */
#define HASH 0x65e30a08893f2233u

static void bits_depend_on_neither_threads_nor_machine(void **test) {
    static transfer_lists l;
    struct {
        lmp_rgb irradiance[SURFELS];
        float probes[PROBES][27];
    } alone, by_host;
    check_hooks hooks = { .refuse = -1 };
    const lmp_host host = check_host(&hooks);
    (void)test;
    draw_equal_lists(&l);
    const lmp_transfer_desc desc = transfer_desc_of(&l, SURFELS);
    const lmp_transfer_lighting lighting = transfer_lighting_of(&l);
    lmp_transfer *transfer = transfer_make(&desc), *other;
    transfer_iterate(transfer, 4, &lighting);
    transfer_copy(transfer, SURFELS, alone.irradiance);
    lmp_transfer_eval_probe_n(transfer, 0, PROBES, lmp_sh_interleaved(alone.probes[0], 0));
    assert_int_equal(lmp_transfer_create(&host, &desc, &other), LMP_OK);
    assert_int_equal(lmp_transfer_update(&host, other, NULL, &lighting), LMP_OK);
    assert_true(hooks.tasks > 3 * 8);
    assert_int_equal(lmp_transfer_describe(other).iterations, 4);
    transfer_copy(other, SURFELS, by_host.irradiance);
    for (size_t p = PROBES; p-- > 0;)
        lmp_transfer_eval_probe_n(other, p, 1, lmp_sh_interleaved(by_host.probes[p], 0));
    assert_memory_equal(&alone, &by_host, sizeof alone);
    assert_true(lmp_transfer_describe(transfer).remainder ==
                lmp_transfer_describe(other).remainder);
    lmp_transfer_destroy(other);
    lmp_transfer_destroy(transfer);
    const uint64_t hash = hash_of(&alone.irradiance[0].r, sizeof alone / sizeof(float));
    print_message("hash: 0x%016llxu\n", (unsigned long long)hash);
    assert_true(hash == HASH);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_closed_room_of_one_albedo_keeps_the_geometric_series),
        cmocka_unit_test(a_single_surfel_lights_itself),
        cmocka_unit_test(an_empty_range_may_begin_behind_the_last),
        cmocka_unit_test(two_plates_reflect_each_other),
        cmocka_unit_test(iterations_solve_the_radiosity_equation),
        cmocka_unit_test(the_remainder_bounds_the_error_and_stops),
        cmocka_unit_test(a_white_room_has_no_limit),
        cmocka_unit_test(updates_continue_where_the_last_one_ended),
        cmocka_unit_test(a_budget_takes_the_next_surfels),
        cmocka_unit_test(darkness_is_reached),
        cmocka_unit_test(probes_hold_what_their_rays_hit),
        cmocka_unit_test(bits_depend_on_neither_threads_nor_machine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

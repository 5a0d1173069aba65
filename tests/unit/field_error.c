/* SPDX-License-Identifier: MIT */
/* A field's promise: no light, wherever it and the point lie, errs by more than was asked for. The
 * worst pairs are searched uphill from the worst of many random ones, on grids with and without
 * coarser ones. Prints the table of docs/fields.md. */
#include "tests/unit/fields.h"

#include <string.h>

enum { VALUES_MAX = LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX };

/* A point and a light, in cells. */
typedef struct field_pair {
    double point[3], light[3], radius;
} field_pair;

typedef struct field_search {
    lmp_field *field;
    lmp_field_info info;
    int levels;
} field_search;

static void open_search(lmp_field_desc desc, field_search *search) {
    desc.light_max = 1;
    search->field = field_of(&desc, NULL, 0);
    search->info = lmp_field_describe(search->field);
    search->levels = 0;
    for (const lmp_field *level = search->field; level; level = lmp_field_coarser_level(level))
        search->levels++;
}

static double distance(const field_pair *pair) {
    double sum = 0;
    for (int a = 0; a < 3; a++)
        sum += (pair->point[a] - pair->light[a]) * (pair->point[a] - pair->light[a]);
    return sqrt(sum);
}

/* Returns the error of the light's red coefficients, relative to them; 0 outside the grid and
 * within the light. */
static double error_of(const field_search *search, const field_pair *pair) {
    const int bands = search->info.desc.bands, *nodes = search->info.desc.nodes;
    const size_t count = LMP_SH_COUNT(bands);
    const double *p = pair->point, *c = pair->light;
    const lmp_vec3 point = { (float)p[0], (float)p[1], (float)p[2] };
    const lmp_light light = { .position = { (float)c[0], (float)c[1], (float)c[2] },
                              .radius = (float)pair->radius,
                              .radiance = { 1, 0, 0 } };
    float actual[3 * VALUES_MAX], expected[3 * VALUES_MAX];
    for (int a = 0; a < 3; a++)
        if (p[a] < 0 || p[a] > nodes[a] - 1)
            return 0;
    if (!(pair->radius >= 1e-3) || distance(pair) < 1.001 * pair->radius)
        return 0;
    assert_int_equal(lmp_field_reset(search->field, &light, 1), LMP_OK);
    lmp_field_want_n(search->field, lmp_vec3_array_same(&point), 1);
    assert_int_equal(lmp_field_compute(NULL, search->field), LMP_OK);
    lmp_field_eval_n(search->field, lmp_vec3_array_same(&point), 1, lmp_sh_interleaved(actual, 0));
    lmp_light_project(bands, &light, 1, point, expected);
    return field_distance(actual, expected, count) / field_size(expected, count);
}

static double normal(void) {
    return sqrt(-2 * log(1 - check_random())) * cos(6.2831853 * check_random());
}

/* Returns a point around the middle of the grid and a light within the reach of the coarsest field.
 */
static field_pair random_pair(const field_search *search) {
    const double reach = (double)search->info.desc.reach;
    const double farthest = 2.6 * (1 << (search->levels - 1));
    const lmp_vec3 to = check_random_direction();
    const float direction[3] = { to.x, to.y, to.z };
    field_pair pair = { .radius = 0.5 * reach * pow(10, check_random_between(-3, 0)) };
    const double away = pair.radius + 0.05 * reach * pow(farthest / 0.05, check_random());
    for (int a = 0; a < 3; a++) {
        const double last = search->info.desc.nodes[a] - 1;
        pair.point[a] = 0.5 * last + check_random_between(-0.5, 0.5) * fmin(last, 16);
        pair.light[a] = pair.point[a] + away * (double)direction[a];
    }
    return pair;
}

/* Climbs by steps that grow when they lead uphill and shrink otherwise. */
static double climb(const field_search *search, int steps, field_pair *best, double error) {
    const double reach = (double)search->info.desc.reach;
    double size = 0.3;
    for (int i = 0; i < steps; i++) {
        field_pair next = *best;
        const double far = check_random() < 0.5 ? 1 : reach / 3;
        for (int a = 0; a < 3; a++) {
            next.point[a] += size * normal();
            next.light[a] += size * far * normal();
        }
        next.radius *= exp(size * normal());
        const double found = error_of(search, &next);
        size = fmin(size * (found > error ? 1.3 : 0.97), 0.5);
        if (found > error) {
            *best = next;
            error = found;
        }
    }
    return error;
}

/* Returns the largest error found. */
static double search_errors(const field_search *search) {
    enum { CLIMBERS = 12 };
    const int climbers = check_count(5, CLIMBERS), steps = check_count(100, 400);
    field_pair best[CLIMBERS];
    double errors[CLIMBERS] = { 0 }, worst = 0;
    for (int i = check_count(500, 3000); i > 0; i--) {
        const field_pair pair = random_pair(search);
        const double error = error_of(search, &pair);
        int least = 0;
        for (int k = 1; k < climbers; k++)
            if (errors[k] < errors[least])
                least = k;
        if (error > errors[least]) {
            errors[least] = error;
            best[least] = pair;
        }
    }
    for (int k = 0; k < climbers; k++)
        if (errors[k] > 0)
            worst = fmax(worst, climb(search, steps, &best[k], errors[k]));
    return worst;
}

/* Grids of one level, and of four; the light may lie outside the grid, as it does for thin grids.
 */
static const int grids[][3] = { { 10, 10, 10 }, { 1024, 4, 4 } };
enum { GRIDS = sizeof grids / sizeof *grids };

static void no_light_errs_by_more_than_was_asked_for(void **test) {
    (void)test;
    static const float asked[] = { 0.3f, 0.02f, 3e-3f, 0.05f, 1e-4f };
    for (int bands = 1; bands <= LMP_FIELD_BANDS_MAX; bands++)
        for (int k = 0; k < check_count(3, 5); k++)
            for (int g = 0; g < GRIDS; g++) {
                field_search search;
                open_search((lmp_field_desc) { .bands = bands,
                                               .nodes = { grids[g][0], grids[g][1], grids[g][2] },
                                               .error = asked[k] },
                            &search);
                assert_int_equal(search.levels, g == 0 ? 1 : 4);
                const double error = search_errors(&search);
                print_message("%d bands, %d levels, %.2f cells: asked %.4f, found %.5f (%.2f)\n",
                              bands, search.levels, (double)search.info.desc.reach,
                              (double)asked[k], error, error / (double)asked[k]);
                CHECK_WITHIN(error, (double)asked[k]);
                lmp_field_destroy(search.field);
            }
}

static void no_light_errs_by_more_than_a_reach_is_said_to(void **test) {
    (void)test;
    static const float reaches[] = { 2, 3, 4, 6, 8 };
    static const int columns[] = { 3, 5, 8, 10 };
    check_random(); /* prints the seed */
    print_message("table fields.error\n| reach, cells | 3 bands | 5 bands | 8 bands | 10 bands |\n"
                  "|---|---|---|---|---|\n");
    for (int r = check_count(3, 0); r < check_count(4, 5); r++) {
        print_message("| %.0f |", (double)reaches[r]);
        for (int c = 0; c < 4; c++) {
            double worst = 0;
            for (int g = 0; g < GRIDS; g++) {
                field_search search;
                open_search((lmp_field_desc) { .bands = columns[c],
                                               .nodes = { grids[g][0], grids[g][1], grids[g][2] },
                                               .reach = reaches[r] },
                            &search);
                worst = fmax(worst, search_errors(&search));
                CHECK_WITHIN(worst, (double)search.info.desc.error);
                lmp_field_destroy(search.field);
            }
            print_message(" %#.2g |", worst);
        }
        print_message("\n");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_light_errs_by_more_than_was_asked_for),
        cmocka_unit_test(no_light_errs_by_more_than_a_reach_is_said_to),
    };
    cmocka_set_test_filter(getenv("LAMPION_TEST"));
    return cmocka_run_group_tests(tests, NULL, NULL);
}

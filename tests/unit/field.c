/* SPDX-License-Identifier: MIT */
/* Fields at points: what interpolation reproduces, how it converges, and near lights. */
#include "src/base/bytes.h"
#include "tests/unit/fields.h"

#include <string.h>

enum { BANDS = 5, VALUES = 3 * BANDS * BANDS, LIGHTS = 60 };

/* --- interpolation ---------------------------------------------------------------------------- */

/* Evaluates a cubic of x, y, z, with a factor for each monomial; slopes receives its derivatives.
 */
static double cubic(const double at[3], const double *factors, double slopes[3]) {
    double sum = 0;
    slopes[0] = slopes[1] = slopes[2] = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; i + j < 4; j++)
            for (int k = 0; i + j + k < 4; k++) {
                const double f = *factors++;
                const int power[3] = { i, j, k };
                sum += f * pow(at[0], i) * pow(at[1], j) * pow(at[2], k);
                for (int a = 0; a < 3; a++) {
                    double slope = f * power[a];
                    for (int b = 0; b < 3; b++)
                        slope *= pow(at[b], power[b] - (a == b && power[b] > 0));
                    slopes[a] += slope;
                }
            }
    return sum;
}

/* Makes a field of a cubic. The bytes of a dark field end with its nodes, x varying fastest, and
 * the checksum: the nodes are replaced by the cubic. */
static lmp_field *cubic_field(const lmp_field_desc *desc, const double *factors) {
    lmp_field *dark = field_of(desc, NULL, 0), *field;
    const size_t size = lmp_field_size(dark), values = 3 * LMP_SH_COUNT(desc->bands);
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    lmp_field_write(dark, lmp_field_size(dark), bytes);
    lmp_field_destroy(dark);
    const int *n = desc->nodes;
    unsigned char *p = bytes + size - 4 - 16 * values * (size_t)(n[0] * n[1] * n[2]);
    for (int i = 0; i < n[0] * n[1] * n[2]; i++) {
        const double at[3] = {
            (double)desc->origin.x + (double)desc->cell.x * (i % n[0]),
            (double)desc->origin.y + (double)desc->cell.y * (i / n[0] % n[1]),
            (double)desc->origin.z + (double)desc->cell.z * (i / n[0] / n[1]),
        };
        double of[4];
        of[0] = cubic(at, factors, of + 1);
        for (size_t v = 0; v < 4 * values; v++)
            p = lmpi_bytes_store_f32(p, (float)(of[v / values] * (double)(1 + v % values)));
    }
    lmpi_bytes_store_u32(bytes + size - 4, lmpi_bytes_checksum(bytes, size - 4));
    assert_int_equal(lmp_field_read(NULL, bytes, size, NULL, &field), LMP_OK);
    free(bytes);
    return field;
}

static void interpolation_reproduces_cubics(void **test) {
    (void)test;
    for (int bands = 1; bands <= LMP_FIELD_BANDS_MAX; bands += 3) {
        const lmp_field_desc desc = { .bands = bands,
                                      .nodes = { 6, 3, 5 },
                                      .origin = { -1, 0.5f, -0.5f },
                                      .cell = { 0.5f, 0.25f, 0.375f } };
        const size_t values = 3 * LMP_SH_COUNT(bands);
        double factors[20], slopes[3];
        float sh[3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX];
        for (int i = 0; i < 20; i++)
            factors[i] = check_random_between(-1, 1);
        lmp_field *field = cubic_field(&desc, factors);
        for (int i = 0; i < 200; i++) {
            const double at[3] = { -1 + 2.5 * check_random(), 0.5 + 0.5 * check_random(),
                                   -0.5 + 1.5 * check_random() };
            const lmp_vec3 point = { (float)at[0], (float)at[1], (float)at[2] };
            const double expected = cubic(at, factors, slopes);
            lmp_field_eval_n(field, lmp_vec3_array_same(&point), 1, lmp_sh_interleaved(sh, 0));
            for (size_t v = 0; v < values; v++)
                CHECK_WITHIN(fabs((double)sh[v] / (double)(1 + v) - expected), 1e-5);
        }
        lmp_field_destroy(field);
    }
}

/* The lights lie beyond their reach; a grid of more nodes has a coarser one, which errs more. */
static void the_error_falls_with_the_fourth_power_of_a_cell(void **test) {
    (void)test;
    lmp_light lights[LIGHTS];
    field_sphere_lights(-4, -2, LIGHTS, lights);
    lmp_vec3 points[300];
    for (int i = 0; i < 300; i++)
        points[i] = field_point(0, 4);
    double before = 0;
    for (int n = 6; n <= 11; n = 2 * n - 1) {
        const float cell = 4.0f / (float)(n - 1);
        const lmp_field_desc desc = { .nodes = { n, n, n },
                                      .cell = { cell, cell, cell },
                                      .reach = 1 };
        lmp_field *field = field_of(&desc, lights, LIGHTS);
        double sum = 0;
        for (int i = 0; i < 300; i++)
            sum += field_error(field, points[i]);
        lmp_field_destroy(field);
        if (n > 6)
            CHECK_WITHIN(fabs(log2(before / sum) - 4), 0.35);
        before = sum;
    }
}

/* --- near lights ------------------------------------------------------------------------------ */

static void a_light_errs_by_no_more_than_the_field_says(void **test) {
    (void)test;
    static const float reaches[] = { 2, 3, 4.5f, 7 };
    for (int bands = 1; bands <= LMP_FIELD_BANDS_MAX; bands++)
        for (int r = 0; r < 4; r++) {
            const lmp_field_desc desc = { .bands = bands, .reach = reaches[r] };
            lmp_field *field = field_of(&desc, NULL, 0);
            const lmp_field_info info = lmp_field_describe(field);
            double worst = 0;
            for (int i = 0; i < 12; i++) {
                const lmp_light light = field_sphere_light(7, 8);
                assert_int_equal(lmp_field_update(NULL, field, &light, 1), LMP_OK);
                for (int k = 0; k < 40; k++) {
                    const lmp_vec3 to = check_random_direction();
                    const float d = light.radius + (float)check_random() * 1.2f * info.reach;
                    const lmp_vec3 point = { light.position.x + d * to.x,
                                             light.position.y + d * to.y,
                                             light.position.z + d * to.z };
                    worst = fmax(worst, field_error(field, point));
                }
            }
            CHECK_WITHIN(worst, (double)info.desc.error);
            lmp_field_destroy(field);
        }
}

static void the_reach_follows_from_the_error_asked_for(void **test) {
    (void)test;
    for (int bands = 1; bands <= LMP_FIELD_BANDS_MAX; bands++) {
        lmp_field *field;
        const lmp_field_desc desc = { .bands = bands, .error = 0.01f, .cell = { 1, 3, 2 } };
        assert_int_equal(lmp_field_create(NULL, &desc, &field), LMP_OK);
        const lmp_field_info info = lmp_field_describe(field);
        CHECK_WITHIN(fabs((double)info.desc.error - 0.01), 1e-6);
        CHECK_WITHIN(fabs((double)info.reach - 3 * (double)info.desc.reach), 1e-5);
        lmp_field_destroy(field);
    }
}

/* Moves a light through cells, past points, in steps whose effect must stay within a few times
 * their size: a jump would show. */
static void check_no_jumps(int nodes) {
    enum { STEPS = 400, POINTS = 24 };
    const lmp_field_desc desc = { .nodes = { nodes, nodes, nodes }, .error = 0.3f };
    lmp_light light = { .radius = 0.2f, .radiance = { 1, 1, 1 } };
    lmp_field *field = field_of(&desc, &light, 1);
    lmp_vec3 points[POINTS];
    float before[POINTS][VALUES], error[VALUES];
    for (int i = 0; i < POINTS; i++)
        points[i] = field_point(2, 9);
    for (int step = 0; step <= STEPS; step++) {
        const float s = (float)step / STEPS;
        light.position = (lmp_vec3) { 2 + 6.5f * s, 3 + 4.3f * s, 8 - 5.1f * s };
        assert_int_equal(lmp_field_update(NULL, field, &light, 1), LMP_OK);
        for (int i = 0; i < POINTS; i++) {
            float exact[VALUES], sh[VALUES];
            lmp_light_project(BANDS, &light, 1, points[i], exact);
            lmp_field_eval_n(field, lmp_vec3_array_same(&points[i]), 1, lmp_sh_interleaved(sh, 0));
            for (int v = 0; v < VALUES; v++)
                error[v] = sh[v] - exact[v];
            /* The error is at most 0.3 of a light, and changes over a fraction of a cell; a step is
             * a fortieth of a cell. */
            if (step > 0)
                CHECK_WITHIN(field_distance(error, before[i], VALUES),
                             0.03 * field_size(exact, VALUES) + 1e-4);
            memcpy(before[i], error, sizeof error);
        }
    }
    lmp_field_destroy(field);
}

static void nothing_jumps_where_a_light_crosses_a_cell(void **test) {
    (void)test;
    check_no_jumps(12);
}

/* These numbers of nodes have coarser fields, whose cells and reaches the light crosses, too. */
static void nothing_jumps_where_a_light_crosses_a_coarser_cell(void **test) {
    (void)test;
    check_no_jumps(14);
}

static void near_lights_are_told_with_their_residuals(void **test) {
    (void)test;
    lmp_light lights[LIGHTS];
    const lmp_field_desc desc = { .nodes = { 9, 9, 9 }, .reach = 2 };
    field_sphere_lights(0, 8, LIGHTS, lights);
    lights[7].kind = LMP_LIGHT_DIRECTIONAL;
    lights[7].direction = (lmp_vec3) { 0, 1, 0 };
    lmp_field *field = field_of(&desc, lights, LIGHTS);
    for (int i = 0; i < 300; i++) {
        const lmp_vec3 p = field_point(-1, 9);
        const bool inside = fmaxf(p.x, fmaxf(p.y, p.z)) <= 8 && fminf(p.x, fminf(p.y, p.z)) >= 0;
        uint32_t near[LIGHTS];
        float fractions[LIGHTS];
        size_t count = lmp_field_find_near(field, p, LIGHTS, near, fractions), found = 0;
        assert_int_equal(lmp_field_find_near(field, p, 0, NULL, NULL), count);
        for (uint32_t k = 0; k < LIGHTS; k++) {
            const lmp_vec3 c = lights[k].position;
            const double d = sqrt((double)((c.x - p.x) * (c.x - p.x) + (c.y - p.y) * (c.y - p.y) +
                                           (c.z - p.z) * (c.z - p.z)));
            const double t = fmin(fmax((d - (double)lights[k].radius) / 2, 0), 1), u = t * t;
            const double residual = inside && k != 7 ? 1 - u * u * (6 - 8 * u + 3 * u * u) : 1;
            const bool listed = found < count && near[found] == k;
            CHECK_WITHIN(fabs((listed ? (double)fractions[found] : 0) - residual), 1e-5);
            found += listed;
        }
        assert_int_equal(found, count);
    }
    lmp_field_destroy(field);
}

static void outside_the_grid_every_light_is_summed(void **test) {
    (void)test;
    lmp_light lights[LIGHTS];
    field_sphere_lights(0, 15, LIGHTS, lights);
    lmp_field *field = field_of(NULL, lights, LIGHTS);
    for (int i = 0; i < 100; i++) {
        const lmp_vec3 point = field_point(15.001, 40);
        CHECK_WITHIN(field_error(field, point), 1e-6);
    }
    lmp_field_destroy(field);
}

/* More lights near each point than are found at once, of every kind, at points of several blocks
 * in random order and outside the grid. */
static void points_together_are_points_alone(void **test) {
    (void)test;
    enum { MANY = 1500, POINTS = 41 };
    static lmp_light lights[MANY];
    static float rows[POINTS][VALUES], planes[VALUES][POINTS];
    const lmp_field_desc desc = { .nodes = { 7, 7, 7 }, .light_max = MANY, .reach = 3 };
    lmp_vec3 points[POINTS];
    float alone[VALUES];
    field_sphere_lights(0, 6, MANY, lights);
    for (int i = 0; i < MANY; i += 5)
        lights[i].kind = LMP_LIGHT_POINT;
    lights[700].kind = LMP_LIGHT_DIRECTIONAL;
    lights[700].direction = (lmp_vec3) { 0, 0.6f, 0.8f };
    lights[1400].kind = LMP_LIGHT_SPOT;
    lights[1400].direction = (lmp_vec3) { 1, 0, 0 };
    lights[1400].inner = 0.3f;
    lights[1400].outer = 1.2f;
    lmp_field *field = field_of(&desc, lights, MANY);
    for (int i = 0; i < POINTS; i++)
        points[i] =
            i % 4 < 3 ? (lmp_vec3) { 0.3f * (float)(i % 20), 2.1f, 3.2f } : field_point(-1, 7);
    assert_true(lmp_field_find_near(field, points[10], 0, NULL, NULL) > 600);
    lmp_field_eval_n(field, lmp_vec3_array_of(points), POINTS, lmp_sh_interleaved(rows[0], 0));
    lmp_field_eval_n(field, lmp_vec3_array_of(points), POINTS, lmp_sh_planar(planes[0], 0));
    for (int i = 0; i < POINTS; i++) {
        lmp_field_eval_n(field, lmp_vec3_array_same(&points[i]), 1, lmp_sh_interleaved(alone, 0));
        assert_memory_equal(rows[i], alone, sizeof alone);
        for (int v = 0; v < VALUES; v++)
            assert_true(planes[v][i] == alone[v]);
        CHECK_WITHIN(field_error(field, points[i]), 0.02);
    }
    lmp_field_destroy(field);
}

/* --- lobes ------------------------------------------------------------------------------------ */

static void lobes_respond_as_to_the_coefficients(void **test) {
    (void)test;
    enum { POINTS = 37 };
    lmp_light lights[LIGHTS];
    lmp_vec3 points[POINTS], axes[POINTS];
    lmp_rgb rgb[POINTS];
    float padded[POINTS][5];
    float planes[VALUES][POINTS + 3], rows[POINTS][VALUES], lambda[BANDS], lobe[BANDS * BANDS];
    field_sphere_lights(0, 15, LIGHTS, lights);
    for (int i = 0; i < POINTS; i++) {
        points[i] = field_point(-1, 16);
        axes[i] = check_random_direction();
    }
    lmp_field *field = field_of(NULL, lights, LIGHTS);
    lmp_lobe_make_phong(BANDS, 7, lambda);
    lmp_field_eval_lobe_n(field, lambda, lmp_vec3_array_of(axes), lmp_vec3_array_of(points), POINTS,
                          lmp_rgb_array_of(rgb));
    memset(padded, 0x7f, sizeof padded);
    lmp_field_eval_lobe_n(field, lambda, lmp_vec3_array_of(axes), lmp_vec3_array_of(points), POINTS,
                          (lmp_rgb_array) { padded[0], sizeof padded[0] });
    lmp_field_eval_n(field, lmp_vec3_array_of(points), POINTS, lmp_sh_interleaved(rows[0], 0));
    lmp_field_eval_n(field, lmp_vec3_array_of(points), POINTS,
                     lmp_sh_planar(planes[0], sizeof planes[0]));
    for (int i = 0; i < POINTS; i++) {
        lmp_lobe_project(BANDS, lambda, axes[i], lobe);
        const double scale = field_size(rows[i], VALUES);
        assert_memory_equal(padded[i], &rgb[i], sizeof rgb[i]);
        assert_memory_equal(&padded[i][3], "\x7f\x7f\x7f\x7f\x7f\x7f\x7f\x7f", 2 * sizeof(float));
        for (int v = 0; v < VALUES; v++)
            assert_true(memcmp(&rows[i][v], &planes[v][i], sizeof(float)) == 0);
        CHECK_WITHIN(fabsf(rgb[i].r - lmp_sh_dot(BANDS, lobe, rows[i])), 1e-6 * scale);
        CHECK_WITHIN(fabsf(rgb[i].g - lmp_sh_dot(BANDS, lobe, rows[i] + 25)), 1e-6 * scale);
        CHECK_WITHIN(fabsf(rgb[i].b - lmp_sh_dot(BANDS, lobe, rows[i] + 50)), 1e-6 * scale);
    }
    lmp_field_destroy(field);
}

/* --- for shaders ------------------------------------------------------------------------------ */

/* The bytes end with the nodes, row by row, and the checksum. */
static void texels_are_the_nodes_of_the_bytes(void **test) {
    (void)test;
    lmp_light lights[LIGHTS];
    const lmp_field_desc desc = { .bands = 2, .nodes = { 5, 3, 4 } };
    enum { NODES = 5 * 3 * 4, FEW = 3 * 2 * 2 };
    static float texels[NODES * 4 * FEW];
    field_sphere_lights(0, 4, LIGHTS, lights);
    lmp_field *field = field_of(&desc, lights, LIGHTS);
    const size_t size = lmp_field_size(field);
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    lmp_field_write(field, lmp_field_size(field), bytes);
    for (size_t first = 0; first < NODES; first += 20)
        lmp_field_copy_nodes(field, first, 20, texels + 4 * FEW * first);
    lmp_field_copy_nodes(field, NODES, 0, NULL);
    const unsigned char *p = bytes + size - 4 - sizeof texels;
    for (size_t i = 0; i < NODES; i++)
        for (size_t row = 0; row < 4; row++)
            for (size_t v = 0; v < FEW; v++) {
                const float stored = lmpi_bytes_load_f32(&p);
                assert_true(stored == texels[4 * (FEW * i + v) + row]);
            }
    free(bytes);
    lmp_field_destroy(field);
}

static bool is_listed(const uint32_t *lights, uint32_t first, uint32_t end, uint32_t light) {
    for (uint32_t i = first; i < end; i++)
        if (lights[i] == light)
            return true;
    return false;
}

static void lists_hold_all_that_is_near(void **test) {
    (void)test;
    enum { BLOCKS = 4 * 4 * 4, ROOM = LIGHTS * (BLOCKS + 1) };
    lmp_light lights[LIGHTS];
    const lmp_field_desc desc = { .nodes = { 9, 8, 9 }, .reach = 2 };
    static uint32_t begin[BLOCKS + 2], listed[ROOM];
    field_sphere_lights(0, 8, LIGHTS, lights);
    lights[7].kind = LMP_LIGHT_DIRECTIONAL;
    lights[7].direction = (lmp_vec3) { 0, 1, 0 };
    lmp_field *field = field_of(&desc, lights, LIGHTS);
    const size_t count = lmp_field_copy_lists(field, ROOM, begin, listed);
    assert_int_equal(lmp_field_copy_lists(field, 0, NULL, NULL), count);
    assert_true(count > LIGHTS && count < ROOM / 2);
    assert_int_equal(begin[BLOCKS + 1], count);
    assert_int_equal(count - begin[BLOCKS], 1);
    assert_int_equal(listed[begin[BLOCKS]], 7);
    for (int i = 0; i < 300; i++) {
        const lmp_vec3 p = field_point(0, 7);
        const uint32_t block = ((uint32_t)p.z / 2 * 4 + (uint32_t)p.y / 2) * 4 + (uint32_t)p.x / 2;
        uint32_t near[LIGHTS];
        float fractions[LIGHTS];
        const size_t found = lmp_field_find_near(field, p, LIGHTS, near, fractions);
        for (size_t k = 0; k < found; k++)
            assert_true(near[k] == 7 || is_listed(listed, begin[block], begin[block + 1], near[k]));
    }
    lmp_field_destroy(field);
}

/* Returns the fraction of a light that remains outside a field of that reach, at a distance from
 * its surface. */
static double fade(double away, double reach) {
    const double t = fmin(fmax(away / reach, 0), 1), u = t * t;
    return u * u * (6 - 8 * u + 3 * u * u);
}

/* Returns coefficient 0 of what a list adds, in red, at node i of each axis. */
static double listed_at(const lmp_field *field, const uint32_t *begin, const uint32_t *listed,
                        uint32_t list, int i) {
    const lmp_field_info fine = lmp_field_describe(field);
    const double outer = (double)lmp_field_describe(lmp_field_coarser_level(field)).reach;
    const lmp_vec3 at = { (float)i, (float)i, (float)i };
    double sum = 0;
    for (uint32_t k = begin[list]; k < begin[list + 1]; k++) {
        const lmp_light *light = &lmp_field_lights(field)[listed[k]];
        const double x = (double)(light->position.x - at.x), y = (double)(light->position.y - at.y);
        const double z = (double)(light->position.z - at.z);
        const double away = sqrt(x * x + y * y + z * z) - (double)light->radius;
        float sh[25];
        lmp_sphere_project(5, light->position, light->radius, at, sh);
        sum += (fade(away, (double)fine.reach) - fade(away, outer)) * (double)light->radiance.r *
               (double)sh[0];
    }
    return sum;
}

static void nodes_are_those_of_a_coarser_field_and_near_lights(void **test) {
    (void)test;
    enum { SIDE = 14, BLOCKS = 4 * 4 * 4, ROOM = LIGHTS * (BLOCKS + 1) };
    static uint32_t begin[BLOCKS + 2], listed[ROOM];
    static float texel[4 * 75], coarse_texel[4 * 75];
    lmp_light lights[LIGHTS];
    const lmp_field_desc desc = { .nodes = { SIDE, SIDE, SIDE }, .reach = 2 };
    field_sphere_lights(0, SIDE, LIGHTS, lights);
    lmp_field *field = field_of(&desc, lights, LIGHTS);
    const lmp_field *coarse = lmp_field_coarser_level(field);
    const lmp_field_info info = lmp_field_describe(coarse);
    assert_null(lmp_field_coarser_level(coarse));
    assert_true(info.desc.cell.x == 2 && info.desc.cell.y == 2 && info.desc.cell.z == 2);
    assert_true(info.light_count == LIGHTS && info.reach > 4);
    const int *n = info.desc.nodes;
    assert_true(n[0] / 2 == 4 && n[1] / 2 == 4 && n[2] / 2 == 4);
    assert_true(lmp_field_copy_lists(coarse, ROOM, begin, listed) < ROOM);
    for (int i = 0; i < SIDE; i += 2) {
        const uint32_t b = (uint32_t)i / 4;
        lmp_field_copy_nodes(field, (size_t)((i * SIDE + i) * SIDE + i), 1, texel);
        lmp_field_copy_nodes(coarse, (size_t)((i / 2 * n[1] + i / 2) * n[0] + i / 2), 1,
                             coarse_texel);
        const double added = listed_at(field, begin, listed, (b * 4 + b) * 4 + b, i) +
                             listed_at(field, begin, listed, BLOCKS, i);
        CHECK_WITHIN(fabs((double)texel[0] - (double)coarse_texel[0] - added),
                     1e-5 * (double)texel[0]);
    }
    lmp_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interpolation_reproduces_cubics),
        cmocka_unit_test(the_error_falls_with_the_fourth_power_of_a_cell),
        cmocka_unit_test(a_light_errs_by_no_more_than_the_field_says),
        cmocka_unit_test(the_reach_follows_from_the_error_asked_for),
        cmocka_unit_test(nothing_jumps_where_a_light_crosses_a_cell),
        cmocka_unit_test(nothing_jumps_where_a_light_crosses_a_coarser_cell),
        cmocka_unit_test(near_lights_are_told_with_their_residuals),
        cmocka_unit_test(outside_the_grid_every_light_is_summed),
        cmocka_unit_test(points_together_are_points_alone),
        cmocka_unit_test(lobes_respond_as_to_the_coefficients),
        cmocka_unit_test(texels_are_the_nodes_of_the_bytes),
        cmocka_unit_test(lists_hold_all_that_is_near),
        cmocka_unit_test(nodes_are_those_of_a_coarser_field_and_near_lights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

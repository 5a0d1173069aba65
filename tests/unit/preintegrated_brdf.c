/* SPDX-License-Identifier: MIT */
/* Preintegrated BRDFs against the sums over bands that they stand for. */
#include "tests/unit/preintegrated_brdfs.h"

#include <lampion/cpu.h>
#include <stdlib.h>

/* --- errors ----------------------------------------------------------------------------------- */

static lmp_rgb shaded(const lmp_brdf_table *table, const lmp_preintegrated_brdf *preintegrated,
                      const probe *p, lmp_vec3 direction) {
    const lmp_light light = { .position = direction, .radius = p->radius, .radiance = { 1, 1, 1 } };
    const lmp_surface surface = { .normal = { 0, 0, 1 },
                                  .view = { (float)sin(p->theta), 0, (float)cos(p->theta) } };
    const lmp_material material = { .kind = LMP_MATERIAL_TABLE,
                                    .table = table,
                                    .preintegrated = preintegrated };
    const lmp_shade_settings settings = { .method = LMP_SHADE_PREINTEGRATED };
    return lmp_shade(preintegrated ? &settings : NULL, &material, &surface, &light, 1);
}

static float largest_of(lmp_rgb c) {
    return fmaxf(c.r, fmaxf(c.g, c.b));
}

/* Returns the largest value of all views, at the mirror direction. */
static float peak_of_views(const lmp_brdf_table *table, float radius) {
    float peak = 0;
    for (int i = 0; i < 16; i++) {
        const probe p = { pi / 2 * i / 16, radius };
        peak = fmaxf(peak, largest_of(shaded(table, NULL, &p, around_mirror(&p, 0, 0))));
    }
    return peak;
}

enum { DIRECTIONS = 40 };

static void compare(const lmp_brdf_table *table, const lmp_preintegrated_brdf *preintegrated,
                    const probe *p, check_errors *errors) {
    const double detail = (double)lmp_preintegrated_brdf_describe(preintegrated).width;
    lmp_rgb expected[DIRECTIONS], read[DIRECTIONS];
    float peak = 0.05f * peak_of_views(table, p->radius);
    for (int i = 0; i < DIRECTIONS; i++) {
        const lmp_vec3 direction = random_direction(p, i, detail);
        expected[i] = shaded(table, NULL, p, direction);
        read[i] = shaded(table, preintegrated, p, direction);
        peak = fmaxf(peak, largest_of(expected[i]));
    }
    for (int i = 0; i < DIRECTIONS; i++) {
        const double off[3] = { (double)(read[i].r - expected[i].r),
                                (double)(read[i].g - expected[i].g),
                                (double)(read[i].b - expected[i].b) };
        for (int c = 0; c < 3; c++)
            check_errors_add(errors, fabs(off[c]) / (double)peak);
    }
}

/* Measures the errors, prints and returns them. */
static check_errors errors_of(const char *what, const lmp_brdf_table *table, int probes) {
    lmp_preintegrated_brdf *preintegrated = created(table, 0);
    const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(preintegrated);
    check_errors errors = { 0 };
    for (int i = 0; i < probes; i++) {
        const probe p = random_probe(-4, log10(0.99));
        compare(table, preintegrated, &p, &errors);
    }
    print_message("%s, %d bands, window %d: %.1f MB, %ld values, error max %.3f %%, rms %.4f %%\n",
                  what, info.bands, (int)info.window, (double)info.bytes / 1e6, errors.count,
                  100 * errors.largest, 100 * check_errors_rms(&errors));
    lmp_preintegrated_brdf_destroy(preintegrated);
    return errors;
}

static void check_probes(const char *what, const lmp_brdf_table *table, int probes) {
    const check_errors errors = errors_of(what, table, probes);
    CHECK_WITHIN(errors.largest, 5e-3);
    CHECK_WITHIN(check_errors_rms(&errors), 5e-4);
}

/* LAMPION_MATERIAL_BANDS chooses other bands than 10, for tables with the rings that these need,
 * and only prints, for docs/preintegration-notes.md. */
static void ten_materials_match_their_sums_within_the_error(void **state) {
    (void)state;
    const char *const more = getenv("LAMPION_MATERIAL_BANDS");
    const lmp_brdf_table_desc desc = { .bands = more ? atoi(more) : 10,
                                       .window = LMP_WINDOW_HANNING,
                                       .rings_max = more ? 0 : 128 };
    static const char *const names[] = { "gold-metallic-paint",
                                         "blue-metallic-paint",
                                         "nickel",
                                         "chrome",
                                         "steel",
                                         "white-fabric",
                                         "red-fabric",
                                         "green-plastic",
                                         "black-phenolic",
                                         "pearl-paint" };
    for (int i = 0; i < 10; i += check_count(4, 1)) {
        lmp_brdf_table *table = table_of(sgd_brdf(names[i]), &desc);
        if (more)
            errors_of(names[i], table, 250);
        else
            check_probes(names[i], table, check_count(80, 250));
        lmp_brdf_table_destroy(table);
    }
}

static void more_bands_and_no_window_match_as_well(void **state) {
    (void)state;
    lmp_brdf_table *metal = sgd_table("gold-metallic-paint", 8, LMP_WINDOW_NONE);
    check_probes("gold-metallic-paint", metal, 100);
    lmp_brdf_table_destroy(metal);
    lmp_brdf_table *fine = sgd_table("green-plastic", 20, LMP_WINDOW_LANCZOS);
    check_probes("green-plastic", fine, 60);
    lmp_brdf_table_destroy(fine);
    const int few[] = { 1, 2, 3 };
    for (int i = 0; i < 3; i++) {
        lmp_brdf_table *table = sgd_table("white-fabric", few[i], LMP_WINDOW_NONE);
        check_probes("white-fabric", table, 60);
        lmp_brdf_table_destroy(table);
    }
}

/* The lobe is one that 128 rings resolve, with steel's shadowing, which removes all light between
 * 80 and 87 degrees of view. */
static void a_sharp_lobe_that_fades_near_grazing_matches_as_well(void **state) {
    (void)state;
    const lmp_brdf_table_desc desc = { .bands = check_count(48, 100),
                                       .window = LMP_WINDOW_HANNING,
                                       .rings_max = 128 };
    lmp_sgd sgd;
    lmp_brdf *brdf;
    assert_int_equal(lmp_brdf_find_sgd("steel", &sgd), LMP_OK);
    for (int c = 0; c < 3; c++) {
        sgd.alpha[c] = 1e-3;
        sgd.p[c] = 0;
        sgd.k_ap[c] = 1e3;
    }
    assert_int_equal(lmp_brdf_create_sgd(NULL, &sgd, &brdf), LMP_OK);
    lmp_brdf_table *table = table_of(brdf, &desc);
    check_probes("steel, one width", table, 40);
    lmp_brdf_table_destroy(table);
}

static void a_table_of_all_orders_and_few_views_matches_as_well(void **state) {
    (void)state;
    const lmp_brdf_table_desc desc = {
        .bands = 7, .views = 12, .rings_max = 64, .symmetry = LMP_BRDF_SYMMETRY_NONE
    };
    lmp_brdf_table *table = table_of(sgd_brdf("nickel"), &desc);
    assert_false(lmp_brdf_table_describe(table).mirrored);
    check_probes("nickel, all orders", table, 60);
    lmp_brdf_table_destroy(table);
}

static void tables_hold_inside_spheres_and_at_their_surface(void **state) {
    (void)state;
    lmp_brdf_table *table = sgd_table("red-fabric", 8, LMP_WINDOW_HANNING);
    lmp_preintegrated_brdf *preintegrated = created(table, 0);
    check_errors errors = { 0 };
    for (int i = 0; i < 60; i++) {
        const probe p = i % 2 ? random_probe(0, 2) : random_probe(-1e-4, 1e-4);
        compare(table, preintegrated, &p, &errors);
    }
    CHECK_WITHIN(errors.largest, 5e-3);
    lmp_preintegrated_brdf_destroy(preintegrated);
    lmp_brdf_table_destroy(table);
}

static void a_larger_error_takes_less_memory(void **state) {
    (void)state;
    lmp_brdf_table *table = sgd_table("white-fabric", 8, LMP_WINDOW_HANNING);
    lmp_preintegrated_brdf *fine = created(table, 0.002f), *coarse = created(table, 0.05f);
    assert_true(lmp_preintegrated_brdf_describe(coarse).bytes <
                lmp_preintegrated_brdf_describe(fine).bytes / 2);
    lmp_preintegrated_brdf_destroy(fine);
    lmp_preintegrated_brdf_destroy(coarse);
    lmp_brdf_table_destroy(table);
}

/* --- many surfaces ---------------------------------------------------------------------------- */

enum { SURFACES = 531, MATERIALS = 5, LIGHTS = 43 };

typedef struct crowd {
    lmp_brdf_table *tables[2];
    lmp_preintegrated_brdf *preintegrated[2];
    lmp_preintegrated_lobe *lobes;
    lmp_material materials[SURFACES];
    lmp_surface surfaces[SURFACES];
    lmp_light lights[LIGHTS];
} crowd;

static lmp_rgb random_color(void) {
    return (lmp_rgb) { (float)check_random(), (float)check_random(), (float)check_random() };
}

static lmp_vec3 random_point(double size) {
    return (lmp_vec3) { (float)check_random_between(-size, size),
                        (float)check_random_between(-size, size),
                        (float)check_random_between(-size, size) };
}

/* Scatters lights of all kinds; some spheres contain some of the surfaces. */
static void scatter_lights(lmp_light *lights) {
    for (int i = 0; i < LIGHTS; i++)
        lights[i] = (lmp_light) { .kind = (lmp_light_kind)(i % 6),
                                  .position = random_point(3),
                                  .direction = check_random_direction(),
                                  .radius = (float)check_random_between(0.001, 0.8),
                                  .angle = (float)check_random_between(0.01, 2.5),
                                  .inner = 0.3f,
                                  .outer = 1.2f,
                                  .radiance = random_color(),
                                  .ground = random_color() };
}

/* Makes surfaces of lobes, two preintegrated tables and one that is not preintegrated, mixed; some
 * views lie along the normal, from below and level. */
static crowd *crowd_create(void) {
    crowd *c = calloc(1, sizeof *c);
    assert_non_null(c);
    c->tables[0] = sgd_table("green-plastic", 6, LMP_WINDOW_HANNING);
    const lmp_brdf_table_desc smooth = {
        .bands = 5, .views = 9, .rings_max = 32, .symmetry = LMP_BRDF_SYMMETRY_NONE
    };
    c->tables[1] = table_of(sgd_brdf("white-fabric"), &smooth);
    for (int i = 0; i < 2; i++)
        c->preintegrated[i] = created(c->tables[i], 0.02f);
    assert_int_equal(
        lmp_preintegrated_lobe_create(
            NULL, &(lmp_preintegrated_lobe_desc) { .bands = 6, .error = 0.05f }, &c->lobes),
        LMP_OK);
    for (int i = 0; i < SURFACES; i++) {
        const int which = (int)(check_random() * MATERIALS);
        c->materials[i] = (lmp_material) {
            .kind = which == 0   ? LMP_MATERIAL_LOBES
                    : which == 3 ? LMP_MATERIAL_PREINTEGRATED
                                 : LMP_MATERIAL_TABLE,
            .diffuse = random_color(),
            .specular = random_color(),
            .exponent = (float)check_random_between(1, 100),
            .table = which == 0 || which == 3 ? NULL : c->tables[which % 2],
            .preintegrated = which == 0 || which == 4 ? NULL : c->preintegrated[which % 2],
        };
        const lmp_vec3 n = check_random_direction(), v = check_random_direction();
        c->surfaces[i] =
            (lmp_surface) { .position = random_point(1), .normal = n, .view = i % 16 ? v : n };
        if (i % 32 == 0)
            c->surfaces[i].normal = c->surfaces[i].view = (lmp_vec3) { 0, 1, 0 };
    }
    scatter_lights(c->lights);
    return c;
}

static void crowd_free(crowd *c) {
    for (int i = 0; i < 2; i++) {
        lmp_preintegrated_brdf_destroy(c->preintegrated[i]);
        lmp_brdf_table_destroy(c->tables[i]);
    }
    lmp_preintegrated_lobe_destroy(c->lobes);
    free(c);
}

static lmp_shade_settings by_readings(const crowd *c) {
    return (lmp_shade_settings) { .method = LMP_SHADE_PREINTEGRATED, .lobe = c->lobes };
}

static void shade_crowd(const crowd *c, size_t count, float *rgb) {
    const lmp_surface *s = c->surfaces;
    const lmp_surfaces surfaces = {
        .position = { &s->position.x, &s->position.y, &s->position.z, sizeof *s },
        .normal = { &s->normal.x, &s->normal.y, &s->normal.z, sizeof *s },
        .view = { &s->view.x, &s->view.y, &s->view.z, sizeof *s },
        .material = c->materials,
        .material_stride = sizeof *c->materials,
    };
    const lmp_shade_settings settings = by_readings(c);
    lmp_shade_n(&settings, &surfaces, count, c->lights, LIGHTS,
                (lmp_rgb_array) { rgb, 4 * sizeof *rgb });
}

static double dot3(lmp_vec3 a, lmp_vec3 b) {
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

/* Rotates w into the frame whose z is the normal, with x on the side of the view. */
static lmp_vec3 into_frame(const lmp_surface *s, lmp_vec3 w) {
    const lmp_vec3 n = s->normal;
    const double c = dot3(s->view, n);
    lmp_vec3 x = { (float)((double)s->view.x - c * (double)n.x),
                   (float)((double)s->view.y - c * (double)n.y),
                   (float)((double)s->view.z - c * (double)n.z) };
    const double length = sqrt(dot3(x, x));
    const lmp_vec3 y = { n.y * x.z - n.z * x.y, n.z * x.x - n.x * x.z, n.x * x.y - n.y * x.x };
    return (lmp_vec3) { (float)(dot3(x, w) / length), (float)(dot3(y, w) / length),
                        (float)dot3(n, w) };
}

/* Reads lmp_preintegrated_brdf_eval light by light. */
static lmp_rgb read_one(const lmp_preintegrated_brdf *preintegrated, const lmp_surface *s,
                        const lmp_light *lights) {
    const float cosine = (float)dot3(s->view, s->normal);
    const lmp_rgb all = lmp_preintegrated_brdf_ambient(preintegrated, cosine);
    double sum[3] = { 0, 0, 0 };
    for (int i = 0; i < LIGHTS; i++) {
        lmp_cap cap;
        lmp_light_find_cap(&lights[i], s->position, &cap);
        const lmp_rgb value = lmp_preintegrated_brdf_eval(
            preintegrated, cosine, into_frame(s, cap.axis), cap.one_minus_cos);
        sum[0] += (double)(cap.strength.r * value.r + cap.ambient.r * all.r);
        sum[1] += (double)(cap.strength.g * value.g + cap.ambient.g * all.g);
        sum[2] += (double)(cap.strength.b * value.b + cap.ambient.b * all.b);
    }
    return (lmp_rgb) { (float)fmax(sum[0], 0), (float)fmax(sum[1], 0), (float)fmax(sum[2], 0) };
}

static void many_surfaces_are_shaded_like_one(void **state) {
    (void)state;
    static float rgb[4 * SURFACES];
    crowd *c = crowd_create();
    double error = 0, largest = 0;
    shade_crowd(c, SURFACES, rgb);
    for (int i = 0; i < SURFACES; i++) {
        const lmp_shade_settings settings = by_readings(c);
        const lmp_rgb one =
            lmp_shade(&settings, &c->materials[i], &c->surfaces[i], c->lights, LIGHTS);
        assert_memory_equal(&one, rgb + 4 * i, sizeof one);
        if (!c->materials[i].preintegrated || i % 16 == 0)
            continue;
        const lmp_rgb read = read_one(c->materials[i].preintegrated, &c->surfaces[i], c->lights);
        const double off =
            fmax(fabs((double)(read.r - one.r)),
                 fmax(fabs((double)(read.g - one.g)), fabs((double)(read.b - one.b))));
        if (!(off <= error))
            error = off;
        largest = fmax(largest, (double)largest_of(read));
    }
    print_message("%d surfaces against readings of one: %.2g of %.2g\n", SURFACES, error, largest);
    CHECK_WITHIN(error, 1e-4 * largest);
    crowd_free(c);
}

static void every_instruction_set_shades_the_same_bits(void **state) {
    (void)state;
    static float first[4 * SURFACES], rgb[4 * SURFACES];
    crowd *c = crowd_create();
    for (unsigned flag = 1; flag < LMP_CPU_ALL; flag *= 2) {
        if (lmp_cpu_limit(flag) != flag)
            continue;
        for (size_t count = 0; count <= SURFACES; count += count < 36 ? 1 : SURFACES - 36) {
            for (int i = 0; i < 4 * SURFACES; i++)
                rgb[i] = -7;
            shade_crowd(c, count, rgb);
            if (flag == LMP_CPU_SCALAR && count == 0)
                shade_crowd(c, SURFACES, first);
            for (size_t i = 0; i < 4 * SURFACES; i++)
                if (i / 4 < count && i % 4 < 3)
                    assert_memory_equal(&rgb[i], &first[i], sizeof *rgb);
                else
                    assert_true(rgb[i] > -7.5f && rgb[i] < -6.5f);
        }
    }
    lmp_cpu_limit(LMP_CPU_ALL);
    crowd_free(c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ten_materials_match_their_sums_within_the_error),
        cmocka_unit_test(more_bands_and_no_window_match_as_well),
        cmocka_unit_test(a_sharp_lobe_that_fades_near_grazing_matches_as_well),
        cmocka_unit_test(a_table_of_all_orders_and_few_views_matches_as_well),
        cmocka_unit_test(tables_hold_inside_spheres_and_at_their_surface),
        cmocka_unit_test(many_surfaces_are_shaded_like_one),
        cmocka_unit_test(every_instruction_set_shades_the_same_bits),
        cmocka_unit_test(a_larger_error_takes_less_memory),
    };
    cmocka_set_test_filter(getenv("LAMPION_TEST"));
    return cmocka_run_group_tests(tests, NULL, NULL);
}

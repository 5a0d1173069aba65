/* SPDX-License-Identifier: MIT */
/* Shading of many surfaces against shading of one. */
#include "tests/oracle/check.h"

#include <lampion/lampion.h>

#include <math.h>
#include <string.h>

enum { COUNT = 331, LIGHTS = 41 };

/* A vertex and a result as a host may keep them, in arrays of structures. */
typedef struct vertex {
    lmp_surface surface;
    lmp_material material;
} vertex;

static vertex vertices[COUNT];
static lmp_light lights[LIGHTS];

static float between(double a, double b) {
    return (float)check_random_between(a, b);
}

static lmp_rgb color(void) {
    return (lmp_rgb) { between(0, 1), between(0, 1), between(0, 1) };
}

static lmp_vec3 point_within(float size) {
    return (lmp_vec3) { between(-(double)size, (double)size), between(-(double)size, (double)size),
                        between(-(double)size, (double)size) };
}

/* Scatters spheres alone, or lights of all kinds; some spheres contain some of the surfaces. */
static void scatter(bool all_kinds) {
    for (int i = 0; i < COUNT; i++) {
        vertices[i].surface = (lmp_surface) { .position = point_within(1),
                                              .normal = check_random_direction(),
                                              .view = check_random_direction() };
        vertices[i].material = (lmp_material) { .diffuse = color(),
                                                .specular = color(),
                                                .exponent = powf(10, between(0, 3.5)) };
    }
    for (int i = 0; i < LIGHTS; i++) {
        lights[i] = (lmp_light) { .position = point_within(3),
                                  .direction = check_random_direction(),
                                  .radius = between(0.001, 0.8),
                                  .angle = between(0.01, 2.5),
                                  .inner = 0.3f,
                                  .outer = 1.2f,
                                  .radiance = color(),
                                  .ground = color() };
        if (all_kinds)
            lights[i].kind = (lmp_light_kind)(i % 6);
    }
}

static lmp_shade_settings by_readings(const lmp_preintegrated_lobe *lobe) {
    return (lmp_shade_settings) { .method = LMP_SHADE_PREINTEGRATED, .lobe = lobe };
}

static lmp_surfaces interleaved(void) {
    const lmp_surface *s = &vertices[0].surface;
    return (lmp_surfaces) {
        .position = { &s->position.x, &s->position.y, &s->position.z, sizeof(vertex) },
        .normal = { &s->normal.x, &s->normal.y, &s->normal.z, sizeof(vertex) },
        .view = { &s->view.x, &s->view.y, &s->view.z, sizeof(vertex) },
        .material = &vertices[0].material,
        .material_stride = sizeof(vertex),
    };
}

/* Returns the largest difference from the reference, relative to the largest value. */
static double difference(const float *rgb, size_t stride,
                         lmp_rgb (*reference)(const vertex *v, const void *user),
                         const void *user) {
    double largest = 0, error = 0;
    for (int i = 0; i < COUNT; i++) {
        const lmp_rgb c = reference(&vertices[i], user);
        const float expected[3] = { c.r, c.g, c.b };
        for (size_t k = 0; k < 3; k++) {
            const double d = fabs((double)rgb[(size_t)i * stride + k] - (double)expected[k]);
            if (!(d <= error))
                error = d;
            largest = fmax(largest, (double)expected[k]);
        }
    }
    return error / largest;
}

static lmp_rgb by_bands(const vertex *v, const void *settings) {
    return lmp_shade(settings, &v->material, &v->surface, lights, LIGHTS);
}

/* Shades by lmp_preintegrated_lobe_eval and lmp_light_irradiance, light by light. */
static lmp_rgb by_lobe_table(const vertex *v, const void *lobe) {
    const float pi = 3.14159265f;
    const lmp_vec3 n = v->surface.normal, e = v->surface.view;
    const float twice = 2 * (n.x * e.x + n.y * e.y + n.z * e.z);
    const lmp_vec3 r = { twice * n.x - e.x, twice * n.y - e.y, twice * n.z - e.z };
    double sum[3] = { 0, 0, 0 };
    for (int i = 0; i < LIGHTS; i++) {
        lmp_cap cap;
        lmp_light_find_cap(&lights[i], v->surface.position, &cap);
        const lmp_vec3 w = cap.axis;
        const lmp_rgb facing = lmp_light_irradiance(&lights[i], 1, v->surface.position, n);
        const float specular = lmp_preintegrated_lobe_eval(
            lobe, v->material.exponent, cap.one_minus_cos, r.x * w.x + r.y * w.y + r.z * w.z);
        const lmp_rgb d = v->material.diffuse, s = v->material.specular;
        sum[0] += (double)(d.r * facing.r / pi + s.r * (cap.strength.r * specular + cap.ambient.r));
        sum[1] += (double)(d.g * facing.g / pi + s.g * (cap.strength.g * specular + cap.ambient.g));
        sum[2] += (double)(d.b * facing.b / pi + s.b * (cap.strength.b * specular + cap.ambient.b));
    }
    return (lmp_rgb) { (float)fmax(sum[0], 0), (float)fmax(sum[1], 0), (float)fmax(sum[2], 0) };
}

/* Returns v mirrored about a unit axis. */
static lmp_vec3 across(lmp_vec3 axis, lmp_vec3 v) {
    const float twice = 2 * (axis.x * v.x + axis.y * v.y + axis.z * v.z);
    return (lmp_vec3) { twice * axis.x - v.x, twice * axis.y - v.y, twice * axis.z - v.z };
}

/* Rotates every surface's view so that a light lies within `width` of its mirror direction. */
static void face_highlight(const lmp_light *light, float width) {
    for (int i = 0; i < COUNT; i++) {
        lmp_surface *surface = &vertices[i].surface;
        const lmp_vec3 off = check_random_direction();
        lmp_cap cap;
        lmp_light_find_cap(light, surface->position, &cap);
        const float part = between(0, (double)width);
        const lmp_vec3 w = { cap.axis.x + part * off.x, cap.axis.y + part * off.y,
                             cap.axis.z + part * off.z };
        const float length = sqrtf(w.x * w.x + w.y * w.y + w.z * w.z);
        surface->view =
            across(surface->normal, (lmp_vec3) { w.x / length, w.y / length, w.z / length });
    }
}

/* Adds the bounds of shade.h for each light: fractions of the most it can give there, with both
 * lobes pointing at it. */
static void add_bounds(const lmp_shade_settings *settings, const vertex *v, const lmp_light *light,
                       double sum[3]) {
    const lmp_surface *s = &v->surface;
    const int n = settings->bands;
    lmp_material diffuse_only = v->material, specular_only = v->material;
    diffuse_only.specular = specular_only.diffuse = (lmp_rgb) { 0, 0, 0 };
    lmp_cap cap;
    lmp_light_find_cap(light, s->position, &cap);
    lmp_light moved = { .kind = LMP_LIGHT_DIRECTIONAL, .direction = s->normal };
    float scale = 1;
    if (cap.sin2 > 0) {
        moved.kind = LMP_LIGHT_CAP;
        moved.angle = asinf(fminf(sqrtf(cap.sin2), 1));
        scale = 1 / (3.14159265f * cap.sin2);
    }
    moved.radiance = (lmp_rgb) { fabsf(cap.strength.r) * scale, fabsf(cap.strength.g) * scale,
                                 fabsf(cap.strength.b) * scale };
    const lmp_rgb diffuse = lmp_shade(settings, &diffuse_only, s, &moved, 1);
    moved.direction = across(s->normal, s->view);
    const lmp_rgb specular = lmp_shade(settings, &specular_only, s, &moved, 1);
    const lmp_rgb d = v->material.diffuse, e = v->material.specular;
    const bool touches = light->kind == LMP_LIGHT_SPHERE && cap.one_minus_cos > 0.95f;
    const double bound = touches ? 5e-4 : 3e-6 + 2e-7 * n * n;
    sum[0] += bound * (double)(diffuse.r + specular.r + (d.r + e.r) * cap.ambient.r);
    sum[1] += bound * (double)(diffuse.g + specular.g + (d.g + e.g) * cap.ambient.g);
    sum[2] += bound * (double)(diffuse.b + specular.b + (d.b + e.b) * cap.ambient.b);
}

/* Returns the largest difference from lmp_shade, relative to the bound of shade.h. */
static double fraction_of_bound(const lmp_shade_settings *settings, const lmp_light *from,
                                size_t count, const float *rgb, size_t stride) {
    double fraction = 0;
    for (size_t i = 0; i < COUNT; i++) {
        const vertex *v = &vertices[i];
        const lmp_rgb c = lmp_shade(settings, &v->material, &v->surface, from, count);
        double bounds[3] = { 0, 0, 0 };
        for (size_t k = 0; k < count; k++)
            add_bounds(settings, v, &from[k], bounds);
        const float expected[3] = { c.r, c.g, c.b };
        for (size_t k = 0; k < 3; k++) {
            const double d = fabs((double)rgb[i * stride + k] - (double)expected[k]);
            if (!(d <= fraction * bounds[k]))
                fraction = d / bounds[k];
        }
    }
    return fraction;
}

static void many_surfaces_are_shaded_as_one_is(void **state) {
    (void)state;
    static float rgb[COUNT * 4];
    const lmp_surfaces surfaces = interleaved();
    const int bands[] = { 1, 2, 3, 8, 9, 20, 47, 48, 49, 100, 128 };
    for (size_t b = 0; b < sizeof bands / sizeof bands[0]; b++) {
        for (int kinds = 0; kinds < 2; kinds++) {
            scatter(kinds != 0);
            const lmp_shade_settings settings = { .bands = bands[b],
                                                  .window = (lmp_window)(b % 3) };
            lmp_shade_n(&settings, &surfaces, COUNT, lights, LIGHTS,
                        (lmp_rgb_array) { rgb, 4 * sizeof *rgb });
            CHECK_WITHIN(fraction_of_bound(&settings, lights, LIGHTS, rgb, 4), 1);
            for (int i = 0; i < 6; i++) {
                lights[i].radius *= i % 2 ? 0.01f : 1;
                face_highlight(&lights[i], 4.0f / (float)bands[b]);
                lmp_shade_n(&settings, &surfaces, COUNT, &lights[i], 1,
                            (lmp_rgb_array) { rgb, 4 * sizeof *rgb });
                CHECK_WITHIN(fraction_of_bound(&settings, &lights[i], 1, rgb, 4), 1);
            }
        }
    }
}

/* Returns a light of size 0, at a distance d if it has a position, that gives surfaces at the
 * origin a strength; a spot's light arrives undimmed. */
static lmp_light dirac_of(lmp_light_kind kind, float d, float strength) {
    const lmp_vec3 w = check_random_direction();
    const float held = kind == LMP_LIGHT_DIRECTIONAL ? 1 : fmaxf(d, LMP_POINT_DISTANCE_MIN);
    const float each = strength * held * held;
    return (lmp_light) { .kind = kind,
                         .position = { d * w.x, d * w.y, d * w.z },
                         .direction = kind == LMP_LIGHT_SPOT ? (lmp_vec3) { -w.x, -w.y, -w.z } : w,
                         .inner = 1,
                         .outer = 1.5f,
                         .intensity = { each, each, each } };
}

static void lights_without_size_are_so_at_any_distance_and_strength(void **state) {
    (void)state;
    static float rgb[COUNT * 3];
    const lmp_surfaces surfaces = interleaved();
    const float distances[] = { 1e-7f, 1e-5f, 1e-3f, 1, 1e6f, 1e15f };
    const int bands[] = { 1, 10, 20, 128 };
    scatter(false);
    for (int i = 0; i < COUNT; i++) {
        vertices[i].surface.position = (lmp_vec3) { 0, 0, 0 };
        vertices[i].material.exponent = 1e4f;
    }
    for (int k = 0; k < 72; k++) {
        const float d = distances[k / 4 % 6], strength = d < 1e6f ? 1e30f : 1e5f;
        const lmp_light light = dirac_of((lmp_light_kind)(LMP_LIGHT_POINT + k / 24), d, strength);
        const lmp_shade_settings settings = { .bands = bands[k % 4] };
        face_highlight(&light, 4.0f / (float)bands[k % 4]);
        lmp_shade_n(&settings, &surfaces, COUNT, &light, 1, (lmp_rgb_array) { rgb, 0 });
        CHECK_WITHIN(fraction_of_bound(&settings, &light, 1, rgb, 3), 1);
    }
}

static void lights_without_size_are_read_from_a_preintegrated_lobe_as_they_are(void **state) {
    (void)state;
    static float rgb[COUNT * 3];
    const lmp_surfaces surfaces = interleaved();
    const float distances[] = { 1e-7f, 1e-5f, 1, 1e15f };
    const lmp_preintegrated_lobe_desc desc = { .bands = 20 };
    const lmp_shade_settings settings = { .bands = desc.bands };
    lmp_preintegrated_lobe *lobe;
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &lobe), LMP_OK);
    const lmp_shade_settings readings = by_readings(lobe);
    scatter(false);
    for (int i = 0; i < COUNT; i++)
        vertices[i].surface.position = (lmp_vec3) { 0, 0, 0 };
    for (int k = 0; k < 12; k++) {
        lights[0] = dirac_of((lmp_light_kind)(LMP_LIGHT_POINT + k / 4), distances[k % 4], 1);
        for (int i = 1; i < LIGHTS; i++) {
            lights[i] = lights[0];
            lights[i].intensity = (lmp_rgb) { 0, 0, 0 };
        }
        face_highlight(&lights[0], 0.3f);
        lmp_shade_n(&readings, &surfaces, COUNT, lights, LIGHTS, (lmp_rgb_array) { rgb, 0 });
        CHECK_WITHIN(difference(rgb, 3, by_lobe_table, lobe), 1e-4);
        CHECK_WITHIN(difference(rgb, 3, by_bands, &settings), 2e-2);
    }
    lmp_preintegrated_lobe_destroy(lobe);
}

static void many_surfaces_are_read_from_a_preintegrated_lobe_as_one_is(void **state) {
    (void)state;
    static float rgb[COUNT * 3];
    const lmp_surfaces surfaces = interleaved();
    const int bands[] = { 1, 2, 8, 50 };
    for (size_t b = 0; b < sizeof bands / sizeof bands[0]; b++) {
        lmp_preintegrated_lobe *lobe;
        const lmp_preintegrated_lobe_desc desc = { .bands = bands[b] };
        const lmp_shade_settings settings = { .bands = bands[b] };
        assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &lobe), LMP_OK);
        for (int kinds = 0; kinds < 2; kinds++) {
            scatter(kinds != 0);
            const lmp_shade_settings readings = by_readings(lobe);
            lmp_shade_n(&readings, &surfaces, COUNT, lights, LIGHTS, (lmp_rgb_array) { rgb, 0 });
            CHECK_WITHIN(difference(rgb, 3, by_lobe_table, lobe), kinds ? 5e-4 : 1e-4);
            /* The largest value may miss the peak of a light, to which the error is relative. */
            CHECK_WITHIN(difference(rgb, 3, by_bands, &settings), 2e-2);
        }
        lmp_preintegrated_lobe_destroy(lobe);
    }
}

/* Every third surface is glTF's, so that runs of both kinds alternate. */
static void scatter_both_kinds(void) {
    scatter(true);
    for (int i = 0; i < COUNT; i += 3)
        vertices[i].material = (lmp_material) { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                                .base_color = color(),
                                                .metallic = between(0, 1),
                                                .roughness = between(0.1, 1) };
    for (int i = 0; i < COUNT; i += 6)
        vertices[i].material.dielectric =
            lmp_material_dielectric(between(1, 3), between(0, 1), color());
}

static void both_kinds_of_lobes_are_shaded_side_by_side(void **state) {
    (void)state;
    static float rgb[COUNT * 3];
    const lmp_surfaces surfaces = interleaved();
    const int bands[] = { 1, 2, 10, 11, 60 };
    for (int b = 0; b < 5; b++) {
        const lmp_shade_settings settings = { .bands = bands[b] };
        scatter_both_kinds();
        lmp_shade_n(&settings, &surfaces, COUNT, lights, LIGHTS, (lmp_rgb_array) { rgb, 0 });
        CHECK_WITHIN(difference(rgb, 3, by_bands, &settings), 5e-4);
    }
}

static void every_instruction_set_gives_the_same_bits(void **state) {
    (void)state;
    static float first[2][COUNT * 3], rgb[2][COUNT * 3];
    const lmp_surfaces surfaces = interleaved();
    lmp_preintegrated_lobe *lobe;
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, NULL, &lobe), LMP_OK);
    scatter_both_kinds();
    for (unsigned flag = 1; flag < LMP_CPU_ALL; flag *= 2) {
        if (lmp_cpu_limit(flag) != flag)
            continue;
        lmp_shade_n(NULL, &surfaces, COUNT, lights, LIGHTS, (lmp_rgb_array) { rgb[0], 0 });
        const lmp_shade_settings readings = by_readings(lobe);
        lmp_shade_n(&readings, &surfaces, COUNT, lights, LIGHTS, (lmp_rgb_array) { rgb[1], 0 });
        if (flag == LMP_CPU_SCALAR)
            memcpy(first, rgb, sizeof rgb);
        assert_memory_equal(first, rgb, sizeof rgb);
    }
    lmp_cpu_limit(LMP_CPU_ALL);
    lmp_preintegrated_lobe_destroy(lobe);
}

/* The lanes may be surfaces of a chunk, or a few of them side by side; of many materials, or of
 * one, whose factors a block takes over from the one before. */
static void few_lights_give_a_surface_the_same_bits_in_any_company(void **state) {
    (void)state;
    static float first[COUNT * 3], rgb[COUNT * 3], alone[3];
    const int bands[] = { 1, 4, 10, 11, 49, 128 };
    const lmp_material same = { .diffuse = color(), .specular = color(), .exponent = 20 };
    scatter_both_kinds();
    for (size_t run = 0; run < 9 * 6 * 2; run++)
        for (unsigned flag = 1; flag < LMP_CPU_ALL; flag *= 2) {
            const size_t count = 1 + run % 9, i = 7 * run % COUNT;
            const lmp_shade_settings settings = { .bands = bands[run / 9 % 6] };
            const lmp_surface *s = &vertices[i].surface;
            lmp_surfaces surfaces = interleaved();
            if (lmp_cpu_limit(flag) != flag)
                continue;
            if (run >= 9 * 6) {
                surfaces.material = &same;
                surfaces.material_stride = 0;
            }
            lmp_shade_n(&settings, &surfaces, COUNT, lights, count, (lmp_rgb_array) { rgb, 0 });
            if (flag == LMP_CPU_SCALAR)
                memcpy(first, rgb, sizeof rgb);
            assert_memory_equal(first, rgb, sizeof rgb);
            surfaces.position = lmp_vec3_array_same(&s->position);
            surfaces.normal = lmp_vec3_array_same(&s->normal);
            surfaces.view = lmp_vec3_array_same(&s->view);
            if (surfaces.material_stride)
                surfaces.material = &vertices[i].material;
            lmp_shade_n(&settings, &surfaces, 1, lights, count, (lmp_rgb_array) { alone, 0 });
            assert_memory_equal(alone, &rgb[3 * i], sizeof alone);
        }
    lmp_cpu_limit(LMP_CPU_ALL);
}

/* Surfaces of which none has a highlight are shaded without Phong lobes; one that has, in a single
 * color, is enough for all beside it to have theirs. */
static void matte_surfaces_have_the_same_bits_in_any_company(void **state) {
    (void)state;
    static float matte[COUNT * 3], mixed[COUNT * 3];
    const int bands[] = { 1, 6, 10, 49, 128 };
    const size_t light_counts[] = { 1, 3, 7, LIGHTS };
    const lmp_surfaces surfaces = interleaved();
    for (size_t run = 0; run < 5 * 4 * 3; run++) {
        const lmp_shade_settings settings = { .bands = bands[run % 5] };
        const size_t count = light_counts[run / 5 % 4], channel = run / 20;
        const float one = 0.5f * (float)(channel == 0), two = 0.5f * (float)(channel == 1),
                    three = 0.5f * (float)(channel == 2);
        size_t changed = 0;
        scatter(true);
        for (int i = 0; i < COUNT; i++)
            vertices[i].material.specular = (lmp_rgb) { 0, 0, 0 };
        lmp_shade_n(&settings, &surfaces, COUNT, lights, count, (lmp_rgb_array) { matte, 0 });
        if (count == LIGHTS)
            CHECK_WITHIN(difference(matte, 3, by_bands, &settings), 1e-5);
        for (int i = 29; i < COUNT; i += 30)
            vertices[i].material.specular = (lmp_rgb) { one, two, three };
        lmp_shade_n(&settings, &surfaces, COUNT, lights, count, (lmp_rgb_array) { mixed, 0 });
        for (size_t i = 0; i < COUNT; i++) {
            const int same = memcmp(&matte[3 * i], &mixed[3 * i], 3 * sizeof *matte) == 0;
            assert_true(same || i % 30 == 29);
            changed += !same;
        }
        assert_true(changed > 0);
    }
}

static void any_count_and_any_stride_writes_only_its_own(void **state) {
    (void)state;
    static float whole[COUNT * 3], some[COUNT * 5];
    const lmp_surfaces surfaces = interleaved();
    scatter(true);
    lmp_shade_n(NULL, &surfaces, COUNT, lights, LIGHTS, (lmp_rgb_array) { whole, 0 });
    for (size_t count = 0; count < 40; count++) {
        for (size_t i = 0; i < COUNT * 5; i++)
            some[i] = -7;
        lmp_shade_n(NULL, &surfaces, count, lights, LIGHTS,
                    (lmp_rgb_array) { some, 5 * sizeof *some });
        for (size_t i = 0; i < COUNT * 5; i++)
            if (i / 5 < count && i % 5 < 3)
                assert_memory_equal(&some[i], &whole[i / 5 * 3 + i % 5], sizeof(float));
            else
                assert_true(some[i] > -7.5f && some[i] < -6.5f);
    }
    lmp_shade_n(NULL, &surfaces, 2, NULL, 0, (lmp_rgb_array) { some, 0 });
    for (int i = 0; i < 6; i++)
        CHECK_WITHIN(fabsf(some[i]), 0);
}

/* A surface with NaN gets any color, and the others the usual ones. */
static void not_a_number_stays_with_its_surface(void **state) {
    (void)state;
    static float whole[COUNT * 3], rgb[COUNT * 3];
    const lmp_surfaces surfaces = interleaved();
    if (CHECK_ASSERTS) {
        check_skip("this build asserts its preconditions");
        return;
    }
    for (int bands = 1; bands <= 20; bands++) {
        const lmp_preintegrated_lobe_desc desc = { .bands = bands, .error = 0.05f };
        const lmp_shade_settings settings = { .bands = bands };
        lmp_preintegrated_lobe *lobe;
        assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &lobe), LMP_OK);
        const lmp_shade_settings readings = by_readings(lobe);
        for (int method = 0; method < 2; method++) {
            scatter(true);
            float *const to[2] = { whole, rgb };
            for (int pass = 0; pass < 2; pass++) {
                lmp_shade_n(method ? &readings : &settings, &surfaces, COUNT, lights, LIGHTS,
                            (lmp_rgb_array) { to[pass], 0 });
                vertices[3].surface.position.y = NAN;
                vertices[40].surface.normal.x = NAN;
                vertices[77].surface.view.z = NAN;
            }
            for (int i = 0; i < COUNT; i++)
                if (i != 3 && i != 40 && i != 77)
                    assert_memory_equal(&rgb[3 * i], &whole[3 * i], 3 * sizeof *rgb);
        }
        scatter(true);
        lights[0].radius = lights[6].position.x = NAN;
        lmp_shade_n(&readings, &surfaces, COUNT, lights, LIGHTS, (lmp_rgb_array) { rgb, 0 });
        lmp_preintegrated_lobe_destroy(lobe);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_surfaces_are_shaded_as_one_is),
        cmocka_unit_test(lights_without_size_are_so_at_any_distance_and_strength),
        cmocka_unit_test(lights_without_size_are_read_from_a_preintegrated_lobe_as_they_are),
        cmocka_unit_test(many_surfaces_are_read_from_a_preintegrated_lobe_as_one_is),
        cmocka_unit_test(both_kinds_of_lobes_are_shaded_side_by_side),
        cmocka_unit_test(every_instruction_set_gives_the_same_bits),
        cmocka_unit_test(few_lights_give_a_surface_the_same_bits_in_any_company),
        cmocka_unit_test(matte_surfaces_have_the_same_bits_in_any_company),
        cmocka_unit_test(not_a_number_stays_with_its_surface),
        cmocka_unit_test(any_count_and_any_stride_writes_only_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT */
#include "tests/oracle/crowd.h"

#include "tests/oracle/check.h"

#include <math.h>
#include <string.h>

static lmp_rgb random_color(void) {
    return (lmp_rgb) { (float)check_random(), (float)check_random(), (float)check_random() };
}

void crowd_make(crowd *c) {
    memset(c, 0, sizeof *c);
    for (int i = 0; i < CROWD_COUNT; i++) {
        c->at[i] =
            (lmp_surface) { .normal = check_random_direction(), .view = check_random_direction() };
        c->at[i].coat_normal = i % 2 ? check_random_direction() : c->at[i].normal;
        c->material[i] = (lmp_material) { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                          .base_color = random_color(),
                                          .metallic = 0.5f,
                                          .roughness = (float)check_random() };
    }
    for (int i = 0; i < CROWD_LIGHTS; i++) {
        const lmp_vec3 to = check_random_direction();
        c->lights[i] = (lmp_light) { .position = { 3 * to.x, 3 * to.y, 3 * to.z },
                                     .radius = 0.5f,
                                     .radiance = random_color() };
    }
    for (size_t i = 0; i < sizeof c->sh / sizeof *c->sh; i++)
        c->sh[i] = (float)check_random_between(0, 0.1);
    c->sh[0] = c->sh[36] = c->sh[72] = 1;
}

lmp_rgb crowd_shade_one(const crowd *c, int i, bool environment) {
    const lmp_environment around = { c->sh, 6 };
    return environment ? lmp_shade_environment(NULL, &c->material[i], &c->at[i], &around)
                       : lmp_shade(NULL, &c->material[i], &c->at[i], c->lights, CROWD_LIGHTS);
}

/* The output has a stride wider than a color. */
static void check_many(const crowd *c, bool environment) {
    const lmp_surface *at = c->at;
    const size_t stride = sizeof *at;
    const lmp_surfaces all = {
        .position = { &at->position.x, &at->position.y, &at->position.z, stride },
        .normal = { &at->normal.x, &at->normal.y, &at->normal.z, stride },
        .view = { &at->view.x, &at->view.y, &at->view.z, stride },
        .material = c->material,
        .material_stride = sizeof *c->material,
        .coat_normal = { &at->coat_normal.x, &at->coat_normal.y, &at->coat_normal.z, stride }
    };
    const lmp_environment around = { c->sh, 6 };
    float rgb[4 * CROWD_COUNT];
    if (environment)
        lmp_shade_environment_n(NULL, &all, CROWD_COUNT, &around,
                                (lmp_rgb_array) { rgb, 4 * sizeof *rgb });
    else
        lmp_shade_n(NULL, &all, CROWD_COUNT, c->lights, CROWD_LIGHTS,
                    (lmp_rgb_array) { rgb, 4 * sizeof *rgb });
    for (int i = 0; i < CROWD_COUNT; i++) {
        const lmp_rgb one = crowd_shade_one(c, i, environment);
        CHECK_WITHIN(fabs((double)rgb[4 * i] - (double)one.r), 3e-5);
        CHECK_WITHIN(fabs((double)rgb[4 * i + 1] - (double)one.g), 3e-5);
        CHECK_WITHIN(fabs((double)rgb[4 * i + 2] - (double)one.b), 3e-5);
    }
}

void crowd_check_many(const crowd *c) {
    check_many(c, false);
    check_many(c, true);
}

/* Removes the diffuse lobe, which coefficients truncate. */
static lmp_material without_diffuse(lmp_material material) {
    if (material.kind == LMP_MATERIAL_METALLIC_ROUGHNESS)
        material.metallic = 1;
    else
        material.diffuse = (lmp_rgb) { 0, 0, 0 };
    return material;
}

void crowd_check_methods(const crowd *c, double bound) {
    lmp_preintegrated_lobe *lobe;
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, NULL, &lobe), LMP_OK);
    for (int i = 0; i < CROWD_COUNT; i++) {
        lmp_rgb by[LMP_SHADE_METHOD_COUNT];
        const lmp_material material = without_diffuse(c->material[i]);
        for (int method = 0; method < LMP_SHADE_METHOD_COUNT; method++) {
            const lmp_shade_settings settings = { .method = (lmp_shade_method)method,
                                                  .lobe = lobe };
            by[method] = lmp_shade(&settings, &material, &c->at[i], c->lights, CROWD_LIGHTS);
        }
        for (int method = 1; method < LMP_SHADE_METHOD_COUNT; method++)
            CHECK_WITHIN(fabs((double)by[method].r - (double)by[0].r),
                         method == LMP_SHADE_COEFFICIENTS ? 1e-5 : bound);
    }
    lmp_preintegrated_lobe_destroy(lobe);
}

/* SPDX-License-Identifier: MIT */
/* Surfaces under lights that are areas: every method shades them by what the lights are. */
#include "tests/oracle/areas.h"

enum { BANDS = 10, COUNT = BANDS * BANDS };

/* A light, and a surface that it may or may not shine on. */
typedef struct lit_surface {
    lmp_light light;
    lmp_surface surface;
} lit_surface;

static lit_surface random_surface(lmp_light_kind kind) {
    const random_area a = area_random(kind);
    lit_surface lit = { a.light,
                        { .position = area_point(&a), .normal = check_random_direction() } };
    do
        lit.surface.view = check_random_direction();
    while (lit.surface.view.x * lit.surface.normal.x + lit.surface.view.y * lit.surface.normal.y +
               lit.surface.view.z * lit.surface.normal.z <
           0.05f);
    return lit;
}

static lmp_rgb shaded_n(const lmp_shade_settings *settings, const lmp_material *material,
                        const lit_surface *lit) {
    const lmp_surface *s = &lit->surface;
    const lmp_surfaces surfaces = { .position = lmp_vec3_array_same(&s->position),
                                    .normal = lmp_vec3_array_same(&s->normal),
                                    .view = lmp_vec3_array_same(&s->view),
                                    .material = material };
    lmp_rgb rgb[3];
    lmp_shade_n(settings, &surfaces, 3, &lit->light, 1, lmp_rgb_array_of(rgb));
    assert_memory_equal(&rgb[0], &rgb[2], sizeof *rgb);
    return rgb[1];
}

static void check_same(lmp_rgb a, lmp_rgb b, double bound) {
    CHECK_WITHIN(fabs((double)a.r - (double)b.r), bound);
    CHECK_WITHIN(fabs((double)a.g - (double)b.g), bound);
    CHECK_WITHIN(fabs((double)a.b - (double)b.b), bound);
}

/* Lobes by coefficients, by zonal sums of one surface and of many, and beside preintegrated ones.
 */
static void every_method_shades_lobes_alike(void **state) {
    (void)state;
    const lmp_material materials[] = {
        { .specular = { 0.5f, 1, 0.25f }, .exponent = 30 },
        { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
          .base_color = { 0.5f, 1, 0.25f },
          .metallic = 1,
          .roughness = 0.4f,
          .coat = { 0.5f, 0.3f } },
    };
    lmp_preintegrated_lobe *lobe;
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, NULL, &lobe), LMP_OK);
    const lmp_shade_settings coefficients = { .method = LMP_SHADE_COEFFICIENTS },
                             read = { .method = LMP_SHADE_PREINTEGRATED, .lobe = lobe };
    for (int i = 0; i < 100; i++) {
        const lit_surface lit = random_surface(area_kinds[i % AREA_KINDS]);
        const lmp_material *m = &materials[i / AREA_KINDS % 2];
        const lmp_rgb zonal = lmp_shade(NULL, m, &lit.surface, &lit.light, 1);
        check_same(zonal, lmp_shade(&coefficients, m, &lit.surface, &lit.light, 1), 5e-6);
        check_same(zonal, shaded_n(NULL, m, &lit), 1e-6);
        check_same(zonal, shaded_n(&read, m, &lit), 1e-6);
    }
    lmp_preintegrated_lobe_destroy(lobe);
}

static void neighbors_of_other_materials_are_shaded_alone(void **state) {
    (void)state;
    enum { SURFACES = 40 };
    static lmp_material materials[SURFACES];
    static lmp_vec3 positions[SURFACES];
    static lmp_rgb rgb[SURFACES];
    const lmp_vec3 normal = { 0, 0, -1 }, view = { 0, 0.6f, -0.8f };
    const lmp_light light = area_square(true);
    for (int i = 0; i < SURFACES; i++) {
        positions[i] = (lmp_vec3) { 0.1f * (float)i - 2, -1, 2 };
        materials[i] =
            (lmp_material) { .specular = { 1, 1, 1 }, .exponent = 10 + (float)(i / 3 * 5 % 7) };
    }
    const lmp_surfaces surfaces = { .position = lmp_vec3_array_of(positions),
                                    .normal = lmp_vec3_array_same(&normal),
                                    .view = lmp_vec3_array_same(&view),
                                    .material = materials,
                                    .material_stride = sizeof *materials };
    lmp_shade_n(NULL, &surfaces, SURFACES, &light, 1, lmp_rgb_array_of(rgb));
    for (int i = 0; i < SURFACES; i++) {
        const lmp_surface one = { .position = positions[i], .normal = normal, .view = view };
        check_same(lmp_shade(NULL, &materials[i], &one, &light, 1), rgb[i], 1e-6);
    }
}

static void white_paper_reflects_the_irradiance(void **state) {
    (void)state;
    const lmp_material paper = { .diffuse = { 1, 1, 1 } };
    for (int i = 0; i < 100; i++) {
        const lit_surface lit = random_surface(area_kinds[i % AREA_KINDS]);
        const lmp_rgb e =
            lmp_light_irradiance(&lit.light, 1, lit.surface.position, lit.surface.normal);
        const lmp_rgb one = lmp_shade(NULL, &paper, &lit.surface, &lit.light, 1);
        CHECK_WITHIN(fabs((double)one.g * ORACLE_PI - (double)e.g), 1e-6);
        check_same(one, shaded_n(NULL, &paper, &lit), 1e-6);
    }
}

/* A table sums coefficients in the frame of the view: the sum that it makes of an environment with
 * the light's coefficients. */
static void a_table_reflects_the_coefficients(void **state) {
    (void)state;
    lmp_brdf *ggx;
    lmp_brdf_table *table;
    const lmp_ggx values = { .alpha_x = 0.25f, .diffuse = { 0.2f, 0.3f, 0.4f } };
    const lmp_brdf_table_desc desc = { .bands = BANDS, .views = 8 };
    assert_int_equal(lmp_brdf_create_ggx(NULL, &values, &ggx), LMP_OK);
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, ggx, &table), LMP_OK);
    const lmp_material material = { .kind = LMP_MATERIAL_TABLE, .table = table };
    for (int i = 0; i < 100; i++) {
        const lit_surface lit = random_surface(area_kinds[i % AREA_KINDS]);
        float sh[3 * COUNT];
        const lmp_environment environment = { sh, BANDS };
        lmp_light_project(BANDS, &lit.light, 1, lit.surface.position, sh);
        check_same(lmp_shade(NULL, &material, &lit.surface, &lit.light, 1),
                   lmp_shade_environment(NULL, &material, &lit.surface, &environment), 5e-6);
    }
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(ggx);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_shades_lobes_alike),
        cmocka_unit_test(neighbors_of_other_materials_are_shaded_alone),
        cmocka_unit_test(white_paper_reflects_the_irradiance),
        cmocka_unit_test(a_table_reflects_the_coefficients),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT */
/* Surfaces under lights that are areas: every method shades them by what the lights are. */
#include "tests/oracle/areas.h"

enum { BANDS = 10, COUNT = BANDS * BANDS };

static const lmp_material paper = { .diffuse = { 1, 1, 1 } };

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

/* --- many surfaces under an area ---------------------------------------------------------------
 */

enum { MANY = 35 };

/* Surfaces at all distances from a light, shaded together, of a matte and of a glossy material. */
typedef struct many_surfaces {
    random_area area;
    lmp_vec3 position[MANY], normal[MANY], view[MANY];
    lmp_rgb matte[MANY], glossy[MANY];
} many_surfaces;

static lmp_material glossy_of(float exponent) {
    return (lmp_material) { .specular = { 1, 1, 1 }, .exponent = exponent };
}

static void shade_some(int bands, const lmp_material *material, const many_surfaces *s, int first,
                       int count, lmp_rgb *rgb) {
    const lmp_shade_settings settings = { .bands = bands };
    const lmp_surfaces surfaces = { .position = lmp_vec3_array_of(s->position + first),
                                    .normal = lmp_vec3_array_of(s->normal + first),
                                    .view = lmp_vec3_array_of(s->view + first),
                                    .material = material };
    lmp_shade_n(&settings, &surfaces, (size_t)count, &s->area.light, 1, lmp_rgb_array_of(rgb));
}

static void shade_many(lmp_light_kind kind, int bands, const lmp_material *glossy,
                       many_surfaces *s) {
    s->area = area_random(kind);
    /* outside a tube, which is one thing from within and another from without */
    const double from = kind == LMP_LIGHT_TUBE ? s->area.size + (double)s->area.light.radius : 0;
    for (int i = 0; i < MANY; i++) {
        const double distance = from + s->area.size * pow(10, check_random_between(-1, 3.5));
        s->position[i] = i % 2
                             ? area_point(&s->area)
                             : area_sum(s->area.light.position, distance, check_random_direction());
        s->normal[i] = check_random_direction();
        s->view[i] = check_random_direction();
    }
    shade_some(bands, &paper, s, 0, MANY, s->matte);
    shade_some(bands, glossy, s, 0, MANY, s->glossy);
}

/* Returns the error of the matte material, in parts of what one that faces the light reflects. */
static double matte_error(const many_surfaces *s, int i) {
    double facing[4], most = 0;
    const double p[3] = { (double)s->position[i].x, (double)s->position[i].y,
                          (double)s->position[i].z };
    double n[3] = { (double)s->normal[i].x, (double)s->normal[i].y, (double)s->normal[i].z };
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        n[k] /= length;
    oracle_area_project(&s->area.light, p, 2, facing);
    for (int k = 1; k < 4; k++)
        most += facing[k] * facing[k] * (4 * ORACLE_PI / 3);
    const double expected = oracle_area_irradiance(&s->area.light, p, n);
    const double error = fabs((double)s->matte[i].g * ORACLE_PI - expected);
    return most > 0 ? error / sqrt(most) : error;
}

/* Returns the error of the glossy material, in parts of the most that it can reflect. */
static double glossy_error(const many_surfaces *s, int bands, float exponent, int i) {
    double lambda[LMP_BANDS_MAX], moments[LMP_BANDS_MAX], q[3], expected = 0, most = 0;
    const double p[3] = { (double)s->position[i].x, (double)s->position[i].y,
                          (double)s->position[i].z };
    const double n[3] = { (double)s->normal[i].x, (double)s->normal[i].y, (double)s->normal[i].z };
    const double v[3] = { (double)s->view[i].x, (double)s->view[i].y, (double)s->view[i].z };
    const double along = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
    double length = 0;
    for (int k = 0; k < 3; k++) {
        q[k] = 2 * along * n[k] - v[k];
        length += q[k] * q[k];
    }
    for (int k = 0; k < 3; k++)
        q[k] /= sqrt(length);
    oracle_area_moments(&s->area.light, p, bands, q, moments);
    oracle_lobe_phong(bands, (double)exponent, lambda);
    for (int l = 0; l < bands; l++) {
        const double weight = (2 * l + 1) / (4 * ORACLE_PI) * lambda[l];
        expected += weight * moments[l];
        most += weight * moments[0];
    }
    const double error = fabs((double)s->glossy[i].g - fmax(expected, 0));
    return most > 0 ? error / most : error;
}

/* Surfaces far and near, together, against quadrature over the light. */
static void check_many(int bands, int count, double matte_bound, double glossy_bound) {
    static many_surfaces s;
    for (int k = 0; k < AREA_KINDS; k++) {
        double matte = 0, glossy = 0;
        for (int j = 0; j < count; j++) {
            const float exponent = (float)pow(10, check_random_between(0, 3));
            const lmp_material material = glossy_of(exponent);
            shade_many(area_kinds[k], bands, &material, &s);
            for (int i = 0; i < MANY; i++) {
                const double errors[2] = { matte_error(&s, i),
                                           glossy_error(&s, bands, exponent, i) };
                matte = errors[0] <= matte ? matte : errors[0];
                glossy = errors[1] <= glossy ? glossy : errors[1];
            }
        }
        printf("%s, %d bands: matte at most %.2g, glossy %.2g\n", area_names[k], bands, matte,
               glossy);
        CHECK_WITHIN(matte, matte_bound);
        CHECK_WITHIN(glossy, glossy_bound);
    }
}

static void many_surfaces_reflect_the_integral_over_the_area(void **state) {
    (void)state;
    check_many(BANDS, check_count(1, 60), 1e-5, 1e-5);
    check_many(48, check_count(1, 6), 1e-5, 1e-4);
}

/* Lobes that are narrower than the distance from node to node of the edge. */
static void sharp_lobes_see_the_edge_of_a_wide_disk(void **state) {
    (void)state;
    enum { MANY_BANDS = 100 };
    static many_surfaces s;
    const float exponent = 20000;
    const lmp_material glossy = glossy_of(exponent);
    s.area.light = (lmp_light) {
        .kind = LMP_LIGHT_DISK, .direction = { 0, 0, -1 }, .radius = 1, .radiance = { 1, 1, 1 }
    };
    for (int i = 0; i < MANY; i++) {
        const double angle = check_random_between(0, 2 * ORACLE_PI),
                     r = check_random_between(0.8, 1.2), x = check_random_between(-0.3, 0.3),
                     height = check_random_between(1, 3);
        const double to[3] = { r * cos(angle) - x, r * sin(angle), height };
        const double length = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
        s.position[i] = (lmp_vec3) { (float)x, 0, (float)-height };
        s.normal[i] = s.view[i] = (lmp_vec3) { (float)(to[0] / length), (float)(to[1] / length),
                                               (float)(to[2] / length) };
    }
    shade_some(MANY_BANDS, &glossy, &s, 0, MANY, s.glossy);
    for (int i = 0; i < MANY; i += 4)
        CHECK_WITHIN(glossy_error(&s, MANY_BANDS, exponent, i), 1e-4);
}

static void neighbors_change_no_bit(void **state) {
    (void)state;
    static many_surfaces s;
    const lmp_material glossy = glossy_of(30);
    for (int k = 0; k < 30; k++) {
        shade_many(area_kinds[k % AREA_KINDS], BANDS, &glossy, &s);
        for (int i = 0; i < MANY; i++) {
            lmp_rgb alone;
            shade_some(BANDS, &paper, &s, i, 1, &alone);
            assert_memory_equal(&alone, &s.matte[i], sizeof alone);
            shade_some(BANDS, &glossy, &s, i, 1, &alone);
            assert_memory_equal(&alone, &s.glossy[i], sizeof alone);
        }
    }
}

/* Along a line away from a light, where points take over from the outline: one surface is always
 * shaded by the outline. */
static void points_that_take_over_do_not_show(void **state) {
    (void)state;
    const lmp_vec3 w = { 0.48f, 0.36f, 0.8f }, normal = { -0.48f, -0.36f, -0.8f };
    for (int k = 0; k < 4 * AREA_KINDS; k++) {
        const lmp_light_kind kind = area_kinds[k % AREA_KINDS];
        const int bands = k < 2 * AREA_KINDS ? BANDS : 48;
        const lmp_shade_settings settings = { .bands = bands };
        random_area area = area_random(kind);
        area.light.two_sided = true;
        for (double d = 3; d < 3000; d *= 1.05) {
            const lmp_surface s = { .position = area_sum(area.light.position, d * area.size, w),
                                    .normal = normal,
                                    .view = normal };
            const lmp_surfaces one = { .position = lmp_vec3_array_same(&s.position),
                                       .normal = lmp_vec3_array_same(&normal),
                                       .view = lmp_vec3_array_same(&normal) };
            for (int m = 0; m < 2; m++) {
                const lmp_material material = m ? glossy_of(100) : paper;
                lmp_surfaces surfaces = one;
                lmp_rgb rgb;
                surfaces.material = &material;
                lmp_shade_n(&settings, &surfaces, 1, &area.light, 1, lmp_rgb_array_of(&rgb));
                const lmp_rgb exact = lmp_shade(&settings, &material, &s, &area.light, 1);
                CHECK_WITHIN(fabs((double)rgb.g / (double)exact.g - 1),
                             bands == BANDS ? 1e-5 : 1e-4);
            }
        }
    }
}

/* --- the rest --------------------------------------------------------------------------------- */

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
        cmocka_unit_test(many_surfaces_reflect_the_integral_over_the_area),
        cmocka_unit_test(sharp_lobes_see_the_edge_of_a_wide_disk),
        cmocka_unit_test(neighbors_change_no_bit),
        cmocka_unit_test(points_that_take_over_do_not_show),
        cmocka_unit_test(neighbors_of_other_materials_are_shaded_alone),
        cmocka_unit_test(white_paper_reflects_the_irradiance),
        cmocka_unit_test(a_table_reflects_the_coefficients),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

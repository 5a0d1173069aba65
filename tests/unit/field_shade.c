/* SPDX-License-Identifier: MIT */
/* Surfaces under a field reflect what lmp_shade returns for all its lights. */
#include "tests/unit/fields.h"

#include <string.h>

enum { LIGHTS = 300, COUNT = 150 };

static lmp_vec3 position[COUNT], normal[COUNT], view[COUNT];
static lmp_material materials[COUNT];
static lmp_light lights[LIGHTS];

static const lmp_surfaces surfaces = {
    .position = { &position->x, &position->y, &position->z, sizeof *position },
    .normal = { &normal->x, &normal->y, &normal->z, sizeof *normal },
    .view = { &view->x, &view->y, &view->z, sizeof *view },
    .material = materials,
    .material_stride = sizeof *materials
};

/* Scatters surfaces; some neighbors lie side by side, as those of an image do, and some lie outside
 * the grid. */
static void scatter(void) {
    for (int i = 0; i < COUNT; i++) {
        const lmp_vec3 before = position[i ? i - 1 : 0];
        position[i] = i % 10 ? (lmp_vec3) { before.x + 0.01f, before.y, before.z - 0.01f }
                             : field_point(-0.5, 15.5);
        normal[i] = check_random_direction();
        view[i] = check_random_direction();
        materials[i] = (lmp_material) {
            .kind = i / 7 % 2 ? LMP_MATERIAL_METALLIC_ROUGHNESS : LMP_MATERIAL_LOBES,
            .diffuse = { 0.7f, 0.5f, 0.3f },
            .specular = { 0.2f, 0.3f, 0.4f },
            .exponent = 12,
            .roughness = 0.5f,
            .coat = { i % 50 == 3 ? 0.5f : 0, 0.3f },
        };
    }
    field_sphere_lights(0, 15, LIGHTS, lights);
}

/* Finds the largest difference to `exact` relative to the largest radiance, and its root mean
 * square. */
static void compare(const lmp_rgb *rgb, const lmp_rgb *exact, double *worst, double *rms) {
    double peak = 0, sum = 0;
    *worst = 0;
    for (int i = 0; i < COUNT; i++) {
        const double d = fmax(fabs((double)rgb[i].r - (double)exact[i].r),
                              fmax(fabs((double)rgb[i].g - (double)exact[i].g),
                                   fabs((double)rgb[i].b - (double)exact[i].b)));
        peak = fmax(peak, (double)exact[i].g);
        *worst = fmax(*worst, d);
        sum += d * d;
    }
    *worst /= peak;
    *rms = sqrt(sum / COUNT) / peak;
}

/* Returns the fraction of a light that the field holds, which reaches the diffuse lobe truncated to
 * its bands; the rest is exact (docs/fields.md). */
static double held(const lmp_field_info *info, const lmp_light *light, lmp_vec3 at) {
    const lmp_vec3 p = light->position, o = info->desc.origin;
    const double d = sqrt(pow((double)(p.x - at.x), 2) + pow((double)(p.y - at.y), 2) +
                          pow((double)(p.z - at.z), 2));
    const float from[3] = { at.x - o.x, at.y - o.y, at.z - o.z };
    const float cell[3] = { info->desc.cell.x, info->desc.cell.y, info->desc.cell.z };
    for (int k = 0; k < 3; k++)
        if (from[k] < 0 || from[k] > (float)(info->desc.nodes[k] - 1) * cell[k])
            return 0;
    if (light->kind != LMP_LIGHT_SPHERE && light->kind != LMP_LIGHT_POINT)
        return 0;
    const double radius = light->kind == LMP_LIGHT_POINT ? 0 : (double)light->radius;
    const double t = fmin(fmax((d - radius) / (double)info->reach, 0), 1), u = t * t;
    return u * u * (6 - 8 * u + 3 * u * u);
}

/* Converts the radiance under all lights to that under the field, by what its bands lack of the
 * diffuse lobe. */
static void truncate_diffuse(const lmp_field *field, const lmp_light *of, size_t count,
                             lmp_rgb *exact) {
    const lmp_field_info info = lmp_field_describe(field);
    float lambda[LMP_FIELD_BANDS_MAX];
    lmp_lobe_make_diffuse(info.desc.bands, lambda);
    for (int i = 0; i < COUNT; i++) {
        const lmp_material *material = &materials[i];
        double residual[3] = { 0, 0, 0 };
        if (material->kind != LMP_MATERIAL_LOBES)
            continue; /* metals */
        for (size_t k = 0; k < count; k++) {
            const double f = held(&info, &of[k], position[i]);
            if (f == 0)
                continue;
            const lmp_rgb bands =
                lmp_lobe_response(info.desc.bands, lambda, normal[i], &of[k], 1, position[i]);
            const lmp_rgb all = lmp_light_irradiance(&of[k], 1, position[i], normal[i]);
            residual[0] += f * (double)(all.r - bands.r);
            residual[1] += f * (double)(all.g - bands.g);
            residual[2] += f * (double)(all.b - bands.b);
        }
        const double part =
            (1 - (double)lmp_material_coat_reflectance(&material->coat, normal[i], view[i])) /
            3.14159265;
        exact[i].r -= (float)(part * (double)material->diffuse.r * residual[0]);
        exact[i].g -= (float)(part * (double)material->diffuse.g * residual[1]);
        exact[i].b -= (float)(part * (double)material->diffuse.b * residual[2]);
    }
}

/* Compares a field's surfaces with those under all its lights. */
static void shade_both(const lmp_shade_settings *settings, const lmp_field_desc *desc,
                       const lmp_light *of, size_t count, double *worst, double *rms) {
    lmp_field *field = field_of(desc, of, count);
    lmp_rgb rgb[COUNT], exact[COUNT];
    lmp_shade_n(settings, &surfaces, COUNT, of, count, lmp_rgb_array_of(exact));
    truncate_diffuse(field, of, count, exact);
    lmp_field_shade_n(settings, field, &surfaces, COUNT, lmp_rgb_array_of(rgb));
    compare(rgb, exact, worst, rms);
    lmp_field_destroy(field);
}

static void surfaces_reflect_as_under_all_lights(void **test) {
    (void)test;
    scatter();
    for (int bands = 3; bands <= 10; bands += bands == 3 ? 2 : 5)
        for (int window = 0; window < LMP_WINDOW_COUNT; window++) {
            const lmp_field_desc desc = { .bands = bands };
            const lmp_shade_settings settings = { .bands = bands, .window = (lmp_window)window };
            double worst, rms;
            shade_both(&settings, &desc, lights, LIGHTS, &worst, &rms);
            CHECK_WITHIN(worst, 0.01);
            CHECK_WITHIN(rms, 0.001);
        }
}

/* Such lights are near everywhere, so that nothing is interpolated. */
static void lights_that_are_no_spheres_are_summed_exactly(void **test) {
    (void)test;
    lmp_light others[10];
    scatter();
    for (int i = 0; i < 10; i++) {
        others[i] = lights[i];
        others[i].kind = (lmp_light_kind)(LMP_LIGHT_SPOT + i % 4);
        others[i].direction = check_random_direction();
        others[i].outer = 1;
        others[i].angle = 0.4f;
    }
    const lmp_shade_settings settings = { .bands = 5 };
    double worst, rms;
    shade_both(&settings, NULL, others, 10, &worst, &rms);
    CHECK_WITHIN(worst, 1e-5);
}

/* Points are so near that a sphere in their place would be seen as one, however small. */
static void points_are_points_close_by(void **test) {
    (void)test;
    enum { FEW = 10 };
    scatter();
    for (int i = 0; i < FEW; i++) {
        lights[i].kind = LMP_LIGHT_POINT;
        lights[i].position = field_point(0.5, 1.5);
        lights[i].intensity = (lmp_rgb) { 1, 0.5f, 0.25f };
    }
    for (int i = 0; i < COUNT; i++) {
        const lmp_vec3 w = check_random_direction(), at = lights[i % FEW].position;
        position[i] = (lmp_vec3) { at.x + 1e-5f * w.x, at.y + 1e-5f * w.y, at.z + 1e-5f * w.z };
        materials[i].kind = LMP_MATERIAL_LOBES;
        materials[i].exponent = 500;
        normal[i] = view[i] = (lmp_vec3) { -w.x, -w.y, -w.z }; /* the highlight in the middle */
    }
    const lmp_shade_settings settings = { .bands = 10 };
    const lmp_field_desc desc = { .bands = 10 };
    lmp_field *field = field_of(&desc, lights, FEW);
    lmp_rgb rgb[COUNT], exact[COUNT];
    double worst, rms;
    for (int i = 0; i < COUNT; i++) {
        const lmp_surface surface = { .position = position[i],
                                      .normal = normal[i],
                                      .view = view[i] };
        exact[i] = lmp_shade(&settings, &materials[i], &surface, lights, FEW);
    }
    truncate_diffuse(field, lights, FEW, exact);
    lmp_field_shade_n(&settings, field, &surfaces, COUNT, lmp_rgb_array_of(rgb));
    compare(rgb, exact, &worst, &rms);
    CHECK_WITHIN(worst, 1e-4);
    lmp_field_destroy(field);
}

static void points_are_interpolated(void **test) {
    (void)test;
    scatter();
    for (int i = 0; i < LIGHTS; i++) {
        lights[i].kind = LMP_LIGHT_POINT;
        lights[i].intensity = (lmp_rgb) { 1, 0.5f, 0.25f };
    }
    const lmp_shade_settings settings = { .bands = 5 };
    double worst, rms;
    shade_both(&settings, NULL, lights, LIGHTS, &worst, &rms);
    CHECK_WITHIN(worst, 0.01);
}

static void tables_reflect_as_under_all_lights(void **test) {
    (void)test;
    const lmp_brdf_table_desc small = { .bands = 5, .views = 8, .rings_max = 32 };
    const lmp_preintegrated_brdf_desc coarse = { .error = 0.1f };
    lmp_brdf *brdf;
    lmp_brdf_table *table;
    lmp_preintegrated_brdf *preintegrated;
    scatter();
    assert_int_equal(
        lmp_brdf_create_ggx(NULL, &(lmp_ggx) { 0.5f, 0.5f, { 1, 1, 1 }, { 0, 0, 0 } }, &brdf),
        LMP_OK);
    assert_int_equal(lmp_brdf_table_create(NULL, &small, brdf, &table), LMP_OK);
    assert_int_equal(lmp_preintegrated_brdf_create(NULL, &coarse, table, &preintegrated), LMP_OK);
    for (int i = 0; i < COUNT; i++) {
        materials[i] = (lmp_material) { .kind = LMP_MATERIAL_TABLE, .table = table };
        if (i % 5 == 0)
            materials[i] = (lmp_material) { .kind = LMP_MATERIAL_PREINTEGRATED,
                                            .preintegrated = preintegrated };
    }
    lmp_field *field = field_of(NULL, lights, LIGHTS);
    const lmp_shade_settings settings = { .bands = 5 };
    lmp_rgb rgb[COUNT], exact[COUNT];
    double worst, rms;
    for (int i = 0; i < COUNT; i++)
        exact[i] = lmp_shade(
            &settings, &materials[i],
            &(lmp_surface) { .position = position[i], .normal = normal[i], .view = view[i] },
            lights, LIGHTS);
    lmp_field_shade_n(&settings, field, &surfaces, COUNT, lmp_rgb_array_of(rgb));
    compare(rgb, exact, &worst, &rms);
    CHECK_WITHIN(worst, 0.01);
    lmp_field_destroy(field);
    lmp_preintegrated_brdf_destroy(preintegrated);
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_reflect_as_under_all_lights),
        cmocka_unit_test(lights_that_are_no_spheres_are_summed_exactly),
        cmocka_unit_test(points_are_interpolated),
        cmocka_unit_test(points_are_points_close_by),
        cmocka_unit_test(tables_reflect_as_under_all_lights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

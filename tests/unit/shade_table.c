/* SPDX-License-Identifier: MIT */
/* Shading by tables against the lobes and against integration of the BRDF itself. */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/shade.h>

#include <math.h>

static lmp_surface random_surface(void) {
    lmp_surface surface = { .position = { 0.3f, -0.2f, 1 },
                            .normal = check_random_direction(),
                            .view = check_random_direction() };
    const lmp_vec3 n = surface.normal, v = surface.view;
    if (n.x * v.x + n.y * v.y + n.z * v.z < 0)
        surface.view = (lmp_vec3) { -v.x, -v.y, -v.z };
    return surface;
}

static lmp_light random_sphere(void) {
    const lmp_vec3 w = check_random_direction();
    const float d = (float)check_random_between(1.5, 4);
    return (lmp_light) { .position = { 0.3f + d * w.x, -0.2f + d * w.y, 1 + d * w.z },
                         .radius = (float)check_random_between(0.1, 1),
                         .radiance = { 3, 2, 1 } };
}

static lmp_brdf_table *table_of(lmp_brdf *brdf, int bands, int azimuths) {
    lmp_brdf_table *table = NULL;
    const lmp_brdf_table_desc desc = { .bands = bands, .views = 48, .azimuths = azimuths };
    assert_non_null(brdf);
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    lmp_brdf_destroy(brdf);
    return table;
}

/* A Lambert table holds the diffuse lobe's bands: the table and coefficients give the same number.
 */
static void lambert_tables_shade_as_the_diffuse_lobe(void **state) {
    (void)state;
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_create_lambert(NULL, (lmp_rgb) { 0.8f, 0.5f, 0.2f }, &brdf), LMP_OK);
    lmp_brdf_table *table = table_of(brdf, 10, 0);
    const lmp_material by_table = { .kind = LMP_MATERIAL_TABLE, .table = table };
    const lmp_material by_lobe = { .diffuse = { 0.8f, 0.5f, 0.2f } };
    for (int n = 0; n < 200; n++) {
        const lmp_surface surface = random_surface();
        const lmp_light lights[2] = { random_sphere(), random_sphere() };
        const lmp_rgb a = lmp_shade(NULL, &by_table, &surface, lights, 2);
        const lmp_shade_settings settings = { .method = LMP_SHADE_COEFFICIENTS };
        const lmp_rgb b = lmp_shade(&settings, &by_lobe, &surface, lights, 2);
        CHECK_WITHIN(fabsf(a.r - b.r), 2e-5f);
        CHECK_WITHIN(fabsf(a.b - b.b), 2e-5f);
        const lmp_rgb c = lmp_shade(&settings, &by_table, &surface, lights, 2);
        assert_true(a.r == c.r && a.g == c.g && a.b == c.b);
    }
    lmp_brdf_table_destroy(table);
}

/* Integrates L f_r cos over the light's cap, by quadrature of the BRDF in the world's frame. */
static double by_definition(const lmp_brdf *brdf, const lmp_surface *s, lmp_vec3 x, lmp_vec3 y,
                            const lmp_light *light) {
    enum { RINGS = 24, AZIMUTHS = 48 };
    double node[RINGS], weight[RINGS], sum = 0;
    oracle_gauss_legendre(RINGS, node, weight);
    const lmp_vec3 v = { light->position.x - s->position.x, light->position.y - s->position.y,
                         light->position.z - s->position.z };
    const double d = sqrt((double)(v.x * v.x + v.y * v.y + v.z * v.z));
    const double sin_a = (double)light->radius / d, low = sqrt(1 - sin_a * sin_a);
    const double w[3] = { (double)v.x / d, (double)v.y / d, (double)v.z / d };
    const double side[3] = { fabs(w[0]) < 0.9, fabs(w[0]) >= 0.9, 0 };
    double t[3] = { w[1] * side[2] - w[2] * side[1], w[2] * side[0] - w[0] * side[2],
                    w[0] * side[1] - w[1] * side[0] };
    const double length = sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
    for (int k = 0; k < 3; k++)
        t[k] /= length;
    const double b[3] = { w[1] * t[2] - w[2] * t[1], w[2] * t[0] - w[0] * t[2],
                          w[0] * t[1] - w[1] * t[0] };
    const lmp_vec3 n = s->normal, view = s->view;
    const double wo[3] = { (double)(view.x * x.x + view.y * x.y + view.z * x.z),
                           (double)(view.x * y.x + view.y * y.y + view.z * y.z),
                           (double)(view.x * n.x + view.y * n.y + view.z * n.z) };
    for (int k = 0; k < RINGS; k++)
        for (int j = 0; j < AZIMUTHS; j++) {
            const double z = low + (1 - low) * (1 + node[k]) / 2, r = sqrt(1 - z * z);
            const double phi = 2 * ORACLE_PI * (j + 0.5) / AZIMUTHS;
            double u[3];
            for (int c = 0; c < 3; c++)
                u[c] = z * w[c] + r * (cos(phi) * t[c] + sin(phi) * b[c]);
            const double wi[3] = {
                u[0] * (double)x.x + u[1] * (double)x.y + u[2] * (double)x.z,
                u[0] * (double)y.x + u[1] * (double)y.y + u[2] * (double)y.z,
                u[0] * (double)n.x + u[1] * (double)n.y + u[2] * (double)n.z,
            };
            double rgb[3];
            lmp_brdf_eval_double(brdf, wi, wo, rgb);
            sum += weight[k] / 2 * (1 - low) * 2 * ORACLE_PI / AZIMUTHS * rgb[1] * fmax(wi[2], 0);
        }
    return sum * (double)light->radiance.g;
}

static lmp_vec3 cross(lmp_vec3 a, lmp_vec3 b) {
    return (lmp_vec3) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/* Checks that shading many surfaces reads the tangent, too. */
static void check_batch_of_one(const lmp_material *material, const lmp_surface *surface,
                               const lmp_light *light, lmp_rgb expected) {
    const lmp_surfaces one = { .position = lmp_vec3_array_same(&surface->position),
                               .normal = lmp_vec3_array_same(&surface->normal),
                               .view = lmp_vec3_array_same(&surface->view),
                               .tangent = lmp_vec3_array_same(&surface->tangent),
                               .material = material };
    lmp_rgb color;
    lmp_shade_n(NULL, &one, 1, light, 1, lmp_rgb_array_of(&color));
    assert_memory_equal(&color, &expected, sizeof color);
}

/* A brushed metal that 16 bands resolve, with any tangent. */
static void anisotropic_tables_shade_by_the_tangent(void **state) {
    (void)state;
    const lmp_ggx desc = { 0.8f, 0.5f, { 0.9f, 0.6f, 0.3f }, { 0, 0, 0 } };
    lmp_brdf *brdf = NULL, *same = NULL;
    assert_int_equal(lmp_brdf_create_ggx(NULL, &desc, &brdf), LMP_OK);
    assert_int_equal(lmp_brdf_create_ggx(NULL, &desc, &same), LMP_OK);
    lmp_brdf_table *table = table_of(same, 16, 32);
    const lmp_material material = { .kind = LMP_MATERIAL_TABLE, .table = table };
    double worst = 0, largest = 0;
    for (int trial = 0; trial < 100; trial++) {
        lmp_surface surface = random_surface();
        lmp_light light = random_sphere();
        const lmp_vec3 n = surface.normal, v = surface.view;
        const float cosine = n.x * v.x + n.y * v.y + n.z * v.z;
        const lmp_vec3 to = { light.position.x - 0.3f, light.position.y + 0.2f,
                              light.position.z - 1 };
        if (cosine < 0.3f || n.x * to.x + n.y * to.y + n.z * to.z < 1.2f)
            continue; /* the horizon needs more bands */
        const lmp_vec3 tangent = check_random_direction();
        lmp_vec3 y = cross(n, tangent);
        const float scale = 1 / sqrtf(y.x * y.x + y.y * y.y + y.z * y.z);
        y = (lmp_vec3) { y.x * scale, y.y * scale, y.z * scale };
        const double expected = by_definition(brdf, &surface, cross(y, n), y, &light);
        surface.tangent = tangent;
        const lmp_rgb got = lmp_shade(NULL, &material, &surface, &light, 1);
        check_batch_of_one(&material, &surface, &light, got);
        worst = fmax(worst, fabs((double)got.g - expected));
        largest = fmax(largest, expected);
    }
    CHECK_WITHIN(worst, 0.03 * largest);
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
}

/* Views straight down, along the normal, and from below give finite colors. */
static void odd_views_give_finite_colors(void **state) {
    (void)state;
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_create_phong(NULL, (lmp_rgb) { 1, 1, 1 }, 20, &brdf), LMP_OK);
    lmp_brdf_table *table = table_of(brdf, 8, 0);
    const lmp_light light = random_sphere();
    const lmp_vec3 views[] = { { 0, 0, 1 }, { 1, 0, 0 }, { 0.6f, 0, -0.8f }, { 0, 0, -1 } };
    for (int i = 0; i < 4; i++) {
        const lmp_material material = { .kind = LMP_MATERIAL_TABLE, .table = table };
        lmp_surface surface = { .position = { 0.3f, -0.2f, 1 },
                                .normal = { 0, 0, 1 },
                                .view = views[i],
                                .tangent = { 0, 0, 1 } };
        const lmp_rgb c = lmp_shade(NULL, &material, &surface, &light, 1);
        assert_true(isfinite(c.r) && c.r >= 0);
        surface.tangent = (lmp_vec3) { 0, 0, 0 };
        const lmp_rgb none = lmp_shade(NULL, &material, &surface, NULL, 0);
        assert_true(none.r == 0);
    }
    lmp_brdf_table_destroy(table);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lambert_tables_shade_as_the_diffuse_lobe),
        cmocka_unit_test(anisotropic_tables_shade_by_the_tangent),
        cmocka_unit_test(odd_views_give_finite_colors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

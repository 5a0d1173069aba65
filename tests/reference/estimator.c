/* SPDX-License-Identifier: MIT */
/* The ground truth's foundations: its integrals against closed forms, and the equal treatment of
 * all colors. */
#include "app/scene/trace/trace.h"
#include "app/truth/reference_estimate.h"
#include "app/truth/reference_quadrature.h"
#include "tests/oracle/check.h"
#include "tests/oracle/placed.h"

#include <lampion/shade.h>

#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static const reference_band_limit whole = { .bands = 0 };
static const reference_vec origin = { 0, 0, 0 }, up = { 0, 1, 0 };

/* --- integrals -------------------------------------------------------------------------------- */

static double root(double x, void *user) {
    (void)user;
    return sqrt(x);
}

static double logarithm(double x, void *user) {
    (void)user;
    return x > 0 ? log(x) : 0;
}

static double bell(double x, void *user) {
    const double s = *(const double *)user;
    return exp(-x * x / (2 * s * s));
}

static double power(double x, void *user) {
    return pow(cos(x), *(const double *)user);
}

static double reciprocal(double x, void *user) {
    (void)user;
    return 1 / (1 + x * x);
}

static void integrals_have_their_closed_forms(void **state) {
    (void)state;
    CHECK_WITHIN(fabs(reference_integrate(root, NULL, 0, 1) - 2 / 3.0), 1e-12);
    CHECK_WITHIN(fabs(reference_integrate(logarithm, NULL, 0, 1) + 1), 1e-12);
    CHECK_WITHIN(fabs(reference_integrate(reciprocal, NULL, -1, 1) - REFERENCE_PI / 2), 1e-12);
    CHECK_WITHIN(fabs(reference_integrate(reciprocal, NULL, 0, 30) - atan(30)), 1e-12);
    for (double s = 0.4; s > 0.03; s /= 2) {
        const double exact = s * sqrt(2 * REFERENCE_PI) * erf(1 / (s * sqrt(2)));
        CHECK_WITHIN(fabs(reference_integrate(bell, &s, -1, 1) / exact - 1), 1e-11);
        const double off =
            s * sqrt(REFERENCE_PI / 2) * (erf(0.7 / (s * sqrt(2))) + erf(2 / (s * sqrt(2))));
        CHECK_WITHIN(fabs(reference_integrate(bell, &s, -0.7, 2) / off - 1), 1e-11);
    }
    for (double e = 0; e < 300; e = 2 * e + 1) {
        const double exact = sqrt(REFERENCE_PI) / 2 * exp(lgamma((e + 1) / 2) - lgamma(e / 2 + 1));
        CHECK_WITHIN(fabs(reference_integrate(power, &e, 0, REFERENCE_PI / 2) / exact - 1), 1e-11);
    }
}

/* --- colors ----------------------------------------------------------------------------------- */

enum { SPHERES = 4, LIGHTS = 6 };

/* Estimates the light of spheres, a point and a direction, of one color or white. */
static reference_result estimate(const reference_material *material, int light_color) {
    scene_light lights[LIGHTS];
    for (int i = 0; i < LIGHTS; i++) {
        lmp_light *light = &lights[i].emitter;
        lights[i] =
            (scene_light) { .emitter = { .position = { (float)i - 1.5f, 2, 0.5f * (float)i },
                                         .direction = { 0.6f, 0.8f, 0 },
                                         .radius = 0.2f + 0.2f * (float)i } };
        light->kind = i < SPHERES    ? LMP_LIGHT_SPHERE
                      : i == SPHERES ? LMP_LIGHT_POINT
                                     : LMP_LIGHT_DIRECTIONAL;
        lmp_rgb *color = i < SPHERES    ? &light->radiance
                         : i == SPHERES ? &light->intensity
                                        : &light->irradiance;
        for (int c = 0; c < 3; c++)
            (&color->r)[c] = light_color < 0 || light_color == c ? (float)(i + 1) : 0;
    }
    reference_surface surface;
    reference_estimator estimator;
    reference_surface_set(&surface, &whole, material, origin, up,
                          reference_normalize((reference_vec) { 0.5, 1, 0.2 }));
    assert_true(reference_estimator_create(&estimator, lights, LIGHTS));
    const reference_result result =
        reference_estimate(&estimator, &surface, &(reference_stop) { .samples = 2000 }, 3);
    reference_estimator_free(&estimator);
    return result;
}

static reference_material material_of(int diffuse, int specular) {
    reference_material material = { .exponent = 15 };
    for (int c = 0; c < 3; c++) {
        material.diffuse[c] = diffuse < 0 || diffuse == c ? 0.6 : 0;
        material.specular[c] = specular < 0 || specular == c ? 0.3 : 0;
    }
    return material;
}

/* Light of one color, or a material of one, takes the samples that white takes, and gives its
 * fraction of what white gives; where a material's two lobes have two colors, together they give
 * white's. */
static void a_color_alone_is_estimated_as_white_is(void **state) {
    (void)state;
    const reference_material white = material_of(-1, -1);
    const reference_result of_white = estimate(&white, -1);
    const double bound = 1e-9 * of_white.mean[0];
    const reference_material first_two = material_of(0, 1);
    const reference_result of_first_two = estimate(&first_two, -1);
    assert_true(of_white.mean[0] > 0.1);
    for (int c = 0; c < 3; c++) {
        const reference_material colored = material_of(c, c);
        const reference_result by_light = estimate(&white, c), by_material = estimate(&colored, -1);
        CHECK_WITHIN(fabs(of_white.mean[c] - of_white.mean[0]), bound);
        for (int k = 0; k < 3; k++) {
            CHECK_WITHIN(fabs(by_light.mean[k] - (k == c ? of_white.mean[0] : 0)), bound);
            CHECK_WITHIN(fabs(by_material.mean[k] - (k == c ? of_white.mean[0] : 0)), bound);
        }
        for (int d = 0; d < 3; d++) {
            if (d == c)
                continue;
            const reference_material two = material_of(c, d);
            const reference_result of_two = estimate(&two, -1);
            CHECK_WITHIN(fabs(of_two.mean[c] + of_two.mean[d] - of_white.mean[0]),
                         4 * (of_two.standard_error[c] + of_two.standard_error[d] +
                              of_white.standard_error[0]));
            CHECK_WITHIN(fabs(of_two.mean[3 - c - d]), bound);
            CHECK_WITHIN(fabs(of_two.mean[c] - of_first_two.mean[0]), bound);
            CHECK_WITHIN(fabs(of_two.mean[d] - of_first_two.mean[1]), bound);
            assert_true(of_two.standard_error[c] < 0.05 * of_two.mean[c]);
        }
    }
}

/* --- room ------------------------------------------------------------------------------------- */

/* A limit of the address space that leaves room is no reason to refuse: of 64 TB even a sanitizer's
 * program. */
static void a_wide_limit_of_addresses_leaves_room_for_rays(void **state) {
    (void)state;
    scene_vertex vertices[3] = { { .position = { 0, 0, 0 } },
                                 { .position = { 1, 0, 0 } },
                                 { .position = { 0, 1, 0 } } };
    uint32_t indices[3] = { 0, 1, 2 };
    scene_material material = { .base_color = { 1, 1, 1, 1 } };
    scene_mesh mesh = { .index_count = 3 };
    const scene world = { .vertices = vertices,
                          .indices = indices,
                          .meshes = &mesh,
                          .instances = placed_meshes(1),
                          .materials = &material,
                          .vertex_count = 3,
                          .index_count = 3,
                          .mesh_count = 1,
                          .instance_count = 1,
                          .material_count = 1 };
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const struct rlimit wide = { (rlim_t)1 << 46, (rlim_t)1 << 46 };
        const bool limited = setrlimit(RLIMIT_AS, &wide) == 0;
        trace_bvh *bvh = limited ? trace_create(&world) : NULL;
        trace_destroy(bvh);
        _exit(bvh ? 0 : 1);
    }
    int status = -1;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

/* --- tables ----------------------------------------------------------------------------------- */

/* Seen from its nodes a table's value is the series of its coefficients, sines included. */
static void a_table_is_its_series_at_its_nodes(void **state) {
    (void)state;
    enum { BANDS = 5, COUNT = BANDS * BANDS };
    const lmp_ggx ggx = { 0.3f, 0.6f, { 0.5f, 0.4f, 0.3f }, { 0.2f, 0.3f, 0.4f } };
    const lmp_brdf_table_desc desc = { .bands = BANDS, .views = 8, .azimuths = 12 };
    lmp_brdf *brdf = NULL;
    lmp_brdf_table *table = NULL;
    assert_int_equal(lmp_brdf_create_ggx(NULL, &ggx, &brdf), LMP_OK);
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    const float *all = lmp_brdf_table_coefficients(table);
    const reference_material_source source = { .coefficients = all, .table = info };
    assert_true(!info.mirrored && info.count == COUNT);
    for (int trial = 0; trial < 200; trial++) {
        const int view = 1 + trial % (info.views - 1), azimuth = trial % info.azimuths;
        const double theta = view * (double)info.theta_step;
        const double phi = 2 * acos(-1) * azimuth / info.azimuths;
        const reference_vec to_eye = { sin(theta) * cos(phi), cos(theta), -sin(theta) * sin(phi) };
        const reference_vec x = { cos(phi), 0, -sin(phi) }, y = { -sin(phi), 0, -cos(phi) };
        const double w[3] = { check_random() - 0.5, check_random() - 0.5, check_random() - 0.5 };
        const reference_vec to = reference_normalize((reference_vec) { w[0], w[1], w[2] });
        const double own[3] = { reference_dot(to, x), reference_dot(to, y), to.y };
        double basis[COUNT], rgb[3];
        reference_tabulated tabulated;
        assert_true(reference_tabulated_create(&tabulated, &source, 1));
        reference_tabulated_orient(&tabulated, &source, up, (reference_vec) { 1, 0, 0 }, to_eye);
        reference_tabulated_at(&tabulated, to, rgb);
        reference_tabulated_free(&tabulated);
        lmp_sh_eval_double(BANDS, own, basis);
        for (int c = 0; c < 3; c++) {
            const float *node =
                all + ((size_t)(azimuth * info.views + view) * 3 + (size_t)c) * COUNT;
            double sum = 0;
            for (int k = 0; k < COUNT; k++)
                sum += (double)node[k] * basis[k];
            CHECK_WITHIN(fabs(rgb[c] - sum), 1e-4);
        }
    }
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integrals_have_their_closed_forms),
        cmocka_unit_test(a_color_alone_is_estimated_as_white_is),
        cmocka_unit_test(a_table_is_its_series_at_its_nodes),
        cmocka_unit_test(a_wide_limit_of_addresses_leaves_room_for_rays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

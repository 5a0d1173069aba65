/* SPDX-License-Identifier: MIT */
/* Clear coats against KHR_materials_clearcoat: GGX of glTF 2.0's appendix B without Fresnel's term,
 * integrated over caps here, times w (0.04 + 0.96 (1 - |v·n|)^5); what is under them has the rest.
 */
#include "tests/oracle/check.h"
#include "tests/oracle/gltf.h"
#include "tests/oracle/oracle.h"

#include <lampion/shade.h>

#include <math.h>
#include <string.h>

static double reflectance(double weight, lmp_vec3 n, lmp_vec3 v) {
    const double cosine =
        (double)n.x * (double)v.x + (double)n.y * (double)v.y + (double)n.z * (double)v.z;
    return weight * (0.04 + 0.96 * pow(1 - fabs(cosine), 5));
}

/* Caps of half angle 0.3 in the plane of incidence around the mirror direction. */
static void a_coat_reflects_by_the_specification(void **state) {
    (void)state;
    const lmp_shade_settings settings = { .bands = 128 };
    for (int r = 0; r < 4; r++)
        for (int view = 0; view <= 80; view += 20) {
            const double angle = view * ORACLE_PI / 180, rough = 0.4 + 0.2 * r, half = 0.3;
            const oracle_gltf exact = { rough * rough, angle, 1, 1, 0 };
            const lmp_material coated = { .coat = { 0.75f, (float)rough } };
            const lmp_surface surface = { .normal = { 0, 0, 1 },
                                          .view = { (float)-sin(angle), 0, (float)cos(angle) } };
            const double part = reflectance(0.75, surface.normal, surface.view);
            check_errors errors = { 0 };
            double peak = 0;
            for (int i = -6; i <= 6; i++) {
                const double to = angle + 0.1 * i;
                if (fabs(to) > ORACLE_PI / 2 - half)
                    continue;
                const double middle[3] = { sin(to), 0, cos(to) };
                const lmp_light cap = { .kind = LMP_LIGHT_CAP,
                                        .direction = { (float)middle[0], 0, (float)middle[2] },
                                        .angle = (float)half,
                                        .radiance = { 1, 1, 1 } };
                const double expected = part * oracle_gltf_cap(&exact, middle, half);
                const lmp_rgb color = lmp_shade(&settings, &coated, &surface, &cap, 1);
                check_errors_add(&errors, fabs((double)color.r - expected));
                peak = fmax(peak, expected);
            }
            CHECK_WITHIN(errors.largest, 0.1 * peak);
            CHECK_WITHIN(check_errors_rms(&errors), 0.05 * peak);
        }
}

/* --- any material ----------------------------------------------------------------------------- */

enum { COUNT = 41, LIGHTS = 5 };

typedef struct coated_surfaces {
    lmp_surface at[COUNT];
    lmp_material material[COUNT];
    lmp_light lights[LIGHTS];
    float sh[3 * 36];
} coated_surfaces;

static lmp_rgb random_color(void) {
    return (lmp_rgb) { (float)check_random(), (float)check_random(), (float)check_random() };
}

/* Every third has no coat, every second one a normal of the coat's own. */
static void make(coated_surfaces *s) {
    memset(s, 0, sizeof *s);
    for (int i = 0; i < COUNT; i++) {
        s->at[i] =
            (lmp_surface) { .normal = check_random_direction(), .view = check_random_direction() };
        s->at[i].coat_normal = i % 2 ? check_random_direction() : s->at[i].normal;
        s->material[i] = (lmp_material) { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                          .base_color = random_color(),
                                          .metallic = 0.5f,
                                          .roughness = (float)check_random() };
        if (i % 3)
            s->material[i].coat = (lmp_coat) { (float)check_random(), (float)check_random() };
    }
    for (int i = 0; i < LIGHTS; i++) {
        const lmp_vec3 to = check_random_direction();
        s->lights[i] = (lmp_light) { .position = { 3 * to.x, 3 * to.y, 3 * to.z },
                                     .radius = 0.5f,
                                     .radiance = random_color() };
    }
    for (size_t i = 0; i < sizeof s->sh / sizeof *s->sh; i++)
        s->sh[i] = (float)check_random_between(0, 0.1);
    s->sh[0] = s->sh[36] = s->sh[72] = 1;
}

static lmp_rgb shade(const coated_surfaces *s, bool environment, const lmp_material *material,
                     const lmp_surface *surface) {
    const lmp_environment around = { s->sh, 6 };
    return environment ? lmp_shade_environment(NULL, material, surface, &around)
                       : lmp_shade(NULL, material, surface, s->lights, LIGHTS);
}

static void what_is_under_a_coat_has_the_rest(void **state) {
    (void)state;
    coated_surfaces s;
    make(&s);
    for (int environment = 0; environment < 2; environment++)
        for (int i = 0; i < COUNT; i++) {
            lmp_material bare = s.material[i], coat = { .coat = s.material[i].coat };
            bare.coat.weight = 0;
            const double part =
                reflectance((double)s.material[i].coat.weight, s.at[i].coat_normal, s.at[i].view);
            const lmp_rgb all = shade(&s, environment, &s.material[i], &s.at[i]);
            const lmp_rgb under = shade(&s, environment, &bare, &s.at[i]);
            const lmp_rgb over = shade(&s, environment, &coat, &s.at[i]);
            const double expected = (double)under.g * (1 - part) + (double)over.g;
            CHECK_WITHIN(fabs((double)all.g - expected), 1e-6 * (1 + expected));
            CHECK_WITHIN(fabs((double)lmp_material_coated(&s.material[i].coat, s.at[i].coat_normal,
                                                          s.at[i].view) -
                              part),
                         1e-6);
        }
}

static void many_surfaces_are_coated_as_each_of_them(void **state) {
    (void)state;
    coated_surfaces s;
    make(&s);
    const size_t stride = sizeof *s.at;
    const lmp_surfaces all = {
        .position = { &s.at->position.x, &s.at->position.y, &s.at->position.z, stride },
        .normal = { &s.at->normal.x, &s.at->normal.y, &s.at->normal.z, stride },
        .view = { &s.at->view.x, &s.at->view.y, &s.at->view.z, stride },
        .material = s.material,
        .material_stride = sizeof *s.material,
        .coat_normal = { &s.at->coat_normal.x, &s.at->coat_normal.y, &s.at->coat_normal.z, stride }
    };
    const lmp_environment around = { s.sh, 6 };
    float rgb[4 * COUNT];
    for (int environment = 0; environment < 2; environment++) {
        if (environment)
            lmp_shade_environment_n(NULL, &all, COUNT, &around, 4 * sizeof *rgb, rgb);
        else
            lmp_shade_n(NULL, &all, COUNT, s.lights, LIGHTS, 4 * sizeof *rgb, rgb);
        for (int i = 0; i < COUNT; i++) {
            const lmp_rgb one = shade(&s, environment, &s.material[i], &s.at[i]);
            const double expected[3] = { (double)one.r, (double)one.g, (double)one.b };
            for (int c = 0; c < 3; c++)
                CHECK_WITHIN(fabs((double)rgb[4 * i + c] - expected[c]), 3e-5);
        }
    }
}

/* Of each method, over a base that is no metallic-roughness. */
static void all_methods_coat_alike(void **state) {
    (void)state;
    lmp_preintegrated_lobe *lobe;
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, NULL, &lobe), LMP_OK);
    coated_surfaces s;
    make(&s);
    for (int i = 0; i < COUNT; i++) {
        const lmp_material painted = { .diffuse = { 0.5f, 0.5f, 0.5f },
                                       .specular = { 0.2f, 0.2f, 0.2f },
                                       .exponent = 10,
                                       .coat = { 1, 0.6f } };
        lmp_rgb by[LMP_SHADE_METHODS];
        for (int method = 0; method < LMP_SHADE_METHODS; method++) {
            const lmp_shade_settings settings = { .method = (lmp_shade_method)method,
                                                  .lobe = lobe };
            by[method] = lmp_shade(&settings, &painted, &s.at[i], s.lights, LIGHTS);
        }
        CHECK_WITHIN(fabs((double)by[LMP_SHADE_COEFFICIENTS].r - (double)by[0].r), 1e-5);
        CHECK_WITHIN(fabs((double)by[LMP_SHADE_PREINTEGRATED].r - (double)by[0].r), 3e-3);
    }
    lmp_preintegrated_lobe_destroy(lobe);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_coat_reflects_by_the_specification),
        cmocka_unit_test(what_is_under_a_coat_has_the_rest),
        cmocka_unit_test(many_surfaces_are_coated_as_each_of_them),
        cmocka_unit_test(all_methods_coat_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

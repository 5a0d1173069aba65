/* SPDX-License-Identifier: MIT */
/* Clear coats against KHR_materials_clearcoat: GGX of glTF 2.0's appendix B without Fresnel's term,
 * integrated over caps here, times w (0.04 + 0.96 (1 - |v·n|)^5); what is under them receives the
 * rest. */
#include "tests/oracle/check.h"
#include "tests/oracle/crowd.h"
#include "tests/oracle/gltf.h"
#include "tests/oracle/oracle.h"

#include <lampion/shade.h>

#include <math.h>

static double reflectance(double weight, lmp_vec3 n, lmp_vec3 v) {
    const double cosine =
        (double)n.x * (double)v.x + (double)n.y * (double)v.y + (double)n.z * (double)v.z;
    return weight * (0.04 + 0.96 * pow(1 - fabs(cosine), 5));
}

/* The caps have half angle 0.3 and lie in the plane of incidence around the mirror direction. */
static void a_coat_reflects_by_the_specification(void **state) {
    (void)state;
    const lmp_shade_settings settings = { .bands = 128 };
    for (int r = 0; r < 4; r++)
        for (int view = 0; view <= 80; view += 20) {
            const double angle = view * ORACLE_PI / 180, rough = 0.4 + 0.2 * r, half_angle = 0.3;
            const oracle_gltf exact = { rough * rough, angle, 1, 1, 0 };
            const lmp_material coated = { .coat = { 0.75f, (float)rough } };
            const lmp_surface surface = { .normal = { 0, 0, 1 },
                                          .view = { (float)-sin(angle), 0, (float)cos(angle) } };
            const double part = reflectance(0.75, surface.normal, surface.view);
            check_errors errors = { 0 };
            double peak = 0;
            for (int i = -6; i <= 6; i++) {
                const double to = angle + 0.1 * i;
                if (fabs(to) > ORACLE_PI / 2 - half_angle)
                    continue;
                const double middle[3] = { sin(to), 0, cos(to) };
                const lmp_light cap = { .kind = LMP_LIGHT_CAP,
                                        .direction = { (float)middle[0], 0, (float)middle[2] },
                                        .angle = (float)half_angle,
                                        .radiance = { 1, 1, 1 } };
                const double expected = part * oracle_gltf_cap(&exact, middle, half_angle);
                const lmp_rgb color = lmp_shade(&settings, &coated, &surface, &cap, 1);
                check_errors_add(&errors, fabs((double)color.r - expected));
                peak = fmax(peak, expected);
            }
            CHECK_WITHIN(errors.largest, 0.1 * peak);
            CHECK_WITHIN(check_errors_rms(&errors), 0.05 * peak);
        }
}

/* --- any material ----------------------------------------------------------------------------- */

/* Makes surfaces of which every third has no coat. */
static void make_coated(crowd *c) {
    crowd_make(c);
    for (int i = 0; i < CROWD_COUNT; i++)
        if (i % 3)
            c->material[i].coat = (lmp_coat) { (float)check_random(), (float)check_random() };
}

static void what_is_under_a_coat_has_the_rest(void **state) {
    (void)state;
    crowd all, bare, coats;
    make_coated(&all);
    bare = coats = all;
    for (int i = 0; i < CROWD_COUNT; i++) {
        const lmp_coat *coat = &all.material[i].coat;
        bare.material[i].coat.weight = 0;
        coats.material[i] = (lmp_material) { .coat = *coat };
        const lmp_surface *at = &all.at[i];
        const double part = reflectance((double)coat->weight, at->coat_normal, at->view);
        const float coated = lmp_material_coat_reflectance(coat, at->coat_normal, at->view);
        CHECK_WITHIN(fabs((double)coated - part), 1e-6);
        for (int environment = 0; environment < 2; environment++) {
            const lmp_rgb both = crowd_shade_one(&all, i, environment);
            const lmp_rgb under = crowd_shade_one(&bare, i, environment);
            const lmp_rgb over = crowd_shade_one(&coats, i, environment);
            const double expected = (double)under.g * (1 - part) + (double)over.g;
            CHECK_WITHIN(fabs((double)both.g - expected), 1e-6 * (1 + expected));
        }
    }
}

static void many_surfaces_are_coated_as_each_of_them(void **state) {
    (void)state;
    crowd all;
    make_coated(&all);
    crowd_check_many(&all);
}

/* The base is not metallic-roughness. */
static void all_methods_coat_alike(void **state) {
    (void)state;
    crowd all;
    crowd_make(&all);
    for (int i = 0; i < CROWD_COUNT; i++)
        all.material[i] = (lmp_material) { .diffuse = { 0.5f, 0.5f, 0.5f },
                                           .specular = { 0.2f, 0.2f, 0.2f },
                                           .exponent = 10,
                                           .coat = { 1, 0.6f } };
    crowd_check_methods(&all, 3e-3);
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

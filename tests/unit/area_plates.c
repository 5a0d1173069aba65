/* SPDX-License-Identifier: MIT */
/* Plates of glTF's metal and dielectric under rectangles, as lmp_shade shades them, against glTF
 * 2.0's appendix B, integrated over the rectangle in double precision here. LAMPION_LONG=1 tries
 * all plates and prints the table of docs/areas.md. */
#include "tests/oracle/check.h"
#include "tests/oracle/gltf.h"
#include "tests/oracle/oracle.h"

#include <lampion/lampion.h>

#include <math.h>
#include <stdlib.h>

#define PI ORACLE_PI

/* --- plates ----------------------------------------------------------------------------------- */

/* A panel above the plate, and one that stands on it, beyond what the view looks at. */
static const lmp_light rectangles[] = {
    { .kind = LMP_LIGHT_RECTANGLE,
      .position = { 0, 0, 1 },
      .half = { { 1, 0, 0 }, { 0, -0.5f, 0 } },
      .radiance = { 1, 1, 1 } },
    { .kind = LMP_LIGHT_RECTANGLE,
      .position = { 2, 0, 0.8f },
      .half = { { 0, 1, 0 }, { 0, 0, -0.7f } },
      .radiance = { 1, 1, 1 } },
};
enum { ABOVE, STANDING, RECTANGLES };

/* The points of a plate, z = 0, on one side of what is symmetric; all are seen from one angle. */
enum { ALONG = 20, ACROSS = 6 };
static lmp_vec3 plate_point(int i, int k) {
    return (lmp_vec3) { -3 + 4.7f * ((float)i + 0.5f) / ALONG, 2 * ((float)k + 0.5f) / ACROSS, 0 };
}

/* --- by quadrature ---------------------------------------------------------------------------- */

enum { NODES = 4 };

/* Returns the radiance that a point reflects of the rectangle's, by panels x panels squares of
 * NODES x NODES nodes each. */
static double exact(const oracle_gltf *s, const lmp_light *light, lmp_vec3 point, int panels) {
    static double node[NODES], weight[NODES];
    if (weight[0] == 0)
        oracle_gauss_legendre(NODES, node, weight);
    const lmp_vec3 a = light->half[0], b = light->half[1];
    const double normal[3] = { (double)(a.y * b.z - a.z * b.y), (double)(a.z * b.x - a.x * b.z),
                               (double)(a.x * b.y - a.y * b.x) }; /* as long as a quarter's area */
    const double off[3] = { (double)light->position.x - (double)point.x,
                            (double)light->position.y - (double)point.y,
                            (double)light->position.z - (double)point.z };
    double sum = 0;
    for (int i = 0; i < panels * NODES; i++)
        for (int k = 0; k < panels * NODES; k++) {
            const double u = (2 * (i / NODES) + 1 + node[i % NODES]) / panels - 1;
            const double v = (2 * (k / NODES) + 1 + node[k % NODES]) / panels - 1;
            double w[3] = { off[0] + u * (double)a.x + v * (double)b.x,
                            off[1] + u * (double)a.y + v * (double)b.y,
                            off[2] + u * (double)a.z + v * (double)b.z };
            const double d2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2], d = sqrt(d2);
            const double facing = -(w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]);
            for (int c = 0; c < 3; c++)
                w[c] /= d;
            if (facing > 0)
                sum += weight[i % NODES] * weight[k % NODES] * facing / (d2 * d) *
                       oracle_gltf_at(s, w);
        }
    return sum / (panels * panels);
}

/* As many panels as resolve the highlight. */
static int panels_for(double alpha) {
    return (int)(4 + 3 / alpha);
}

/* --- by the library --------------------------------------------------------------------------- */

static double shaded(double roughness, double view, bool metal, const lmp_light *light,
                     lmp_vec3 point) {
    const lmp_shade_settings settings = { .bands = LMP_BANDS_MAX };
    const float color = metal ? 0.9f : 0.5f;
    const lmp_material material = { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                    .base_color = { color, color, color },
                                    .metallic = metal ? 1 : 0,
                                    .roughness = (float)roughness };
    const lmp_surface surface = { .position = point,
                                  .normal = { 0, 0, 1 },
                                  .view = { (float)-sin(view), 0, (float)cos(view) } };
    return (double)lmp_shade(&settings, &material, &surface, light, 1).g;
}

/* --- how far they are apart ------------------------------------------------------------------- */

typedef struct apart {
    double rms, largest; /* in parts of the plate's peak */
} apart;

static apart compare(double roughness, double degrees, bool metal, const lmp_light *light) {
    const double alpha = roughness * roughness, view = degrees * PI / 180;
    const oracle_gltf s = { alpha, view, metal ? 0.9 : 0.04, 1, metal ? 0 : 0.5 };
    check_errors errors = { 0 };
    double peak = 0;
    for (int i = 0; i < ALONG; i++)
        for (int k = 0; k < ACROSS; k++) {
            const lmp_vec3 point = plate_point(i, k);
            const double expected = exact(&s, light, point, panels_for(alpha));
            check_errors_add(&errors,
                             fabs(shaded(roughness, view, metal, light, point) - expected));
            peak = fmax(peak, expected);
        }
    return (apart) { check_errors_rms(&errors) / peak, errors.largest / peak };
}

/* --- tests ------------------------------------------------------------------------------------ */

/* White Lambert at the middle under the panel has the closed form of its irradiance. */
static void the_exact_side_has_the_closed_form(void **state) {
    (void)state;
    const oracle_gltf white = { 1, 0, 0, 0, 1 };
    const double a = 1, b = 0.5, x = sqrt(a * a + 1), y = sqrt(b * b + 1);
    const double irradiance = 2 * (a / x * atan(b / x) + b / y * atan(a / y));
    const lmp_vec3 origin = { 0, 0, 0 };
    CHECK_WITHIN(fabs(exact(&white, &rectangles[ABOVE], origin, 4) - irradiance / PI), 1e-7);
}

/* Half as wide panels change it by a twentieth of what plates may err by, at most. */
static void the_exact_side_converges(void **state) {
    (void)state;
    const oracle_gltf s = { 0.0625, 75 * PI / 180, 0.9, 1, 0 };
    for (int i = 0; i < ALONG; i += 5)
        for (int r = 0; r < RECTANGLES; r++) {
            const lmp_vec3 point = plate_point(i, 0);
            const int panels = panels_for(s.alpha);
            CHECK_WITHIN(fabs(exact(&s, &rectangles[r], point, panels) -
                              exact(&s, &rectangles[r], point, 2 * panels)),
                         0.001);
        }
}

/* Each roughness, and what linearly transformed cosines (Heitz et al. 2016, the published tables,
 * clipped exactly) err by on the same plates of metal at each view: rms and largest. */
static const struct plate {
    double roughness, ltc[3][2];
} plates[] = {
    { 0.25, { { 0.006, 0.013 }, { 0.003, 0.009 }, { 0.030, 0.106 } } },
    { 0.35, { { 0.007, 0.016 }, { 0.006, 0.015 }, { 0.058, 0.192 } } },
    { 0.45, { { 0.006, 0.016 }, { 0.009, 0.022 }, { 0.060, 0.182 } } },
    { 0.55, { { 0.006, 0.015 }, { 0.014, 0.042 }, { 0.050, 0.119 } } },
    { 0.70, { { 0.005, 0.012 }, { 0.015, 0.040 }, { 0.037, 0.111 } } },
    { 0.85, { { 0.004, 0.010 }, { 0.010, 0.028 }, { 0.024, 0.068 } } },
    { 1.00, { { 0.005, 0.012 }, { 0.007, 0.015 }, { 0.014, 0.028 } } },
};
static const double views[] = { 0, 45, 75 };

static apart worst_of_rectangles(double roughness, double degrees, bool metal) {
    apart worst = { 0, 0 };
    for (int k = 0; k < RECTANGLES; k++) {
        const apart a = compare(roughness, degrees, metal, &rectangles[k]);
        worst = (apart) { fmax(worst.rms, a.rms), fmax(worst.largest, a.largest) };
    }
    return worst;
}

static void plates_under_rectangles_look_as_the_specification_says(void **state) {
    (void)state;
    print_message("table areas.plates\n"
                  "| roughness | metal, 0° | 45° | 75° | LTC, metal, 0° | 45° | 75° "
                  "| dielectric, 0° | 45° | 75° |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (int r = check_count(1, 0); r < 7; r += check_count(5, 1)) {
        const struct plate *p = &plates[r];
        print_message("| %.2f |", p->roughness);
        for (int i = 0; i < 9; i++) {
            const bool metal = i < 3;
            if (i / 3 == 1) {
                print_message(" %.3f %.3f |", p->ltc[i % 3][0], p->ltc[i % 3][1]);
                continue;
            }
            const apart worst = worst_of_rectangles(p->roughness, views[i % 3], metal);
            print_message(" %.3f %.3f |", worst.rms, worst.largest);
            CHECK_WITHIN(worst.rms, 0.02);
            CHECK_WITHIN(worst.largest, 0.12);
        }
        print_message("\n");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_exact_side_has_the_closed_form),
        cmocka_unit_test(the_exact_side_converges),
        cmocka_unit_test(plates_under_rectangles_look_as_the_specification_says),
    };
    cmocka_set_test_filter(getenv("LAMPION_TEST"));
    return cmocka_run_group_tests(tests, NULL, NULL);
}

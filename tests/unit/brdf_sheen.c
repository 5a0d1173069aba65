/* SPDX-License-Identifier: MIT */
/* Sheen against KHR_materials_sheen's formulas and integrals of them. */
#include "tests/oracle/oracle.h"
#include "tests/oracle/sheen.h"
#include "tests/unit/brdfs.h"

#include <lampion/shade.h>

#include <math.h>
#include <stdlib.h>

/* --- values ----------------------------------------------------------------------------------- */

static const float roughnesses[] = { 0.1f, 0.3f, 0.5f, 0.75f, 1 };

static const lmp_rgb black = { 0, 0, 0 };

static lmp_brdf *sheen(float roughness, lmp_rgb color, lmp_rgb diffuse) {
    const lmp_sheen desc = { roughness, color, diffuse };
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_create_sheen(NULL, &desc, &brdf), LMP_OK);
    return brdf;
}

static void random_above(double unit[3]) {
    const lmp_vec3 at = random_upper();
    const double x = (double)at.x, y = (double)at.y, z = (double)at.z;
    const double length = sqrt(x * x + y * y + z * z);
    unit[0] = x / length;
    unit[1] = y / length;
    unit[2] = z / length;
}

static void sheen_is_that_of_the_specification(void **state) {
    (void)state;
    for (int r = 0; r < 5; r++) {
        lmp_brdf *brdf = sheen(roughnesses[r], (lmp_rgb) { 1, 0.5f, 0.25f }, black);
        for (int n = 0; n < 2000; n++) {
            double light[3], view[3], rgb[3];
            random_above(light);
            random_above(view);
            lmp_brdf_eval_double(brdf, light, view, rgb);
            const double expected = oracle_sheen((double)roughnesses[r], light, view);
            const double arrives = fmax(oracle_sheen_gain((double)roughnesses[r], light[2]),
                                        oracle_sheen_gain((double)roughnesses[r], view[2]));
            const bool limited = arrives > 0.99; /* by tables of the library and of the test */
            const double between = fmin(light[2], view[2]) < 1e-3 ? 0.02 : 5e-3;
            const double most = (limited ? between : 1e-9) * expected + 1e-300;
            CHECK_WITHIN(fabs(rgb[0] - expected), most);
            CHECK_WITHIN(fabs(rgb[2] - expected / 4), most / 4);
        }
        lmp_brdf_destroy(brdf);
    }
}

static void the_base_has_what_the_sheen_leaves(void **state) {
    (void)state;
    for (int r = 0; r < 5; r++) {
        const double rough = (double)roughnesses[r];
        lmp_brdf *white = sheen(roughnesses[r], (lmp_rgb) { 0.2f, 0.8f, 0 }, black);
        lmp_brdf *both =
            sheen(roughnesses[r], (lmp_rgb) { 0.2f, 0.8f, 0 }, (lmp_rgb) { 0.5f, 0.5f, 0.5f });
        for (int k = 0; k < 6; k++) {
            const double to = 0.2 * k, from = 1.45 - 0.15 * k;
            const double light[3] = { sin(to), 0, cos(to) }, view[3] = { 0, sin(from), cos(from) };
            double over[3], all[3];
            lmp_brdf_eval_double(white, light, view, over);
            lmp_brdf_eval_double(both, light, view, all);
            const double left = fmin(1 - (double)0.8f * oracle_sheen_albedo(rough, to),
                                     1 - (double)0.8f * oracle_sheen_albedo(rough, from));
            for (int c = 0; c < 3; c++)
                CHECK_WITHIN(fabs(all[c] - over[c] - left * 0.5 / ORACLE_PI), 2e-4);
        }
        lmp_brdf_destroy(white);
        lmp_brdf_destroy(both);
    }
}

static void sheen_is_reciprocal(void **state) {
    (void)state;
    for (int r = 0; r < 5; r++) {
        lmp_brdf *brdf = sheen(roughnesses[r], (lmp_rgb) { 1, 0.5f, 0.1f }, (lmp_rgb) { 1, 1, 1 });
        for (int n = 0; n < 500; n++) {
            double a[3], b[3], ab[3], ba[3];
            random_above(a);
            random_above(b);
            lmp_brdf_eval_double(brdf, a, b, ab);
            lmp_brdf_eval_double(brdf, b, a, ba);
            CHECK_WITHIN(fabs(ab[1] - ba[1]), 1e-12 * ab[1]);
        }
        lmp_brdf_destroy(brdf);
    }
}

/* Returns what a white sky gives a view, by midpoints in the cube root of the light's cosine and
 * the square root of its azimuth. */
static double albedo(const lmp_brdf *brdf, double cosine) {
    enum { NODES = 80 };
    const double view[3] = { sqrt(1 - cosine * cosine), 0, cosine };
    double sum = 0;
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < NODES; k++) {
            const double root = (i + 0.5) / NODES, z = root * root * root, s = sqrt(1 - z * z);
            const double across = (k + 0.5) / NODES, phi = ORACLE_PI * across * across;
            const double light[3] = { s * cos(phi), s * sin(phi), z };
            double rgb[3];
            lmp_brdf_eval_double(brdf, light, view, rgb);
            sum += 3 * root * root * 4 * ORACLE_PI * across * z * rgb[0];
        }
    return sum / (NODES * NODES);
}

/* The views range from the normal to past the last tenth of a degree; where the specification's
 * formulas reflect three times what arrives, these reflect nearly all of it. */
static void sheen_reflects_no_more_than_arrives(void **state) {
    (void)state;
    static const double cosines[] = { 1,    0.5,   0.2,   0.1,   0.05,   0.03, 0.02,
                                      0.01, 0.005, 0.003, 0.001, 0.0003, 1e-4, 1e-5 };
    static const float smooth[] = { 0.07f, 0.085f, 0.1f, 0.15f, 0.2f, 0.25f, 0.3f, 0.6f, 1 };
    for (size_t r = 0; r < sizeof smooth / sizeof *smooth; r++) {
        lmp_brdf *white = sheen(smooth[r], (lmp_rgb) { 1, 1, 1 }, black);
        lmp_brdf *cloth = sheen(smooth[r], (lmp_rgb) { 0.7f, 0.7f, 0.7f }, (lmp_rgb) { 1, 1, 1 });
        double largest = 0;
        for (size_t k = 0; k < sizeof cosines / sizeof *cosines; k++) {
            largest = fmax(largest, albedo(white, cosines[k]));
            CHECK_WITHIN(albedo(cloth, cosines[k]), 1.001);
        }
        print_message("roughness %.3f: at most %.4f\n", (double)smooth[r], largest);
        CHECK_WITHIN(largest, 1);
        if (smooth[r] <= 0.2f)
            CHECK_WITHIN(0.99, largest);
        lmp_brdf_destroy(white);
        lmp_brdf_destroy(cloth);
    }
}

static void sheen_out_of_range_is_refused(void **state) {
    (void)state;
    const lmp_sheen wrong[] = {
        { 0.06f, { 1, 1, 1 }, { 0, 0, 0 } }, { 1.1f, { 1, 1, 1 }, { 0, 0, 0 } },
        { NAN, { 1, 1, 1 }, { 0, 0, 0 } },   { 0.5f, { 1.1f, 1, 1 }, { 0, 0, 0 } },
        { 0.5f, { 1, -1, 1 }, { 0, 0, 0 } }, { 0.5f, { 1, 1, 1 }, { -1, 0, 0 } }
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        lmp_brdf *brdf;
        assert_int_equal(lmp_brdf_create_sheen(NULL, &wrong[i], &brdf), LMP_ERROR_ARGUMENT);
        assert_null(brdf);
    }
}

/* --- under lights ----------------------------------------------------------------------------- */

/* Returns the rms error of caps of half angle 0.3 through the zenith, relative to the largest. */
static double error_of_bands(int bands, float roughness) {
    const double half_angle = 0.3;
    const lmp_brdf_table_desc desc = { .bands = bands };
    lmp_brdf *brdf = sheen(roughness, (lmp_rgb) { 1, 1, 1 }, black);
    lmp_brdf_table *table = NULL;
    check_errors errors = { 0 };
    double peak = 0;
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    const lmp_material material = { .kind = LMP_MATERIAL_TABLE, .table = table };
    for (int v = 0; v < 4; v++)
        for (int i = -12; i <= 12; i++) {
            const double angle = 25 * v * ORACLE_PI / 180, to = 0.1 * i;
            const lmp_surface surface = { .normal = { 0, 0, 1 },
                                          .view = { (float)sin(angle), 0, (float)cos(angle) } };
            const lmp_light cap = { .kind = LMP_LIGHT_CAP,
                                    .direction = { (float)sin(to), 0, (float)cos(to) },
                                    .angle = (float)half_angle,
                                    .radiance = { 1, 1, 1 } };
            const double expected = oracle_sheen_cap((double)roughness, to, half_angle, angle);
            const lmp_rgb color = lmp_shade(NULL, &material, &surface, &cap, 1);
            check_errors_add(&errors, fabs((double)color.g - expected));
            peak = fmax(peak, expected);
        }
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
    return check_errors_rms(&errors) / peak;
}

static void bands_come_to_the_integral_of_the_specification(void **state) {
    (void)state;
    static const struct {
        float roughness;
        double most[3]; /* bounds at 5, 10 and 20 bands */
    } rows[] = { { 0.3f, { 0.04, 5e-3, 1e-3 } },
                 { 0.5f, { 0.05, 5e-3, 1e-3 } },
                 { 1, { 0.05, 5e-3, 1e-3 } } };
    print_message("table layers.sheen\n"
                  "| roughness | 5 bands | 10 bands | 20 bands |\n|---|---|---|---|\n");
    for (int r = 0; r < 3; r++) {
        print_message("| %.1f |", (double)rows[r].roughness);
        for (int k = 0; k < 3; k++) {
            const double rms = error_of_bands(5 << k, rows[r].roughness);
            print_message(" %.4f |", rms);
            CHECK_WITHIN(rms, rows[r].most[k]);
        }
        print_message("\n");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sheen_is_that_of_the_specification),
        cmocka_unit_test(the_base_has_what_the_sheen_leaves),
        cmocka_unit_test(sheen_is_reciprocal),
        cmocka_unit_test(sheen_reflects_no_more_than_arrives),
        cmocka_unit_test(sheen_out_of_range_is_refused),
        cmocka_unit_test(bands_come_to_the_integral_of_the_specification),
    };
    cmocka_set_test_filter(getenv("LAMPION_TEST"));
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: MIT */
/* The lobes of lmp_lobe_find_ggx against glTF 2.0's appendix B, both integrated over caps in double
 * precision here, with only the lobes taken from the library. LAMPION_LONG=1 sweeps all plates and
 * prints the tables of docs/ggx.md. */
#include "tests/oracle/check.h"
#include "tests/oracle/gltf.h"
#include "tests/oracle/oracle.h"

#include <lampion/lobe.h>

#include <math.h>
#include <stdlib.h>

#define PI ORACLE_PI

static double angle_between(const double a[3], lmp_vec3 b) {
    const double x = (double)b.x, y = (double)b.y, z = (double)b.z;
    const double c[3] = { a[1] * z - a[2] * y, a[2] * x - a[0] * z, a[0] * y - a[1] * x };
    return atan2(sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]), a[0] * x + a[1] * y + a[2] * z);
}

static lmp_ggx_lobes lobes_of(const oracle_gltf *s) {
    lmp_ggx_lobes lobes;
    const lmp_vec3 view = { (float)-sin(s->view), 0, (float)cos(s->view) };
    lmp_lobe_find_ggx((lmp_vec3) { 0, 0, 1 }, view, (float)sqrt(s->alpha), &lobes);
    return lobes;
}

/* Returns the radiance by the lobes. */
static double by_lobes(const oracle_gltf *s, const lmp_ggx_lobes *lobes, const double middle[3],
                       double a) {
    double sum = 0;
    for (int k = 0; k < LMP_GGX_LOBES; k++) {
        const lmp_ggx_lobe *lobe = &lobes->lobe[k];
        sum += (s->f0 * (double)lobe->f0 + s->f90 * (double)lobe->f90) *
               oracle_phong_cap((double)lobe->exponent, angle_between(middle, lobe->axis), a);
    }
    const double lost = s->f0 * (double)lobes->diffuse_f0 + s->f90 * (double)lobes->diffuse_f90;
    return sum + s->diffuse * (1 - lost) * oracle_phong_cap(1, acos(fmin(middle[2], 1)), a);
}

/* --- how far they are apart ------------------------------------------------------------------- */

typedef struct apart {
    double rms, largest; /* relative to the peak */
    double energy;       /* energy of the lobes relative to the exact one */
} apart;

/* Caps around the mirror direction out to `reach`, on one side of the plane of incidence. */
typedef struct cap_grid {
    double half_angle, reach;
    int distances, azimuths;
    double lowest; /* middles lower over the horizon are left out */
} cap_grid;

static void cap_middle(const oracle_gltf *s, const cap_grid *caps, int i, int k, double middle[3]) {
    const double rho = caps->reach * (i + 0.5) / caps->distances;
    const double psi = PI * (k + 0.5) / caps->azimuths, along = sin(rho) * cos(psi);
    middle[0] = cos(rho) * sin(s->view) + along * cos(s->view);
    middle[1] = sin(rho) * sin(psi);
    middle[2] = cos(rho) * cos(s->view) - along * sin(s->view);
}

/* Compares over caps; `weighted` means by the solid angle that a cap stands for. */
static apart compare(const oracle_gltf *s, const cap_grid *caps, bool weighted) {
    const lmp_ggx_lobes lobes = lobes_of(s);
    check_errors errors = { 0 };
    double peak = 0, squares = 0, area = 0, sum[2] = { 0, 0 }, middle[3];
    for (int i = 0; i < caps->distances; i++)
        for (int k = 0; k < caps->azimuths; k++) {
            cap_middle(s, caps, i, k, middle);
            if (middle[2] <= caps->lowest)
                continue;
            const double expected = oracle_gltf_cap(s, middle, caps->half_angle);
            const double actual = by_lobes(s, &lobes, middle, caps->half_angle);
            const double solid = sin(caps->reach * (i + 0.5) / caps->distances);
            const double weight = weighted ? solid : 1, error = actual - expected;
            check_errors_add(&errors, fabs(error));
            area += weight;
            squares += weight * error * error;
            peak = fmax(peak, expected);
            sum[0] += solid * expected;
            sum[1] += solid * actual;
        }
    return (apart) { sqrt(squares / area) / peak, errors.largest / peak, sum[1] / sum[0] };
}

/* --- tests ------------------------------------------------------------------------------------ */

/* The specular reflection of a glTF dielectric under a cap of half angle 20 degrees, 40 degrees
 * from the normal, seen from 45 degrees at azimuth 170 of it: its value is proven to 5e-10. */
static void the_exact_side_is_within_a_proven_enclosure(void **state) {
    (void)state;
    const oracle_gltf s = { 0.25, PI / 4, 0.04, 1, 0 };
    const double to = 40 * PI / 180, azimuth = 10 * PI / 180;
    const double middle[3] = { sin(to) * cos(azimuth), sin(to) * sin(azimuth), cos(to) };
    CHECK_WITHIN(fabs(oracle_gltf_cap(&s, middle, 20 * PI / 180) - 0.0154939526608), 5e-10);
}

/* The closed forms are those of a cap around the axis, and of one under the cosine above the
 * horizon. */
static void phong_lobes_over_caps_have_their_closed_forms(void **state) {
    (void)state;
    const double exponents[] = { 0.1, 1, 30, 1e6 };
    for (int i = 0; i < 4; i++) {
        const double expected = 1 - pow(cos(0.3), exponents[i] + 1);
        CHECK_WITHIN(fabs(oracle_phong_cap(exponents[i], 0, 0.3) - expected), 1e-6);
    }
    CHECK_WITHIN(fabs(oracle_phong_cap(1, 0.8, 0.3) - sin(0.3) * sin(0.3) * cos(0.8)), 1e-12);
}

/* Bounds of a white metal under caps of half angle 0.15 above the horizon: the largest and the rms
 * error of linearly transformed cosines (Heitz et al. 2016, the published table) on such caps,
 * rounded to a thousandth. */
static const struct around {
    double roughness, degrees, ltc_largest, ltc_rms;
} around[] = {
    { 0.2, 0, 0.002, 0.001 },   { 0.2, 60, 0.014, 0.006 },  { 0.2, 85, 0.208, 0.069 },
    { 0.35, 0, 0.003, 0.0017 }, { 0.35, 60, 0.023, 0.010 }, { 0.35, 75, 0.102, 0.046 },
    { 0.35, 85, 0.244, 0.143 }, { 0.5, 0, 0.010, 0.006 },   { 0.5, 60, 0.068, 0.033 },
    { 0.5, 85, 0.177, 0.094 },  { 0.7, 60, 0.145, 0.064 },  { 0.7, 85, 0.232, 0.104 },
    { 0.9, 60, 0.154, 0.041 },  { 0.9, 85, 0.220, 0.080 },
};

static void lobes_follow_ggx_around_the_mirror_direction(void **state) {
    (void)state;
    print_message("table ggx.caps\n| roughness | view | lobes | LTC |\n|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof around / sizeof *around; i++) {
        const struct around *row = &around[i];
        const double alpha = row->roughness * row->roughness;
        const oracle_gltf s = { alpha, row->degrees * PI / 180, 1, 1, 0 };
        const cap_grid caps = { 0.15, fmin(0.15 + 2.5 * alpha, PI / 2), 13, 10, sin(0.15) };
        const apart d = compare(&s, &caps, false);
        print_message("| %.2f | %.0f | %.3f %.3f | %.3f %.3f |\n", row->roughness, row->degrees,
                      d.largest, d.rms, row->ltc_largest, row->ltc_rms);
        CHECK_WITHIN(d.largest, row->ltc_largest + 0.0005);
        CHECK_WITHIN(d.rms, row->ltc_rms);
    }
}

/* A plate under one sphere, which is in another direction from every pixel: r/d, roughnesses and
 * angles of the view. */
static const double plate_sizes[] = { 0.8, 0.05, 0.2, 0.1, 0.4 };
static const double plate_roughnesses[] = { 0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 1 };
static const double plate_views[] = { 0, 50, 80 };

/* Returns the worst comparison of the sizes; adds the rms of each. */
static apart compare_plates(const oracle_gltf *s, check_errors *all) {
    apart worst = { 0, 0, 1 };
    for (int k = 0; k < check_count(2, 5); k++) {
        const double a = asin(plate_sizes[k]);
        const cap_grid caps = { a, fmin(a + 6 * s->alpha, 2), 14, 8, -sin(a) };
        const apart d = compare(s, &caps, true);
        check_errors_add(all, d.rms);
        worst.rms = fmax(worst.rms, d.rms);
        worst.largest = fmax(worst.largest, d.largest);
        worst.energy = fabs(d.energy - 1) > fabs(worst.energy - 1) ? d.energy : worst.energy;
    }
    return worst;
}

static void plates_look_as_the_specification_says(void **state) {
    (void)state;
    check_errors all = { 0 };
    print_message("table ggx.plates\n"
                  "| roughness | metal, 0° | metal, 50° | metal, 80° | dielectric, 0° "
                  "| dielectric, 50° | dielectric, 80° |\n|---|---|---|---|---|---|---|\n");
    for (int r = 0; r < 7; r += check_count(3, 1)) {
        print_message("| %.2f |", plate_roughnesses[r]);
        for (int i = 0; i < 6; i++) {
            const bool metal = i < 3;
            const double degrees = plate_views[i % 3];
            const oracle_gltf s = { plate_roughnesses[r] * plate_roughnesses[r], degrees * PI / 180,
                                    metal ? 0.9 : 0.04, 1, metal ? 0 : 0.5 };
            const apart worst = compare_plates(&s, &all);
            print_message(" %.3f %.2f %.3f |", worst.rms, worst.largest, worst.energy);
            CHECK_WITHIN(worst.rms, 0.02);
            CHECK_WITHIN(worst.largest, 0.12);
            CHECK_WITHIN(fabs(worst.energy - 1), 0.05);
        }
        print_message("\n");
    }
    print_message("rms of %ld plates: %.4f\n", all.count, check_errors_rms(&all));
    CHECK_WITHIN(check_errors_rms(&all), 0.01);
}

/* --- plates of all views ---------------------------------------------------------------------- */

/* The worst plates of some views, of roughness 0.1 to 1, metal and dielectric. */
typedef struct plate_range {
    double rms, largest;
    int plates, above_rms, above_largest; /* 2 % and 13 % */
} plate_range;

static void add_plates(double roughness, double degrees, bool metal, plate_range *range) {
    const oracle_gltf s = { roughness * roughness, degrees * PI / 180, metal ? 0.9 : 0.04, 1,
                            metal ? 0 : 0.5 };
    check_errors all = { 0 };
    const apart worst = compare_plates(&s, &all);
    range->rms = fmax(range->rms, worst.rms);
    range->largest = fmax(range->largest, worst.largest);
    range->plates++;
    range->above_rms += !(worst.rms <= 0.02);
    range->above_largest += !(worst.largest <= 0.13);
}

/* Plates lie between the nodes of the table, too, and toward the horizon, where the fits are worse:
 * the bounds are what they reach. The short form has the worst plate of each range. */
static void plates_of_all_views_err_as_the_page_says(void **state) {
    (void)state;
    static const struct {
        int from, until, step;
        double worst_roughness, worst_view, rms, largest;
    } ranges[] = { { 0, 50, 25, 0.46, 50, 0.025, 0.12 },
                   { 55, 75, 10, 0.88, 75, 0.025, 0.13 },
                   { 78, 85, 1, 0.7, 83, 0.03, 0.17 },
                   { 86, 88, 1, 0.88, 88, 0.045, 0.38 } };
    print_message(
        "table ggx.grazing\n| view | plates | worst rms | worst largest | rms above 2 %% | "
        "largest above 13 %% |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        plate_range range = { 0 };
        if (check_count(0, 1))
            for (int degrees = ranges[i].from; degrees <= ranges[i].until;
                 degrees += ranges[i].step)
                for (int k = 0; k < 16; k++)
                    for (int metal = 0; metal < 2; metal++)
                        add_plates(0.1 + 0.06 * k, degrees, metal, &range);
        else
            for (int metal = 0; metal < 2; metal++)
                add_plates(ranges[i].worst_roughness, ranges[i].worst_view, metal, &range);
        print_message("| %d to %d° | %d | %.3f | %.2f | %d | %d |\n", ranges[i].from,
                      ranges[i].until, range.plates, range.rms, range.largest, range.above_rms,
                      range.above_largest);
        CHECK_WITHIN(range.rms, ranges[i].rms);
        CHECK_WITHIN(range.largest, ranges[i].largest);
    }
}

/* The sky is uniform. What GGX loses, light that would leave after several reflections, is lost. */
static void a_white_metal_reflects_what_ggx_does(void **state) {
    (void)state;
    static const double normal[3] = { 0, 0, 1 }, degrees[] = { 0, 25, 45, 65, 85 };
    static const double roughnesses[] = { 0.1, 0.4, 0.7, 1 };
    print_message("table ggx.energy\n"
                  "| roughness | 0° | 25° | 45° | 65° | 85° |\n|---|---|---|---|---|---|\n");
    for (int r = 0; r < 4; r++) {
        print_message("| %.1f |", roughnesses[r]);
        for (int v = 0; v < 5; v++) {
            const oracle_gltf s = { roughnesses[r] * roughnesses[r], degrees[v] * PI / 180, 1, 1,
                                    0 };
            const lmp_ggx_lobes lobes = lobes_of(&s);
            const double expected = oracle_gltf_cap(&s, normal, PI / 2);
            const double actual = by_lobes(&s, &lobes, normal, PI / 2);
            print_message(" %.3f %.3f |", expected, actual);
            CHECK_WITHIN(expected, 1);
            CHECK_WITHIN(fabs(actual - expected), 0.01);
        }
        print_message("\n");
    }
}

/* Compares with ∫ (1 - v·h)^5 cos / pi. */
static void the_diffuse_part_loses_what_is_reflected(void **state) {
    (void)state;
    static const double normal[3] = { 0, 0, 1 };
    for (int degrees = 0; degrees < 90; degrees += 7) {
        const oracle_gltf s = { 1, degrees * PI / 180, 0, 0, 1 }, without = { 1, s.view, 0, 1, 0 };
        oracle_gltf with = without;
        with.diffuse = 1;
        const double diffuse =
            oracle_gltf_cap(&with, normal, PI / 2) - oracle_gltf_cap(&without, normal, PI / 2);
        const lmp_ggx_lobes lobes = lobes_of(&s);
        CHECK_WITHIN(fabs(1 - (double)lobes.diffuse_f90 - diffuse), 2e-4);
        CHECK_WITHIN(fabs((double)lobes.diffuse_f0 + (double)lobes.diffuse_f90 - 1), 1e-6);
    }
}

/* Returns the difference of lobes, each relative to the whole reflection. */
static double difference(const lmp_ggx_lobes *a, const lmp_ggx_lobes *b) {
    check_errors errors = { 0 };
    check_errors_add(&errors, fabs((double)a->diffuse_f0 - (double)b->diffuse_f0));
    for (int k = 0; k < LMP_GGX_LOBES; k++) {
        const lmp_ggx_lobe *p = &a->lobe[k], *q = &b->lobe[k];
        const double weight = (double)fmaxf(p->f0 + p->f90, q->f0 + q->f90);
        const double axis[3] = { (double)p->axis.x, (double)p->axis.y, (double)p->axis.z };
        check_errors_add(&errors, fabs((double)(p->f0 - q->f0)));
        check_errors_add(&errors, fabs((double)(p->f90 - q->f90)));
        check_errors_add(&errors, weight * angle_between(axis, q->axis));
        check_errors_add(&errors, weight * fabs((double)p->exponent / (double)q->exponent - 1));
    }
    return errors.largest;
}

static lmp_ggx_lobes lobes_at(double cosine, double roughness) {
    lmp_ggx_lobes lobes;
    const lmp_vec3 view = { (float)sqrt(1 - cosine * cosine), 0, (float)cosine };
    lmp_lobe_find_ggx((lmp_vec3) { 0, 0, 1 }, view, (float)roughness, &lobes);
    return lobes;
}

/* A step of a hundredth of the table's size moves no lobe by more than a small fraction; for a
 * mirror only the exponent changes, by 4 % a hundredth. */
static void lobes_change_smoothly_with_view_and_roughness(void **state) {
    (void)state;
    const double step = 1e-4;
    for (int i = 0; i < 4000; i++) {
        const double root = check_random_between(0, 1 - step);
        const double roughness = check_random_between(0, 1 - step);
        const lmp_ggx_lobes here = lobes_at(root * root, roughness);
        const lmp_ggx_lobes along = lobes_at((root + step) * (root + step), roughness);
        const lmp_ggx_lobes across = lobes_at(root * root, roughness + step);
        CHECK_WITHIN(difference(&here, &along), 0.02);
        CHECK_WITHIN(difference(&here, &across), 0.02);
    }
}

/* The fits were made at the table's nodes; between them lobes follow GGX, too. */
static void lobes_follow_ggx_everywhere(void **state) {
    (void)state;
    for (int i = 0; i < check_count(60, 500); i++) {
        const double root = check_random_between(0.1, 1), roughness = check_random_between(0.1, 1);
        const oracle_gltf s = { roughness * roughness, acos(root * root), 1, 1, 0 };
        const double a = fmax(0.1, 2 * s.alpha) / (1 + s.alpha);
        const cap_grid caps = { a, fmin(a + 3 * s.alpha, PI / 2), 8, 6, -sin(a) };
        const apart d = compare(&s, &caps, true);
        CHECK_WITHIN(d.rms, 0.055);
        CHECK_WITHIN(fabs(d.energy - 1), 0.08);
    }
}

/* Lobes of negative weight take from others: of lights above the horizon, even as small as points,
 * hardly anything is reflected below 0. */
static void no_small_light_is_reflected_below_nothing(void **state) {
    (void)state;
    double least = 0;
    for (int i = 0; i < check_count(100, 2000); i++) {
        const double root = check_random_between(0, 1), roughness = check_random_between(0.1, 1);
        const oracle_gltf s = { roughness * roughness, acos(root * root),
                                check_random_between(0, 1), 1, 0 };
        const lmp_ggx_lobes lobes = lobes_of(&s);
        const cap_grid caps = { 0.01, PI, 60, 12, 0 };
        double peak = 0, lowest = 0, middle[3];
        for (int k = 0; k < caps.distances * caps.azimuths; k++) {
            cap_middle(&s, &caps, k / caps.azimuths, k % caps.azimuths, middle);
            if (middle[2] <= caps.lowest)
                continue;
            const double reflected = by_lobes(&s, &lobes, middle, caps.half_angle);
            peak = fmax(peak, reflected);
            lowest = fmin(lowest, reflected);
        }
        least = fmin(least, lowest / peak);
    }
    print_message("least reflection: %.4f of the peak\n", least);
    CHECK_WITHIN(-least, 0.03);
}

static void beyond_the_table_lobes_stay_as_at_its_edge(void **state) {
    (void)state;
    const lmp_ggx_lobes smooth = lobes_at(0.5, 0.0316), rough = lobes_at(0.5, 1);
    const lmp_ggx_lobes mirror = lobes_at(0.5, -3), more = lobes_at(0.5, 7);
    CHECK_WITHIN(difference(&smooth, &mirror), 1e-3);
    CHECK_WITHIN(difference(&rough, &more), 0);
    const lmp_ggx_lobes grazing = lobes_at(0, 0.5), below = lobes_at(-0.01, 0.5);
    CHECK_WITHIN(difference(&grazing, &below), 0.02);
    for (int i = -1; i <= 1; i++) {
        const lmp_ggx_lobes ends = lobes_at(i, 0.3);
        CHECK_WITHIN(difference(&ends, &ends), 0);
    }
}

static void axes_lie_in_the_plane_of_incidence_on_the_mirror_side(void **state) {
    (void)state;
    for (int i = 0; i < 1000; i++) {
        const lmp_vec3 n = check_random_direction(), v = check_random_direction();
        const float along = n.x * v.x + n.y * v.y + n.z * v.z;
        lmp_ggx_lobes lobes;
        lmp_lobe_find_ggx(n, v, (float)check_random(), &lobes);
        const lmp_vec3 side = { n.y * v.z - n.z * v.y, n.z * v.x - n.x * v.z,
                                n.x * v.y - n.y * v.x };
        const lmp_vec3 mirror = { n.x * along - v.x, n.y * along - v.y, n.z * along - v.z };
        for (int k = 0; k < LMP_GGX_LOBES; k++) {
            const lmp_vec3 q = lobes.lobe[k].axis;
            CHECK_WITHIN(fabsf(q.x * side.x + q.y * side.y + q.z * side.z), 1e-5);
            CHECK_WITHIN(fabsf(q.x * q.x + q.y * q.y + q.z * q.z - 1), 1e-5);
            CHECK_WITHIN(-(q.x * mirror.x + q.y * mirror.y + q.z * mirror.z), 1e-5);
            assert_true(lobes.lobe[k].exponent >= 0.019f && lobes.lobe[k].exponent <= 1.1e8f);
        }
    }
}

/* The table for shaders: a lobe's four values at its nodes, then what the lobes leave of F90, and
 * nothing where a texel has no more values. */
static void texels_hold_the_lobes_and_else_nothing(void **state) {
    (void)state;
    enum { ROWS = 32, LAST = LMP_GGX_TEXELS - ROWS };
    static float texels[4 * LMP_GGX_TEXELS + 1];
    texels[4 * LMP_GGX_TEXELS] = 7;
    lmp_lobe_copy_ggx_texels(texels);
    for (int i = 0; i < ROWS; i++) {
        const float *texel = texels + 4 * (LAST + i);
        assert_true(texel[0] > 0 && texel[0] < 1 && texel[1] > 0);
        assert_true(texel[2] == 0 && texel[3] == 0);
    }
    assert_true(texels[4 * LMP_GGX_TEXELS] == 7);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_exact_side_is_within_a_proven_enclosure),
        cmocka_unit_test(phong_lobes_over_caps_have_their_closed_forms),
        cmocka_unit_test(lobes_follow_ggx_around_the_mirror_direction),
        cmocka_unit_test(plates_look_as_the_specification_says),
        cmocka_unit_test(plates_of_all_views_err_as_the_page_says),
        cmocka_unit_test(a_white_metal_reflects_what_ggx_does),
        cmocka_unit_test(the_diffuse_part_loses_what_is_reflected),
        cmocka_unit_test(lobes_follow_ggx_everywhere),
        cmocka_unit_test(lobes_change_smoothly_with_view_and_roughness),
        cmocka_unit_test(no_small_light_is_reflected_below_nothing),
        cmocka_unit_test(beyond_the_table_lobes_stay_as_at_its_edge),
        cmocka_unit_test(axes_lie_in_the_plane_of_incidence_on_the_mirror_side),
        cmocka_unit_test(texels_hold_the_lobes_and_else_nothing),
    };
    cmocka_set_test_filter(getenv("LAMPION_TEST"));
    return cmocka_run_group_tests(tests, NULL, NULL);
}

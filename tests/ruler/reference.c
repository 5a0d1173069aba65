/* SPDX-License-Identifier: MIT */
/* The reference renderer's two integrators against the ruler. */
#include "app/truth/reference_estimate.h"
#include "app/truth/reference_quadrature.h"
#include "tests/ruler/rows.h"

static const reference_vec origin = { 0, 0, 0 }, up = { 0, 0, 1 };
static const reference_band_limit whole = { .bands = 0 };

static reference_vec view_vector(const ruler_row *row) {
    double view[3];
    view_of_row(row, view);
    return (reference_vec) { view[0], view[1], view[2] };
}

static void set_lobes(reference_surface *surface, const ruler_row *row) {
    reference_material lobes = { .exponent = row->exponent };
    double *const color = row->material == RULER_PHONG ? lobes.specular : lobes.diffuse;
    color[0] = color[1] = color[2] = row->color;
    reference_surface_set(surface, &whole, &lobes, origin, up, view_vector(row));
}

static void set_ggx(reference_surface *surface, reference_ggx *ggx, const ruler_row *row) {
    static const reference_dielectric common = { { 0.04, 0.04, 0.04 }, 1 };
    const double color[3] = { row->color, row->color, row->color };
    reference_ggx_set(ggx, color, row->material == RULER_METAL, row->roughness, &common, up,
                      view_vector(row));
    *surface = (reference_surface) { .position = origin, .ray_origin = origin };
    reference_surface_shine(surface, &whole, ggx, up, view_vector(row));
}

/* Bounds the rounding of lights to float32: an exponent of 10 000 shows that of their directions,
 * and the rim of a sphere that is nearly touched moves by more than its radius does. */
static double rounding(const ruler_row *row) {
    const bool outside = row->light == RULER_SPHERE && row->size < 1;
    const double rim = outside ? 6e-8 / sqrt(1 - row->size * row->size) * ruler_scale(row) : 0;
    return (2e-6 + 1e-7 * row->exponent) * (row->value + 0.01 * ruler_scale(row)) + rim;
}

static void quadrature_of_lobes_is_within_the_bounds(void **state) {
    (void)state;
    ruler_table table = open_table();
    const int step = check_count(3, 1);
    double worst = 0;
    for (int i = 0; i < table.count; i += step) {
        const ruler_row *const row = &table.rows[i];
        const scene_light light = { .emitter = light_of_row(row) };
        reference_surface surface;
        double radiance[3];
        if (row->material >= RULER_METAL)
            continue;
        set_lobes(&surface, row);
        reference_quadrature(&surface, &light, 1, radiance);
        const double error = fabs(radiance[1] - row->value);
        worst = fmax(worst, error / (row->value + 0.01 * ruler_scale(row)));
        if (!(error <= rounding(row) + row->radius))
            fail_msg("row %d: %.12g, not %.12g", row->id, radiance[1], row->value);
    }
    print_message("the largest error is %.2g\n", worst);
    ruler_table_free(&table);
}

static reference_result estimate(const ruler_row *row, int samples) {
    const scene_light light = { .emitter = light_of_row(row) };
    const reference_stop stop = { .samples = samples };
    reference_estimator estimator;
    reference_surface surface;
    reference_ggx ggx;
    if (row->material < RULER_METAL)
        set_lobes(&surface, row);
    else
        set_ggx(&surface, &ggx, row);
    assert_true(reference_estimator_create(&estimator, &light, 1));
    const reference_result result =
        reference_estimate(&estimator, &surface, &stop, (uint64_t)row->id);
    reference_estimator_free(&estimator);
    return result;
}

#define SAMPLES 1024

/* Bounds the light so rare that no sample met it, which no standard error shows either. */
static double unseen(const ruler_row *row) {
    return 5.0 / SAMPLES * (row->value + 0.1 * ruler_scale(row));
}

/* A few samples of rare bright lights are not normally distributed: a few rows may differ by more
 * than 5 standard errors. */
static void estimates_are_within_bound_and_noise(void **state) {
    (void)state;
    ruler_table table = open_table();
    const int step = check_count(3, 1);
    int count = 0, beyond = 0, far = 0;
    for (int i = 0; i < table.count; i += step) {
        const ruler_row *const row = &table.rows[i];
        const reference_result r = estimate(row, SAMPLES);
        const double error =
            fabs(r.mean[1] - row->value) - row->radius - rounding(row) - unseen(row);
        count++;
        beyond += !(error <= 3 * r.standard_error[1]);
        far += !(error <= 5 * r.standard_error[1]);
        if (!(error <= 5 * r.standard_error[1]))
            print_message("row %d: %.9g +- %.2g, not %.9g\n", row->id, r.mean[1],
                          r.standard_error[1], row->value);
    }
    print_message("of %d rows %d are beyond 3 standard errors, %d beyond 5\n", count, beyond, far);
    assert_in_range(beyond, 0, count / 100);
    assert_in_range(far, 0, count / 300);
    ruler_table_free(&table);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quadrature_of_lobes_is_within_the_bounds),
        cmocka_unit_test(estimates_are_within_bound_and_noise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

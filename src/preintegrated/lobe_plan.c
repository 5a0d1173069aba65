/* SPDX-License-Identifier: MIT */
/* lobe_plan.c - which slices of the exponent a preintegrated lobe holds, and the step of each one's
 * grid.
 *
 * Three regimes, told apart by x = bands²/(2e), the logarithm by which a Phong lobe has fallen at
 * the truncated:
 *   cusp    e < CUSP: max(t, 0)^e is not smooth at t = 0; below e = 1 the full resolution of the
 *           bands is needed there, above it the e-th root of the error.
 *   smooth  large x: the lobe is nearly a Gaussian of width 1/sqrt(e). Grids scaled by that width
 *           make slices alike, so few are needed.
 *   truncated     x < TRUNCATED: the series rings with the period of its last band, whatever e.
 * Steps are a fixed part of that period; slices follow exp(-x).
 *
 * The constants were chosen by changing each and measuring the error (docs/preintegration.md).
 */
#include "src/preintegrated/lobe_plan.h"

#include <math.h>
#include <string.h>

#define CUSP             4.0
#define TRUNCATED        12.0
#define STEP_TRUNCATED   0.95 /* times 1/(bands + 1): the cap's solid angle adds a degree */
#define STEP_SMOOTH      0.54 /* times the width */
#define STEP_CUSP        0.02 /* per unit of log e, times x/(x + TRUNCATED_KNEE) */
#define SLICES_TRUNCATED 6.5  /* for few bands, which feel every exponent: 1 + this/bands² more */
#define SLICES_FEW       16   /* more where few bands feel every exponent: 1 + this/bands² */
#define TRUNCATED_KNEE   1.16
#define SLICES           3.0   /* per unit of log e, of smooth lobes */
#define SLICES_MIN       0.001 /* keeps the remap rising; 0.01 errs by 0.5 % at 10 bands */
#define SLICES_CUSP      6.7   /* per unit of e at e = 1 */
#define CUSP_FADE        1.2
#define WIDTH_OFFSET     1.5

static double slice_density(const lmp_preintegrated_lobe_info *info, double e) {
    const double x = (double)info->bands * info->bands / (2 * e);
    const double few = 1 + SLICES_FEW / (double)(info->bands * info->bands);
    const double truncated = few * SLICES_TRUNCATED * x / (x + TRUNCATED_KNEE) * (1 + e) / e;
    const double cusp = e < 2 * CUSP ? SLICES_CUSP * (1 + e) / pow(fmax(e, 1), CUSP_FADE) : 0;
    return fmax(fmax(x < 1.6 * TRUNCATED ? truncated : SLICES, cusp), SLICES_MIN);
}

static double exponent_at(double entry) {
    const double octave = floor(entry / 16);
    return ldexp(1 + (entry - 16 * octave) / 16, (int)octave) - 1;
}

static float error_scale(const lmp_preintegrated_lobe_info *info, double power) {
    return (float)pow((double)info->error / (double)LMP_PREINTEGRATED_LOBE_ERROR_DEFAULT, power);
}

/* Computes the slice coordinate at every entry, the integral of the density; returns the last
 * slice. */
static int plan_remap(lmp_preintegrated_lobe *plan) {
    double at[LMP_PREINTEGRATED_LOBE_REMAP_COUNT] = { 0 };
    const double fewer = (double)error_scale(&plan->info, -0.5);
    for (int i = 1; i < LMP_PREINTEGRATED_LOBE_REMAP_COUNT; i++) {
        const double a = exponent_at(i - 1), b = exponent_at(i);
        at[i] =
            at[i - 1] + fewer * slice_density(&plan->info, (a + b) / 2) * log((1 + b) / (1 + a));
    }
    const int last = (int)ceil(at[LMP_PREINTEGRATED_LOBE_REMAP_COUNT - 1]);
    for (int i = 0; i < LMP_PREINTEGRATED_LOBE_REMAP_COUNT; i++)
        plan->remap[i] = (float)(at[i] * last / at[LMP_PREINTEGRATED_LOBE_REMAP_COUNT - 1]);
    plan->remap[LMP_PREINTEGRATED_LOBE_REMAP_COUNT - 1] = (float)last;
    return last;
}

/* Finds the exponents whose slice coordinate is an integer. */
void lmpi_preintegrated_lobe_exponents(lmp_preintegrated_lobe *plan) {
    const int last = (int)plan->info.cell_count;
    int i = 0;
    for (int k = 0; k <= last; k++) {
        while (i < LMP_PREINTEGRATED_LOBE_REMAP_COUNT - 2 && plan->remap[i + 1] < (float)k)
            i++;
        const double a = (double)plan->remap[i], b = (double)plan->remap[i + 1];
        plan->exponents[k] = (float)exponent_at(i + fmin((k - a) / (b - a), 1));
    }
}

static void plan_cell(lmp_preintegrated_lobe *plan, int k) {
    const double low = (double)plan->exponents[k], high = (double)plan->exponents[k + 1];
    const double n = plan->info.bands, truncated_from = n * n / (2 * TRUNCATED);
    const double finer = (double)error_scale(&plan->info, 0.25);
    const double width = 1 / sqrt(high + WIDTH_OFFSET);
    const double step_truncated = finer * STEP_TRUNCATED / (n + 1),
                 step_smooth = finer * STEP_SMOOTH * width;
    const double step_cusp = pow(STEP_CUSP * (double)error_scale(&plan->info, 1), 1 / fmax(low, 1));
    lmp_preintegrated_lobe_cell *cell = &plan->cells[k];
    if (low < 1 || low >= truncated_from)
        cell->offset = (float)(1 / step_truncated);
    else if (low < CUSP)
        cell->offset = (float)(1 / fmax(fmin(step_cusp, step_smooth), step_truncated));
    else
        cell->scale = (float)(width / (high > truncated_from ? step_truncated
                                                             : fmax(step_smooth, step_truncated)));
}

lmp_result lmpi_preintegrated_lobe_plan(lmp_preintegrated_lobe *plan) {
    const int last = plan_remap(plan);
    if (last > LOBE_CELLS_MAX)
        return LMP_ERROR_ARGUMENT;
    plan->info.cell_count = (uint32_t)last;
    lmpi_preintegrated_lobe_exponents(plan);
    for (int k = 0; k < last; k++)
        plan_cell(plan, k);
    lmpi_preintegrated_lobe_layout(plan);
    return LMP_OK;
}

void lmpi_preintegrated_lobe_layout(lmp_preintegrated_lobe *plan) {
    lmp_preintegrated_lobe_info *info = &plan->info;
    info->width2 = 1 / ((float)info->bands * (float)info->bands);
    uint32_t pairs = 0;
    for (uint32_t k = 0; k < info->cell_count; k++) {
        lmp_preintegrated_lobe_cell *cell = &plan->cells[k];
        /* A little finer than finest, so that no rounding of an angle leads outside. */
        const double finest =
            (double)lmp_lookup_density(cell->scale, cell->offset, plan->exponents[k + 1]) * 1.00001;
        cell->first = pairs;
        cell->rows = (uint32_t)(finest * LMPI_PREINTEGRATED_PI / 2) + 4;
        cell->columns = (uint32_t)(finest * LMPI_PREINTEGRATED_PI) + 4;
        pairs += cell->rows * cell->columns;
    }
    info->pair_count = pairs;
    info->bytes = pairs * 2 * sizeof(int16_t) + sizeof plan->remap +
                  info->cell_count * sizeof(lmp_preintegrated_lobe_cell);
}

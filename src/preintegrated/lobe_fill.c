/* SPDX-License-Identifier: MIT */
/* lobe_fill.c - one slice of a preintegrated lobe through spherical harmonics: the sum over bands
 * at every node, then the coefficients of the cubic B-spline through the nodes. */
#include "src/preintegrated/lobe_fill.h"

#include "src/base/host.h"
#include "src/preintegrated/spline.h"

#include <lampion/lobe.h>

#include <math.h>
#include <string.h>

/* Nodes past the far ends: what is unknown of the spline there has faded by 0.27^10 = 2e-6, a
 * thirtieth of the unit of 16 bits. */
#define MARGIN 10

/* The grid of a slice while it is computed: nodes 0 … rows-1 by 0 … columns-1. */
typedef struct slice_grid {
    int bands;
    size_t rows, columns;
    double step;
    float *band;   /* bands * columns: P_l(cos g) */
    float *cap;    /* rows * bands: weight of band l at a */
    float *values; /* rows * columns */
} slice_grid;

/* Computes weight_l mean_l(a), the lobe's series term by term, averaged over the cap and times the
 * two solid angles. With cos a = c, mean_l = R_l/R_0 = R_l (1 + c)/2 (light.h), which is even in a;
 * so the nodes past pi/2 are exact as well. */
static void cap_weights(const slice_grid *grid, const float *series, double lobe_angle) {
    for (size_t i = 0; i < grid->rows; i++) {
        const double half_sine = sin((double)i * grid->step / 2), t = 2 * half_sine * half_sine;
        const double angle = 2 * LMPI_PREINTEGRATED_PI * t + lobe_angle;
        double r = 1, d = 0, plain = 0;
        for (int l = 0; l < grid->bands; l++) {
            if (l >= 2 && t <= 1) {
                d = ((l - 2) * d - (2 * l - 1) * t * r) / (l + 1);
                r += d;
            } else if (l >= 2) {
                const double next = ((2 * l - 1) * (1 - t) * r - (l - 2) * plain) / (l + 1);
                plain = r;
                r = next;
            }
            const double mean = l == 0 ? 1 : r * (1 - t / 2);
            grid->cap[i * (size_t)grid->bands + (size_t)l] =
                (float)((double)series[l] * mean * angle);
        }
    }
}

static void legendre(const slice_grid *grid) {
    for (size_t j = 0; j < grid->columns; j++) {
        const double u = cos((double)j * grid->step);
        double p0 = 0, p1 = 1;
        for (int l = 0; l < grid->bands; l++) {
            grid->band[(size_t)l * grid->columns + j] = (float)p1;
            const double next = ((2 * l + 1) * u * p1 - l * p0) / (l + 1);
            p0 = p1;
            p1 = next;
        }
    }
}

/* Computes the matrix product values = cap × band. */
static void sum_bands(const slice_grid *grid) {
    memset(grid->values, 0, grid->rows * grid->columns * sizeof(float));
    for (size_t i = 0; i < grid->rows; i++) {
        float *restrict row = grid->values + i * grid->columns;
        const float *cap = grid->cap + i * (size_t)grid->bands;
        for (int l = 0; l < grid->bands; l++) {
            const float *restrict band = grid->band + (size_t)l * grid->columns;
            for (size_t j = 0; j < grid->columns; j++)
                row[j] += cap[l] * band[j];
        }
    }
}

static int16_t quantize(float value) {
    const float units = value / LMP_PREINTEGRATED_LOBE_UNIT;
    return (int16_t)lrintf(fminf(fmaxf(units, -32767), 32767));
}

static void store(const slice_grid *grid, const lmp_preintegrated_lobe_cell *cell, int16_t *pairs) {
    for (size_t i = 0; i < cell->rows; i++) {
        const float *row = grid->values + (i == 0 ? 1 : i - 1) * grid->columns;
        for (size_t j = 0; j < cell->columns; j++)
            pairs[2 * (i * cell->columns + j)] = quantize(row[j == 0 ? 1 : j - 1]);
    }
}

static void lobe_series(const lmp_preintegrated_lobe_info *info, float exponent, float *series) {
    float weights[LMP_BANDS_MAX];
    lmp_lobe_make_phong(info->bands, exponent, series);
    lmp_sh_make_window(info->bands, info->window, info->window_size, weights);
    for (int l = 0; l < info->bands; l++)
        series[l] *= weights[l] * (float)((2 * l + 1) / (4 * LMPI_PREINTEGRATED_PI));
}

lmp_result lmpi_preintegrated_lobe_fill(lmp_preintegrated_lobe *lobe, uint32_t cell_index,
                                        uint32_t side) {
    const lmp_preintegrated_lobe_cell *cell = &lobe->cells[cell_index];
    const float exponent = lobe->exponents[cell_index + side];
    slice_grid grid = { .bands = lobe->info.bands,
                        .rows = cell->rows + MARGIN,
                        .columns = cell->columns + MARGIN,
                        .step =
                            1 / (double)lmp_lookup_density(cell->scale, cell->offset, exponent) };
    const size_t bands = (size_t)grid.bands;
    float *memory =
        lmpi_allocate(&lobe->host, sizeof(float) * (bands * grid.columns + grid.rows * bands +
                                                    grid.rows * grid.columns));
    if (!memory)
        return LMP_ERROR_MEMORY;
    grid.band = memory;
    grid.cap = grid.band + bands * grid.columns;
    grid.values = grid.cap + grid.rows * bands;

    float series[LMP_BANDS_MAX];
    lobe_series(&lobe->info, exponent, series);
    cap_weights(&grid, series, (double)lmp_lookup_solid_angle(exponent, lobe->info.width2));
    legendre(&grid);
    sum_bands(&grid);
    for (size_t i = 0; i < grid.rows; i++)
        lmpi_spline_coefficients(grid.values + i * grid.columns, grid.columns, 1);
    lmpi_spline_coefficients(grid.values, grid.rows, grid.columns);
    store(&grid, cell, lobe->coefficients + 2 * (size_t)cell->first + side);
    lmpi_release(&lobe->host, memory);
    return LMP_OK;
}

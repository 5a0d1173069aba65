/* SPDX-License-Identifier: MIT */
/* brdf_rows.c - where the rows of slices lie: the map from the angle to the row coordinate, and the
 * choice of how fast rows become sparse far from the rim of the cap. */
#include "src/preintegrated/brdf_rows.h"

#include "src/base/host.h"
#include "src/preintegrated/brdf_rings.h"
#include "src/preintegrated/brdf_thin.h"

double lmpi_preintegrated_brdf_row_of(const brdf_series *series, double x) {
    const double reach = (double)series->reach;
    return x *
           (reach / ((double)series->width * sqrt(x * x + reach * reach)) + (double)series->slope);
}

double lmpi_preintegrated_brdf_x_of(const brdf_series *series, double s) {
    const double reach = (double)series->reach, slope = (double)series->slope;
    const double dense = 1 / (double)series->width;
    double x = s / (dense + slope);
    for (int i = 0; i < 100; i++) {
        const double root = sqrt(x * x + reach * reach);
        const double derivative = dense * reach * reach * reach / (root * root * root) + slope;
        const double step = (lmpi_preintegrated_brdf_row_of(series, x) - s) / derivative;
        /* The map bends: a full step from the flat part would overshoot for ever. */
        const double most = reach + fabs(x) / 2;
        x -= fmax(-most, fmin(step, most));
        if (fabs(step) < 1e-12)
            break;
    }
    return x;
}

double lmpi_preintegrated_brdf_rim_of(const brdf_series *series, double a) {
    const double radius = (double)series->radius;
    return a * a / (sqrt(a * a + radius * radius) + radius);
}

double lmpi_preintegrated_brdf_angle_at(int step) {
    const double fraction = (double)step / BRDF_CAP_STEPS * (LMPI_PREINTEGRATED_PI / 2) /
                            (LMPI_PREINTEGRATED_PI / 2 + 0.5);
    return 0.5 * fraction / (1 - fraction);
}

/* --- the choice ------------------------------------------------------------------------------- */

/* The rows of one half angle at half their step, by which a choice is tested. */
typedef struct row_probe {
    size_t rows, columns;
    double *g;                         /* angles of the rows */
    float *memory;                     /* the values, then memory for coefficients */
    float *values[BRDF_STEPS_MAX + 1]; /* of each view */
} row_probe;

static lmp_result probe_create(const brdf_views *views, double angle, row_probe *probe) {
    const brdf_series *series = views->series;
    const double rim = lmpi_preintegrated_brdf_rim_of(series, angle);
    const double low = lmpi_preintegrated_brdf_row_of(series, -rim) / BRDF_ROW_STEP - BRDF_MARGIN;
    const double high =
        lmpi_preintegrated_brdf_row_of(series, LMPI_PREINTEGRATED_PI - rim) / BRDF_ROW_STEP +
        BRDF_MARGIN;
    const size_t rows = 2 * (size_t)(ceil(high) - floor(low)) + 1;
    const size_t columns = (size_t)views->columns[0], size = 3 * rows * columns;
    *probe = (row_probe) { .rows = rows, .columns = columns };
    probe->g = lmpi_allocate(&series->host, rows * sizeof *probe->g);
    probe->memory = lmpi_allocate(&series->host, (views->count + 1) * size * sizeof *probe->memory);
    if (!probe->g || !probe->memory)
        return LMP_ERROR_MEMORY;
    for (size_t i = 0; i < rows; i++)
        probe->g[i] =
            lmpi_preintegrated_brdf_x_of(series, BRDF_ROW_STEP * (floor(low) + (double)i / 2)) +
            rim;
    for (size_t v = 0; v < views->count; v++)
        probe->values[v] = probe->memory + v * size;
    return lmpi_preintegrated_brdf_sum(views, angle, probe->g, rows, probe->values);
}

/* Tests, for some views and one half angle, whether rows at the fine grid's step reproduce the rows
 * between them. */
static lmp_result check_rows(const brdf_views *views, double angle, float error, bool *hold) {
    row_probe probe;
    const lmp_result result = probe_create(views, angle, &probe);
    for (size_t v = 0; result == LMP_OK && *hold && v < views->count; v++) {
        const brdf_grid at = { .values = probe.values[v],
                               .rows = probe.rows,
                               .columns = probe.columns,
                               .coefficients =
                                   probe.memory + views->count * 3 * probe.rows * probe.columns };
        const float limit = (float)BRDF_TOLERANCE * error * lmpi_preintegrated_brdf_largest(&at);
        *hold = lmpi_preintegrated_brdf_rows_hold(&at, 2, limit);
    }
    lmpi_release(&views->series->host, probe.g);
    lmpi_release(&views->series->host, probe.memory);
    return result;
}

lmp_result lmpi_preintegrated_brdf_choose_rows(brdf_series *series, float error) {
    /* reach in widths and slope in 1/widths, in ascending order of the number of rows */
    static const float choices[][2] = { { 2, 0.02f }, { 4, 0.02f }, { 4, 0.05f }, { 8, 0.05f },
                                        { 8, 0.1f },  { 16, 0.1f }, { 16, 0.2f }, { 16, 0.4f } };
    static const double angles[] = { 0, 0.05, 0.3, 1.2 };
    enum { CHOICES = sizeof choices / sizeof *choices, ANGLES = sizeof angles / sizeof *angles };
    const int at[3] = {
        lmpi_preintegrated_brdf_view_at(series, 1, 4),
        lmpi_preintegrated_brdf_view_at(series, 3, 4),
        lmpi_preintegrated_brdf_view_at(series, 19, 20),
    };
    brdf_views views;
    lmp_result result =
        lmpi_preintegrated_brdf_views(series, at, 3, series->mirrored ? 9 : 16, &views);
    bool hold = false;
    for (int i = 0; result == LMP_OK && !hold && i < CHOICES; i++) {
        series->reach = choices[i][0] * series->width;
        series->slope = choices[i][1] / series->width;
        hold = true;
        for (int k = 0; result == LMP_OK && hold && k < ANGLES; k++)
            result = check_rows(&views, angles[k], error, &hold);
    }
    lmpi_preintegrated_brdf_views_free(&views);
    return result;
}

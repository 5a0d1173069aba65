/* SPDX-License-Identifier: MIT */
#include "app/paper/legendre.h"
#include "app/paper/paper.h"
#include "app/timing/timing.h"
#include "app/zonal/zonal.h"

#include <lampion/light.h>

#include <math.h>
#include <stdlib.h>

enum { BANDS = 10, ANGLES = 400, RUNS = 9, CALLS = 20000 };

/* Largest error over half angles from `least` degrees to 90, in parts of each light's largest
 * coefficient. */
static double worst_error(const zonal_table *table, double least) {
    double worst = 0;
    for (int i = 1; i <= ANGLES; i++) {
        const double a = M_PI / 2 * pow(least / 90, 1 - (double)i / ANGLES), s = sin(a);
        float z[BANDS];
        double largest = 0, error = 0;
        if (table)
            zonal_table_eval(table, (float)cos(a), z);
        else
            lmp_sphere_zonal(BANDS, (float)s, 1, z);
        for (int l = 0; l < BANDS; l++) {
            const double truth = paper_zonal(l, a);
            largest = fmax(largest, fabs(truth));
            error = fmax(error, fabs((double)z[l] - truth));
        }
        worst = fmax(worst, error / largest);
    }
    return worst;
}

/* Median nanoseconds of one evaluation of all bands. */
static double time_evaluation(const zonal_table *table) {
    double times[RUNS];
    volatile float sink = 0;
    for (int run = 0; run < RUNS; run++) {
        const double start = timing_now();
        for (int i = 0; i < CALLS; i++) {
            float z[BANDS];
            const float s = (float)(i + 1) / (CALLS + 1);
            if (table)
                zonal_table_eval(table, s, z);
            else
                lmp_sphere_zonal(BANDS, s, 1, z);
            sink = sink + z[BANDS - 1];
        }
        times[run] = (timing_now() - start) * 1e9 / CALLS;
    }
    return timing_of(times, RUNS).median;
}

bool paper_step_table(paper *p, cli_error *error) {
    const int sizes[] = { 64, 256, 1024, 4096, 16384 };
    page_table table;
    page_text(
        &p->page,
        "The paper reports that tabulating the Z<sub>l</sub> saves about half a millisecond a "
        "frame on its GPU, for some tens of kilobytes. Ten bands, one evaluation on one "
        "CPU core; errors in parts of each light's largest coefficient. A table is entered "
        "with cos a, which in float32 hardly tells small lights apart, however large the table.");
    if (!page_table_begin(&p->page, &table, "tabulated",
                          "form|kilobytes|ns|largest error, a from 10° to 90°|from 0.1°", error))
        return false;
    page_table_row(&table, "analytic|0|%.0f|%.1e|%.1e", time_evaluation(NULL),
                   worst_error(NULL, 10), worst_error(NULL, 0.1));
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        zonal_table *zonal = zonal_table_create(BANDS, sizes[i]);
        if (!zonal)
            return cli_fail(error, NULL, "out of memory");
        page_table_row(&table, "table of %d|%.1f|%.0f|%.1e|%.1e", sizes[i],
                       sizes[i] * BANDS * 4 / 1024.0, time_evaluation(zonal),
                       worst_error(zonal, 10), worst_error(zonal, 0.1));
        zonal_table_destroy(zonal);
    }
    return page_table_end(&table, error);
}

/* SPDX-License-Identifier: MIT */
#include "app/base/timing.h"
#include "app/render/zonal.h"
#include "app/study/paper.h"
#include "app/study/paper_legendre.h"

#include <lampion/light.h>

#include <math.h>
#include <stdlib.h>

enum { BANDS = 10, ANGLES = 2000, RUNS = 9, CALLS = 20000 };

/* Finds the largest errors over half angles from 0.1 to 90 degrees, and over those from 10 degrees
 * on, relative to each light's largest coefficient. */
static void worst_errors(const zonal_table *table, double worst[2]) {
    worst[0] = worst[1] = 0;
    for (int i = 0; i <= ANGLES; i++) {
        const double degrees = 0.1 * pow(900, (double)i / ANGLES), a = degrees * M_PI / 180;
        float z[BANDS];
        double largest = 0, error = 0;
        if (table)
            zonal_table_eval(table, (float)cos(a), z);
        else
            lmp_sphere_project_zonal(BANDS, (float)sin(a), 1, z);
        for (int l = 0; l < BANDS; l++) {
            const double truth = paper_zonal(l, a);
            largest = fmax(largest, fabs(truth));
            error = fmax(error, fabs((double)z[l] - truth));
        }
        for (int range = 0; range < 2; range++)
            if (range == 0 || degrees >= 10)
                worst[range] = fmax(worst[range], error / largest);
    }
}

/* Returns the median nanoseconds of one evaluation of all bands or, if `whole`, of the whole
 * projection, Eq. 13. */
static double time_evaluation(const zonal_table *table, bool whole) {
    double times[RUNS];
    volatile float sink = 0;
    for (int run = 0; run < RUNS; run++) {
        const double start = timing_now();
        for (int i = 0; i < CALLS; i++) {
            float z[BANDS * BANDS];
            const float s = (float)(i + 1) / (CALLS + 1);
            if (table)
                zonal_table_eval(table, s, z);
            else if (whole)
                lmp_sphere_project(BANDS, (lmp_vec3) { 0.6f, 0, 0.8f }, s, (lmp_vec3) { 0, 0, 0 },
                                   z);
            else
                lmp_sphere_project_zonal(BANDS, s, 1, z);
            sink = sink + z[BANDS - 1];
        }
        times[run] = (timing_now() - start) * 1e9 / CALLS;
    }
    return timing_of(times, RUNS).median;
}

static bool write_rows(page_table *table, base_error *error) {
    static const int sizes[] = { 64, 256, 1024, 4096, 16384 };
    double worst[2];
    worst_errors(NULL, worst);
    page_table_row(table, "analytic|0|%.0f|%.1e|%.1e", time_evaluation(NULL, false), worst[1],
                   worst[0]);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        zonal_table *zonal = zonal_table_create(BANDS, sizes[i]);
        if (!zonal)
            return base_fail(error, NULL, "out of memory");
        worst_errors(zonal, worst);
        page_table_row(table, "table of %d|%.1f|%.0f|%.1e|%.1e", sizes[i],
                       sizes[i] * BANDS * 4 / 1024.0, time_evaluation(zonal, false), worst[1],
                       worst[0]);
        zonal_table_destroy(zonal);
    }
    return true;
}

bool paper_step_table(paper *p, base_error *error) {
    page_table table;
    page_text(
        &p->page,
        "The paper reports that tabulating the Z<sub>l</sub> gains about half a millisecond a "
        "frame on its GPU, for some tens of kilobytes, and that this is not worth it, for the "
        "evaluation of Y<sub>lm</sub> (Eq. 13) dominates. Ten bands, one evaluation on one CPU "
        "core; "
        "errors in parts of each light's largest coefficient. A table is entered with cos a, which "
        "in float32 hardly tells small lights apart, however large the table.");
    if (!page_table_begin(&p->page, &table, "tabulated",
                          "form|kilobytes|ns|largest error, a from 10° to 90°|from 0.1° to 90°",
                          error) ||
        !write_rows(&table, error) || !page_table_end(&table, error))
        return false;
    const double zonal = time_evaluation(NULL, false), whole = time_evaluation(NULL, true);
    zonal_table *tabulated = zonal_table_create(BANDS, 1024);
    if (!tabulated)
        return base_fail(error, NULL, "out of memory");
    const double looked_up = time_evaluation(tabulated, false);
    zonal_table_destroy(tabulated);
    paper_claim_add(p, zonal < 0.5 * whole ? PAPER_HOLDS : PAPER_FAILS,
                    (paper_claim) { "the zonal coefficients cost little beside the spherical "
                                    "harmonics of Eq. 13",
                                    "no number", "one CPU core, the library's scalar calls",
                                    "n values against n²" },
                    "%.0f of %.0f ns a light, 10 bands", zonal, whole);
    const bool little = zonal - looked_up < 0.1 * whole;
    paper_claim_add(
        p, little ? PAPER_HOLDS : PAPER_ELSEWHERE,
        (paper_claim) { "tabulating them saves no significant time", "half a millisecond a frame",
                        "one CPU core; the paper judged by frames of a GPU",
                        little ? "the recurrence takes a few operations a band"
                               : "a table saves more than a tenth of a light's time on this core, "
                                 "which says nothing of a GPU's, and errs where lights are small" },
        "%.0f ns a light, %.0f by a table of 1024, of %.0f for all", zonal, looked_up, whole);
    page_text(
        &p->page,
        "All coefficients of a light take %.0f ns, of which the Z<sub>l</sub> are %.0f: <b>%s</b>.",
        whole, zonal,
        zonal < 0.5 * whole ? "Y<sub>lm</sub> dominates, as the paper says"
                            : "Y<sub>lm</sub> does not dominate here");
    return true;
}

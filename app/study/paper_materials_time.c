/* SPDX-License-Identifier: MIT */
/* Figure 6, timed. */
#include "app/study/paper_materials.h"

static const paper_method methods[] = {
    { DEVICE_CPU, METHOD_ZONAL, "library: coefficients", false },
    { DEVICE_GPU, METHOD_COEFFICIENTS, "library: coefficients", false },
};
enum { METHODS_TIMED_HERE = sizeof methods / sizeof *methods };

/* Returns the paper's time, which it gives for (b) to (e) at 10 bands and for (d) at 20. */
static const char *said_of(int material, int bands) {
    if (bands == 10)
        return material > 0 ? "below 3" : NULL;
    return material == 3 && bands == 20 ? "105" : NULL;
}

/* Whether a material is timed by a method: only (d) is by software OpenGL. */
static bool is_timed(const materials_figure *f, int material, const paper_method *method) {
    return method->device == DEVICE_CPU ||
           (f->devices.has_gl && (!f->devices.gl.gl.software || material == 3));
}

typedef struct row {
    int material, bands;
    const paper_method *by;
    paper_times ms;
    double ns;
} row;

static bool time_all(const paper *p, const materials_figure *f, row *rows, int *count,
                     base_error *error) {
    const int lights = (int)f->devices.world.light_count;
    *count = 0;
    for (int i = 0; i < PAPER_MATERIALS; i++)
        for (int c = 0; c < MATERIALS_COUNTS; c++)
            for (int m = 0; m < METHODS_TIMED_HERE; m++) {
                const render_frame frame =
                    paper_frame(f->size, methods[m].method, materials_bands[c]);
                row *r = &rows[*count];
                *r = (row) { .material = i, .bands = materials_bands[c], .by = &methods[m] };
                if (!said_of(i, r->bands) || !is_timed(f, i, &methods[m]))
                    continue;
                if (!paper_time(&f->devices, methods[m].device, &frame, p->data.materials[i].value,
                                &r->ms, error))
                    return false;
                r->ns = paper_nanoseconds(r->ms.total, f->size, lights, r->bands);
                ++*count;
            }
    return true;
}

/* Adds the claim for the slowest of (b) to (e), each by its fastest method. */
static void claim_time(paper *p, const materials_figure *f, const row *rows, int count) {
    paper_fastest slowest = { .by = NULL };
    char on[128];
    paper_name_materials(&p->data, 1, 4, on, sizeof on);
    for (int i = 1; i < PAPER_MATERIALS; i++) {
        paper_fastest own = { .by = NULL };
        for (int k = 0; k < count; k++) {
            const paper_fastest frame = {
                rows[k].ms, rows[k].ns, rows[k].by, { f->size[0], f->size[1] }
            };
            if (rows[k].material == i && rows[k].bands == 10)
                paper_keep_fastest(&own, &frame);
        }
        if (!slowest.by || own.ns > slowest.ns)
            slowest = own;
    }
    paper_claim_time(p, &f->devices, &slowest, paper_nanoseconds(3, materials_size, 10, 10), on,
                     (paper_claim) { .text = "measured materials under 10 lights on 10 bands in "
                                             "real time",
                                     .number = "below 3 ms at 600×816: 0.061 ns" });
}

bool materials_write_times(paper *p, const materials_figure *f, base_error *error) {
    row rows[PAPER_MATERIALS * MATERIALS_COUNTS * METHODS_TIMED_HERE];
    page_table table;
    int count;
    if (!time_all(p, f, rows, &count, error))
        return false;
    paper_name_devices(p, &f->devices, f->size);
    if (!page_table_begin(&p->page, &table, "figure6-times",
                          "figure|material|bands|device|shading, ms|frame, ms|frame, ns|paper, ms",
                          error))
        return false;
    for (int k = 0; k < count; k++) {
        const row *r = &rows[k];
        const paper_material *m = &p->data.materials[r->material];
        page_table_row(&table, "%s|%s|%d|%s|%.1f|%.1f|%.3g|%s", m->letter, m->label, r->bands,
                       r->by->device == DEVICE_GPU ? "OpenGL" : "CPU", r->ms.shade, r->ms.total,
                       r->ns, said_of(r->material, r->bands));
    }
    claim_time(p, f, rows, count);
    return page_table_end(&table, error);
}

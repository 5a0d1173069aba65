/* SPDX-License-Identifier: MIT */
/* Frames timed on the graphics device. */
#include "app/material/material.h"
#include "app/paper/paper.h"

#include <stdlib.h>
#include <string.h>

enum { RUNS = 5 };

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Has the renderer shade one material of the scene by a table, which the caller destroys. */
static bool use_material(gpu_renderer *renderer, const scene *world, const gpu_frame *frame,
                         const char *assignment, lmp_brdf_table **table, cli_error *error) {
    const lmp_brdf_table_desc desc = { .bands = frame->bands,
                                       .azimuths = LMP_BRDF_AZIMUTHS_DEFAULT,
                                       .window = frame->window };
    const size_t length = strcspn(assignment, "=");
    material opened;
    int *uses = malloc((world->material_count + 1) * sizeof *uses);
    if (!uses)
        return cli_fail(error, NULL, "out of memory");
    for (size_t i = 0; i < world->material_count; i++) {
        const char *name = world->materials[i].name;
        uses[i] = strlen(name) == length && strncmp(name, assignment, length) == 0 ? 0 : -1;
    }
    bool ok = material_open(assignment + length + 1, &opened, error);
    if (ok) {
        ok = material_bake(&opened, &desc, table, error) &&
             gpu_set_tables(renderer, (const lmp_brdf_table *const *)table, 1, uses,
                            world->material_count, error);
        material_close(&opened);
    }
    free(uses);
    return ok;
}

bool paper_time_frame(const gpu_context *context, const scene *world, const gpu_frame *frame,
                      const char *assignment, paper_times *medians, cli_error *error) {
    double totals[RUNS], shades[RUNS];
    lmp_brdf_table *table = NULL;
    gpu_times times;
    gpu_frame whole = *frame;
    whole.camera = scene_default_camera(world, (float)frame->width / (float)frame->height);
    whole.lights = world->lights;
    whole.light_count = world->light_count;
    gpu_renderer *renderer = gpu_renderer_create(context, world, error);
    bool ok = renderer &&
              (!assignment || use_material(renderer, world, frame, assignment, &table, error)) &&
              gpu_render(renderer, &whole, &times, error);
    for (int i = 0; ok && i < RUNS; i++) {
        ok = gpu_render(renderer, &whole, &times, error);
        totals[i] = times.total;
        shades[i] = times.shade;
    }
    gpu_renderer_destroy(renderer);
    lmp_brdf_table_destroy(table);
    if (!ok)
        return false;
    qsort(totals, RUNS, sizeof *totals, by_value);
    qsort(shades, RUNS, sizeof *shades, by_value);
    *medians = (paper_times) { .shade = shades[RUNS / 2], .total = totals[RUNS / 2] };
    return true;
}

void paper_name_device(paper *p, const gpu_context *context, int width, int height) {
    page_text(&p->page,
              "Frame times at %d×%d on <code>%s</code> (%s), medians of %d. The paper's are of an "
              "RTX 2080 at full size%s.",
              width, height, context->device,
              context->software ? "software, wall clock" : "timer queries", RUNS,
              context->software ? ": a processor that plays a GPU is no match" : "");
}

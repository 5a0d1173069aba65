/* SPDX-License-Identifier: MIT */
/* Frames timed on the graphics device. */
#include "app/override/override.h"
#include "app/paper/paper.h"
#include "app/timing/timing.h"

enum { RUNS = 5 };

bool paper_time_frame(const render_device *device, const render_frame *frame,
                      const char *assignment, paper_times *medians, cli_error *error) {
    double totals[RUNS], shades[RUNS];
    override_set overrides = { .count = 0 };
    const scene *world = device->scene;
    const cli_list list = { { assignment }, assignment ? 1 : 0 };
    render_times times;
    render_frame whole = *frame;
    whole.camera = scene_default_camera(world, (float)frame->width / (float)frame->height);
    whole.lights = world->lights;
    whole.light_count = world->light_count;
    any_renderer *renderer = renderer_create(device, error);
    bool ok = renderer && override_prepare(&list, world, frame, renderer, &overrides, error) &&
              renderer_draw(renderer, &whole, &times, error);
    for (int i = 0; ok && i < RUNS; i++) {
        ok = renderer_draw(renderer, &whole, &times, error);
        totals[i] = times.total;
        shades[i] = times.shade;
    }
    renderer_destroy(renderer);
    override_free(&overrides);
    if (!ok)
        return false;
    *medians = (paper_times) { .shade = timing_of(shades, RUNS).median,
                               .total = timing_of(totals, RUNS).median };
    return true;
}

void paper_name_device(paper *p, const render_device *device, int width, int height) {
    page_text(&p->page,
              "Frame times at %d×%d on <code>%s</code> (%s), medians of %d. The paper's are of an "
              "RTX 2080 at full size%s.",
              width, height, device->name,
              device->gl.software ? "software, wall clock" : "timer queries", RUNS,
              device->gl.software ? ": a CPU in the part of a GPU is no match" : "");
}

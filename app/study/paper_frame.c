/* SPDX-License-Identifier: MIT */
#include "app/study/paper_frame.h"

#include "app/base/cli.h"
#include "app/base/timing.h"
#include "app/render/renderer/override.h"

#include <string.h>

enum { RUNS = 3 };

/* --- devices ---------------------------------------------------------------------------------- */

static bool open_cpu(const paper_scene *from, paper_devices *d, base_error *error) {
    memset(d, 0, sizeof *d);
    d->from = from;
    if (!paper_scene_load(from, &d->world, error))
        return false;
    if (render_device_open(DEVICE_CPU, NULL, &d->world, &d->cpu, error))
        return true;
    scene_free(&d->world);
    return false;
}

bool paper_devices_open(const paper *p, const paper_scene *from, paper_devices *d,
                        base_error *error) {
    base_error why;
    if (!open_cpu(from, d, error))
        return false;
    if (p->options->quick && !render_finds_gpu())
        snprintf(d->note, sizeof d->note, "A quick page asks OpenGL only where there is a GPU.");
    else if (render_device_open(DEVICE_GPU, NULL, &d->world, &d->gl, &why))
        d->has_gl = true;
    else
        snprintf(d->note, sizeof d->note, "OpenGL is not here: %s.", why.text);
    return true;
}

void paper_devices_close(paper_devices *d) {
    if (d->has_gl)
        render_device_close(&d->gl);
    render_device_close(&d->cpu);
    scene_free(&d->world);
}

static const render_device *device_of(const paper_devices *d, device_kind kind) {
    return kind == DEVICE_CPU ? &d->cpu : &d->gl;
}

static bool is_software(const paper_devices *d, device_kind kind) {
    return kind == DEVICE_GPU && d->gl.gl.software;
}

/* Returns the number of timed frames: a single one in software, which is slow and of little
 * interest. */
static int runs_of(const paper_devices *d, device_kind kind) {
    return is_software(d, kind) ? 1 : RUNS;
}

static bool is_gpu(const paper_devices *d, device_kind kind) {
    return kind == DEVICE_GPU && !is_software(d, kind);
}

void paper_name_devices(paper *p, const paper_devices *d, const int size[2]) {
    page_text(&p->page,
              "Frame times at %d×%d, medians of %d after one that is not counted, by a wall clock "
              "on <code>%s</code>. The paper's are of an RTX 2080.",
              size[0], size[1], RUNS, d->cpu.name);
    if (!d->has_gl)
        page_text(&p->page, "%s", d->note);
    else
        page_text(&p->page, "OpenGL is <code>%s</code> (%s).", d->gl.name,
                  d->gl.gl.software
                      ? "software: a CPU in the part of a GPU, by a wall clock, one frame"
                      : "by timer queries");
}

/* --- frames ----------------------------------------------------------------------------------- */

render_frame paper_frame(const int size[2], method_kind method, int bands) {
    return (render_frame) { .width = size[0],
                            .height = size[1],
                            .method = method,
                            .bands = bands,
                            .window = LMP_WINDOW_HANNING };
}

/* A renderer with everything that its frame needs. */
typedef struct session {
    any_renderer *renderer;
    override_set overrides;
    render_frame frame;
} session;

static void end(session *s) {
    renderer_destroy(s->renderer);
    override_free(&s->overrides);
}

/* Begins a session, which must be ended on failure as well. */
static bool begin(session *s, const paper_devices *d, device_kind device, const render_frame *frame,
                  const char *assignment, base_error *error) {
    const int size[] = { frame->width, frame->height };
    const cli_list list = { { assignment }, assignment ? 1 : 0 };
    memset(s, 0, sizeof *s);
    s->frame = *frame;
    s->frame.lights = d->world.lights;
    s->frame.light_count = d->world.light_count;
    if (!scene_place_camera(&d->world, &d->from->view, size, &s->frame.camera, error))
        return false;
    s->renderer = renderer_create(device_of(d, device), error);
    return s->renderer &&
           override_prepare(&list, &d->world, &s->frame, s->renderer, &s->overrides, error);
}

bool paper_draw(const paper_devices *d, device_kind device, const render_frame *frame,
                const char *assignment, image *pixels, base_error *error) {
    session s;
    const bool ok = begin(&s, d, device, frame, assignment, error) &&
                    renderer_draw(s.renderer, &s.frame, NULL, error) &&
                    renderer_read_image(s.renderer, pixels, error);
    end(&s);
    return ok;
}

bool paper_expose(const paper_devices *d, const int size[2], const char *assignment,
                  float *exposure, base_error *error) {
    const render_frame frame = paper_frame(size, METHOD_ZONAL, LMP_SHADE_BANDS_DEFAULT);
    image pixels;
    session s;
    const bool ok = begin(&s, d, DEVICE_CPU, &frame, assignment, error) &&
                    renderer_meter(s.renderer, &s.frame, &pixels, error);
    end(&s);
    if (!ok)
        return false;
    *exposure = image_auto_exposure(&pixels);
    image_free(&pixels);
    return true;
}

bool paper_expose_scene(const paper_scene *from, const int size[2], float *exposure,
                        base_error *error) {
    paper_devices d;
    if (!open_cpu(from, &d, error))
        return false;
    const bool ok = paper_expose(&d, size, NULL, exposure, error);
    paper_devices_close(&d);
    return ok;
}

bool paper_time(const paper_devices *d, device_kind device, const render_frame *frame,
                const char *assignment, paper_times *medians, base_error *error) {
    const int runs = runs_of(d, device);
    double totals[RUNS], shades[RUNS];
    render_times times;
    session s;
    bool ok = begin(&s, d, device, frame, assignment, error) &&
              renderer_draw(s.renderer, &s.frame, &times, error);
    for (int i = 0; ok && i < runs; i++) {
        ok = renderer_draw(s.renderer, &s.frame, &times, error);
        totals[i] = times.total;
        shades[i] = times.shade;
    }
    end(&s);
    if (ok)
        *medians = (paper_times) { .shade = timing_of(shades, runs).median,
                                   .total = timing_of(totals, runs).median };
    return ok;
}

/* --- claims ----------------------------------------------------------------------------------- */

void paper_keep_fastest(paper_fastest *kept, const paper_fastest *other) {
    if (!kept->by || other->ns < kept->ns)
        *kept = *other;
}

void paper_claim_time(paper *p, const paper_devices *d, const paper_fastest *fastest, double theirs,
                      const char *on, paper_claim claim) {
    const bool gpu = is_gpu(d, fastest->by->device);
    snprintf(claim.basis, sizeof claim.basis, "%s; %s, %s", on,
             device_of(d, fastest->by->device)->name, fastest->by->name);
    claim.why = gpu ? "the whole frame, by the fastest method"
                    : "the whole frame, by the fastest method: a CPU is timed, the paper's is a "
                      "GPU";
    paper_claim_add(p,
                    fastest->ns <= theirs ? PAPER_HOLDS
                    : gpu                 ? PAPER_FAILS
                                          : PAPER_ELSEWHERE,
                    claim, "%.4g ms the frame, of which shading %.4g, at %d×%d: %.3g ns",
                    fastest->ms.total, fastest->ms.shade, fastest->size[0], fastest->size[1],
                    fastest->ns);
}

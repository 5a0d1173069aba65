/* SPDX-License-Identifier: MIT */
/* Figures 1 and 5: their frames drawn, timed, compared with `reference`, and shown. */
#include "app/base/progress.h"
#include "app/study/paper_detail.h"
#include "app/study/paper_frame.h"

#include <math.h>

enum { BANDS_MAX = 8, SHOWN_MAX = 2, METHODS_MAX = 4, DETAILS_MAX = 2, MOST = 100 };

/* A figure of the paper. */
typedef struct figure {
    const char *name; /* of the figure's files */
    const paper_scene *from;
    int size[2], judged_size[2], paper_size[2]; /* judged_size: of the images compared */
    int bands[BANDS_MAX];                       /* to compare, in ascending order, 0-terminated */
    int shown[SHOWN_MAX + 1];                   /* to show and time, 0-terminated */
    double paper[SHOWN_MAX];                    /* the paper's milliseconds for `shown` */
    const char *claim[SHOWN_MAX], *said[SHOWN_MAX];
    float stops; /* of exposure, added to the automatic one */
    paper_detail details[DETAILS_MAX];
    int detail_count;
    int samples; /* of the ground truth */
} figure;

/* Measurements of a figure, made before anything is shown. */
typedef struct outcome {
    size_t lights;
    float exposure;
    paper_times times[SHOWN_MAX][METHODS_MAX];
} outcome;

/* The paper's own shader beside the library's methods. */
static const paper_method methods[METHODS_MAX] = {
    { DEVICE_CPU, METHOD_ZONAL, "library: zonal", false },
    { DEVICE_GPU, METHOD_PAPER, "the paper's shader", false },
    { DEVICE_GPU, METHOD_COEFFICIENTS, "library: coefficients", false },
    { DEVICE_GPU, METHOD_ZONAL, "library: zonal", true },
};

static bool is_timed(const paper_devices *devices, const paper_method *method) {
    return method->device == DEVICE_CPU ||
           (devices->has_gl && !(devices->gl.gl.software && method->hardware));
}

/* --- measured --------------------------------------------------------------------------------- */

/* Draws the images whose errors are measured, as NAME-BANDS.exr. */
static bool draw_judged(const figure *f, const paper_devices *devices, base_error *error) {
    for (int i = 0; f->bands[i]; i++) {
        const render_frame frame = paper_frame(f->judged_size, METHOD_ZONAL, f->bands[i]);
        char file[64];
        image pixels;
        snprintf(file, sizeof file, "%s-%d.exr", f->name, f->bands[i]);
        if (!paper_draw(devices, DEVICE_CPU, &frame, NULL, &pixels, error))
            return false;
        const bool ok = image_write(&pixels, file, &(image_display) { .exposure = 1 }, error);
        image_free(&pixels);
        if (!ok)
            return false;
    }
    return true;
}

static bool time_shown(const figure *f, const paper_devices *devices, outcome *o,
                       base_error *error) {
    for (int i = 0; f->shown[i]; i++)
        for (int m = 0; m < METHODS_MAX; m++) {
            const render_frame frame = paper_frame(f->size, methods[m].method, f->shown[i]);
            if (!is_timed(devices, &methods[m]))
                continue;
            progress_show("timing frames", (double)m / METHODS_MAX);
            if (!paper_time(devices, methods[m].device, &frame, NULL, &o->times[i][m], error))
                return false;
        }
    return true;
}

static void tell_times(paper *p, const figure *f, const paper_devices *devices, const outcome *o,
                       page_table *table) {
    for (int i = 0; f->shown[i]; i++) {
        const int bands = f->shown[i], lights = (int)o->lights;
        const double theirs = paper_nanoseconds(f->paper[i], f->paper_size, lights, bands);
        paper_fastest fastest = { .by = NULL };
        for (int m = 0; m < METHODS_MAX; m++) {
            const paper_times ms = o->times[i][m];
            const bool on_gl = methods[m].device == DEVICE_GPU;
            const paper_fastest frame = { ms,
                                          paper_nanoseconds(ms.total, f->size, lights, bands),
                                          &methods[m],
                                          { f->size[0], f->size[1] } };
            if (!is_timed(devices, &methods[m]))
                continue;
            paper_keep_fastest(&fastest, &frame);
            page_table_row(table, "%d|%s|%s|%.1f|%.1f|%.3g|%g|%.3g", bands,
                           on_gl ? "OpenGL" : "CPU", methods[m].name, ms.shade, ms.total, frame.ns,
                           f->paper[i], theirs);
        }
        paper_claim_time(p, devices, &fastest, theirs, f->from->name,
                         (paper_claim) { .text = f->claim[i], .number = f->said[i] });
    }
}

static bool write_times(paper *p, const figure *f, const paper_devices *devices, const outcome *o,
                        base_error *error) {
    page_table table;
    char file[64];
    paper_name_devices(p, devices, f->size);
    snprintf(file, sizeof file, "%s-times", f->name);
    if (!page_table_begin(&p->page, &table, file,
                          "bands|device|method|shading, ms|frame, ms|frame, ns|paper, ms|paper, ns",
                          error))
        return false;
    tell_times(p, f, devices, o, &table);
    return page_table_end(&table, error);
}

/* --- judged ----------------------------------------------------------------------------------- */

/* Computes a ground truth, whose noise depends on the seed. */
static bool trace(paper *p, const figure *f, bool show, int seed, const char *file,
                  base_error *error) {
    return paper_run(p, show, error,
                     "reference %s --no-shadows --size %dx%d --spp %d --noise-seed %d -o %s",
                     f->from->words, f->judged_size[0], f->judged_size[1], f->samples, seed, file);
}

/* Computes the ground truth, and finds the exposure of all images of the figure. */
static bool trace_truth(paper *p, const figure *f, const paper_devices *devices, float *exposure,
                        base_error *error) {
    char file[64], caption[160];
    image truth;
    snprintf(file, sizeof file, "%s-truth.exr", f->name);
    if (!paper_expose(devices, f->judged_size, NULL, exposure, error) ||
        !trace(p, f, true, 1, file, error) || !image_read(file, IMAGE_READ_PIXELS, &truth, error))
        return false;
    *exposure *= image_exposure_of_stops(f->stops);
    snprintf(file, sizeof file, "%s-truth.png", f->name);
    const bool ok = image_write(&truth, file, &(image_display) { .exposure = *exposure }, error);
    image_free(&truth);
    snprintf(caption, sizeof caption,
             "Ground truth at %d×%d: whole lobes, no harmonics, no shadows, %d samples a pixel",
             f->judged_size[0], f->judged_size[1], f->samples);
    if (ok)
        page_image(&p->page, file, caption);
    return ok;
}

/* Adds a row of errors; `bands_alone` is a number, or empty. */
static void tell_error(page_table *table, const char *bands, const compare_result *result,
                       const char *bands_alone) {
    page_table_row(table, "%s|%s|%.3e|%.5f|%.3g at %d×%d", bands, bands_alone,
                   result->values[COMPARE_RELMSE], result->values[COMPARE_SSIM],
                   result->values[COMPARE_MAX], result->max_x, result->max_y);
}

/* Relative MSE by number of bands. */
typedef struct error_curves {
    double bands[BANDS_MAX], truth[BANDS_MAX], alone[BANDS_MAX], noise[BANDS_MAX];
    int count; /* without the most bands, with which `alone` compares */
} error_curves;

static bool plot_errors(paper *p, const figure *f, const error_curves *c, base_error *error) {
    char file[64];
    const figure_series series[] = { { "against truth", c->bands, c->truth, c->count },
                                     { "against 100 bands", c->bands, c->alone, c->count },
                                     { "noise alone", c->bands, c->noise, c->count } };
    snprintf(file, sizeof file, "%s-curve", f->name);
    return page_plot_write(&p->page,
                           &(figure_plot) { .file = file,
                                            .title = "Error by number of bands",
                                            .x_label = "bands",
                                            .y_label = "relative MSE",
                                            .log_y = true,
                                            .series = series,
                                            .series_count = 3 },
                           error);
}

/* Adds a row for each number of bands. */
static bool judge_bands(const figure *f, const char *truth, page_table *table, error_curves *c,
                        base_error *error) {
    compare_result result, most;
    char file[64], last[64], bands[16], alone[32];
    snprintf(last, sizeof last, "%s-%d.exr", f->name, MOST);
    for (int i = 0; f->bands[i]; i++) {
        snprintf(file, sizeof file, "%s-%d.exr", f->name, f->bands[i]);
        snprintf(bands, sizeof bands, "%d", f->bands[i]);
        if (!paper_compare(file, truth, &result, error) || !paper_compare(file, last, &most, error))
            return false;
        snprintf(alone, sizeof alone, "%.3e", most.values[COMPARE_RELMSE]);
        tell_error(table, bands, &result, f->bands[i] == MOST ? "" : alone);
        c->count = i;
        c->bands[i] = f->bands[i];
        c->truth[i] = result.values[COMPARE_RELMSE];
        c->alone[i] = most.values[COMPARE_RELMSE];
    }
    return true;
}

/* Compares each number of bands with the ground truth, and a second ground truth with other noise:
 * smaller errors than its cannot be told from noise. */
static bool judge(paper *p, const figure *f, base_error *error) {
    error_curves curves = { .count = 0 };
    page_table table;
    compare_result result;
    char file[64], truth[64], again[64];
    snprintf(file, sizeof file, "%s-errors", f->name);
    snprintf(truth, sizeof truth, "%s-truth.exr", f->name);
    snprintf(again, sizeof again, "%s-again.exr", f->name);
    if (!trace(p, f, false, 2, again, error) ||
        !page_table_begin(&p->page, &table, file,
                          "bands|relative MSE to 100 bands|to the truth|SSIM|largest error at "
                          "pixel",
                          error) ||
        !judge_bands(f, truth, &table, &curves, error) ||
        !paper_compare(again, truth, &result, error))
        return false;
    tell_error(&table, "noise alone", &result, "");
    for (int i = 0; i < curves.count; i++)
        curves.noise[i] = result.values[COMPARE_RELMSE];
    if (!page_table_end(&table, error))
        return false;
    page_text(&p->page,
              "Errors are of images of %d×%d. “Noise alone” compares two ground truths of other "
              "seeds. The truth filters no textures, frames do: part of what separates every row "
              "from the truth is that, and the difference to 100 bands tells better what fewer "
              "leave out.",
              f->judged_size[0], f->judged_size[1]);
    return plot_errors(p, f, &curves, error);
}

/* --- shown ------------------------------------------------------------------------------------ */

static bool show_images(paper *p, const figure *f, const outcome *o, base_error *error) {
    char file[64], caption[160];
    for (int i = 0; f->shown[i]; i++) {
        snprintf(file, sizeof file, "%s-%d.png", f->name, f->shown[i]);
        if (!paper_run(p, true, error,
                       "render %s --no-shadows --size %dx%d --bands %d --window hanning "
                       "--exposure %.6g -o %s",
                       f->from->words, f->size[0], f->size[1], f->shown[i], (double)o->exposure,
                       file))
            return false;
    }
    page_row_begin(&p->page);
    for (int i = 0; f->shown[i]; i++) {
        snprintf(file, sizeof file, "%s-%d.png", f->name, f->shown[i]);
        snprintf(caption, sizeof caption, "%s%s, %zu sphere lights, %d bands, %d×%d",
                 !f->shown[1] ? ""
                 : i          ? "(b) "
                              : "(a) ",
                 f->from->name, o->lights, f->shown[i], f->size[0], f->size[1]);
        page_image(&p->page, file, caption);
    }
    page_row_end(&p->page);
    return true;
}

/* Shows a detail side by side, the ground truth last. */
static bool show_detail(paper *p, const figure *f, const paper_detail *detail,
                        paper_looks looks[SHOWN_MAX + 1], base_error *error) {
    bool ok = true;
    page_row_begin(&p->page);
    for (int i = 0; i <= SHOWN_MAX && ok; i++) {
        char from[64], to[96], caption[96], bands[32] = "truth";
        if (f->shown[i])
            snprintf(bands, sizeof bands, "%d", f->shown[i]);
        snprintf(from, sizeof from, "%s-%s.png", f->name, bands);
        snprintf(to, sizeof to, "%s-%s-%s.png", f->name, detail->name, bands);
        snprintf(caption, sizeof caption, "The %s, %s%s", detail->name,
                 f->shown[i] ? bands : "ground truth", f->shown[i] ? " bands" : "");
        ok = paper_show_detail(p, from, detail, 500, to, caption, &looks[i], error);
    }
    page_row_end(&p->page);
    return ok;
}

/* Adds the caption's claim about more bands, on the floor, which is the first detail. */
static void claim_details(paper *p, const figure *f, const paper_looks *few,
                          const paper_looks *more, const paper_looks *truth) {
    paper_claim outlines = { .text = "reflections on the floor are outlined more precisely by 8 "
                                     "bands than by 5",
                             .number = "seen in Fig. 5",
                             .why = "judged by the contrast of what is displayed of the floor" };
    paper_claim colors = { .text = "colors show more by 8 bands than by 5",
                           .number = "seen in Fig. 5",
                           .why = "judged by the saturation of what is displayed of the floor" };
    const paper_verdict failed = f->from->real ? PAPER_FAILS : PAPER_UNLIKE;
    snprintf(outlines.basis, sizeof outlines.basis, "%s", f->from->name);
    snprintf(colors.basis, sizeof colors.basis, "%s", f->from->name);
    paper_claim_add(p, more->contrast > few->contrast ? PAPER_HOLDS : failed, outlines,
                    "contrast %.3f and %.3f, truth %.3f", few->contrast, more->contrast,
                    truth->contrast);
    paper_claim_add(p, more->color > few->color ? PAPER_HOLDS : failed, colors,
                    "saturation %.3f and %.3f, truth %.3f", few->color, more->color, truth->color);
}

static bool show_details(paper *p, const figure *f, base_error *error) {
    paper_looks looks[DETAILS_MAX][SHOWN_MAX + 1];
    page_table table;
    char file[64];
    for (int i = 0; i < f->detail_count; i++)
        if (!show_detail(p, f, &f->details[i], looks[i], error))
            return false;
    snprintf(file, sizeof file, "%s-details", f->name);
    if (!page_table_begin(&p->page, &table, file, "detail|bands|saturation|contrast", error))
        return false;
    for (int i = 0; i < f->detail_count; i++)
        for (int k = 0; k <= SHOWN_MAX; k++) {
            char bands[16] = "truth";
            if (f->shown[k])
                snprintf(bands, sizeof bands, "%d", f->shown[k]);
            page_table_row(&table, "%s|%s|%.3f|%.3f", f->details[i].name, bands, looks[i][k].color,
                           looks[i][k].contrast);
        }
    claim_details(p, f, &looks[0][0], &looks[0][1], &looks[0][2]);
    return page_table_end(&table, error);
}

static bool make_figure(paper *p, const figure *f, base_error *error) {
    paper_devices devices;
    outcome o = { .lights = 0 };
    paper_name_source(p, f->from->real ? PAPER_MEASURED : PAPER_STAND_IN, f->from->name);
    if (f->from->real)
        page_text(&p->page, "%s%s", f->from->credit,
                  f->from->random_lights ? " The data has no lights for it: these are random."
                                         : "");
    else
        page_text(&p->page, "Here <code>%s</code> stands in for it.", f->from->name);
    if (!paper_devices_open(p, f->from, &devices, error))
        return false;
    o.lights = devices.world.light_count;
    const bool ok = draw_judged(f, &devices, error) && time_shown(f, &devices, &o, error) &&
                    trace_truth(p, f, &devices, &o.exposure, error) &&
                    show_images(p, f, &o, error) &&
                    (f->detail_count == 0 || show_details(p, f, error)) &&
                    write_times(p, f, &devices, &o, error) && judge(p, f, error);
    progress_end();
    paper_devices_close(&devices);
    return ok;
}

/* --- the figures ------------------------------------------------------------------------------ */

bool paper_step_san_miguel(paper *p, base_error *error) {
    const bool quick = p->options->quick;
    const figure f = { .name = "figure1",
                       .from = &p->data.san_miguel,
                       .size = { quick ? 850 : 3400, quick ? 225 : 900 },
                       .judged_size = { quick ? 425 : 850, quick ? 113 : 225 },
                       .paper_size = { 3400, 900 },
                       .bands = { 3, 5, 10, 20, MOST },
                       .shown = { 10 },
                       .paper = { 69 },
                       .claim = { "10 lights on 10 bands in real time" },
                       .said = { "69 ms at 3400×900: 0.225 ns" },
                       .samples = quick ? 32 : 64 };
    page_text(&p->page, "The paper renders San Miguel at 3400×900 in 69 ms, lit by 10 sphere "
                        "lights alone, on 10 bands.");
    return make_figure(p, &f, error);
}

bool paper_step_sponza(paper *p, base_error *error) {
    const bool quick = p->options->quick, real = p->data.sponza.real;
    const figure f = { .name = "figure5",
                       .from = &p->data.sponza,
                       .size = { quick ? 660 : 1980, quick ? 332 : 995 },
                       .judged_size = { quick ? 330 : 660, quick ? 166 : 332 },
                       .paper_size = { 1980, 995 },
                       .bands = { 3, 5, 8, 12, 20, MOST },
                       .shown = { 5, 8 },
                       .paper = { 4.9, 8.3 },
                       .claim = { "30 lights on 5 bands in real time",
                                  "30 lights on 8 bands in real time" },
                       .said = { "4.9 ms at 1980×995: 0.0166 ns", "8.3 ms at 1980×995: 0.0176 ns" },
                       .stops = real ? -1.2f : 0.0f,
                       .details = { { "floor", 0.42, real ? 0.64 : 0.78, 0.175, 0.175 },
                                    { "curtain", 0.20, 0.38, 0.125, 0.25 } },
                       .detail_count = real ? 2 : 1,
                       .samples = quick ? 32 : 64 };
    page_text(&p->page,
              "The paper renders Sponza under 30 sphere lights at 1980×995, (a) in 4.9 ms "
              "with 5 bands and (b) in 8.3 ms with 8: with more bands, reflections on "
              "the floor are outlined more precisely, and more colors appear.");
    return make_figure(p, &f, error);
}

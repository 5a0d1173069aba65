/* SPDX-License-Identifier: MIT */
/* The paper's images: made by `render`, timed, and judged by `reference`. */
#include "app/paper/paper.h"

#include <math.h>

enum { BANDS_MAX = 8 };

/* A figure of the paper. */
typedef struct figure {
    const char *name; /* of files */
    const char *scene;
    char word[8192], lights[64]; /* the scene in a command line, and its lights */
    int width, height, light_count;
    int bands[BANDS_MAX];    /* to compare, 0-terminated */
    int shown[BANDS_MAX];    /* to show and time, 0-terminated */
    double paper[BANDS_MAX]; /* the paper's milliseconds of `shown`, */
    int paper_size[2];       /* at this size */
    const char *claim[BANDS_MAX], *number[BANDS_MAX];
    int samples; /* of the ground truth */
} figure;

/* The paper's own shader beside the library's. */
static const struct {
    method_kind method;
    const char *name;
} methods[] = {
    { METHOD_PAPER, "the paper's shader" },
    { METHOD_COEFFICIENTS, "library: coefficients" },
    { METHOD_ZONAL, "library: zonal" },
};

/* By the fastest of the methods. */
static void claim_time(paper *p, const figure *f, int shown, double ns, bool software) {
    const double theirs =
        paper_nanoseconds(f->paper[shown], f->paper_size, f->light_count, f->shown[shown]);
    const paper_verdict missed = software ? PAPER_ELSEWHERE : PAPER_FAILS;
    paper_claim_add(p, ns <= theirs ? PAPER_HOLDS : missed,
                    (paper_claim) { f->claim[shown], f->number[shown], f->scene,
                                    software ? "OpenGL is software here: a CPU is timed, the "
                                               "paper's is a GPU"
                                             : "the shading pass alone, by the fastest method" },
                    "%.3g ns", ns);
}

static bool time_rows(paper *p, const render_device *device, const figure *f, cli_error *error) {
    const int size[] = { f->width, f->height };
    page_table table;
    char file[64];
    snprintf(file, sizeof file, "%s-times", f->name);
    bool ok = page_table_begin(&p->page, &table, file,
                               "bands|method|shading, ms|frame, ms|shading, ns|paper, ms|paper, ns",
                               error);
    for (int i = 0; ok && f->shown[i]; i++) {
        double least = HUGE_VAL;
        for (size_t m = 0; ok && m < sizeof methods / sizeof *methods; m++) {
            const render_frame frame = { .width = f->width,
                                         .height = f->height,
                                         .method = methods[m].method,
                                         .bands = f->shown[i],
                                         .window = LMP_WINDOW_HANNING };
            paper_times ms;
            ok = paper_time_frame(device, &frame, NULL, &ms, error);
            if (!ok)
                break;
            const double ns = paper_nanoseconds(ms.shade, size, f->light_count, f->shown[i]);
            least = fmin(least, ns);
            page_table_row(
                &table, "%d|%s|%.1f|%.1f|%.3g|%g|%.3g", f->shown[i], methods[m].name, ms.shade,
                ms.total, ns, f->paper[i],
                paper_nanoseconds(f->paper[i], f->paper_size, f->light_count, f->shown[i]));
        }
        if (ok)
            claim_time(p, f, i, least, device->gl.software);
    }
    return ok && page_table_end(&table, error);
}

static bool time_figure(paper *p, const figure *f, cli_error *error) {
    const scene_lights_options lights = { .random_count = f->light_count, .seed = 1 };
    render_device device;
    scene world;
    if (!scene_load(f->scene, &(scene_options) { .no_cache = false }, &world, error))
        return false;
    bool ok = scene_apply_lights(&world, &lights, error) &&
              render_device_open(DEVICE_GPU, NULL, &world, &device, error);
    if (ok) {
        paper_name_device(p, &device, f->width, f->height);
        ok = time_rows(p, &device, f, error);
        render_device_close(&device);
    }
    scene_free(&world);
    return ok;
}

/* The error of each number of bands against the ground truth, and that of a second ground truth of
 * other noise: no smaller error can be told from noise. */
static bool judge(paper *p, const figure *f, cli_error *error) {
    double x[BANDS_MAX], rough[BANDS_MAX];
    page_table table;
    compare_result result;
    char file[64], pixels[64];
    int count = 0;
    if (!paper_run(p, false, error,
                   "reference %s %s --size %dx%d --spp %d --noise-seed 2 -o %s-again.exr", f->word,
                   f->lights, f->width, f->height, f->samples, f->name))
        return false;
    snprintf(file, sizeof file, "%s-errors", f->name);
    snprintf(pixels, sizeof pixels, "%s-truth.exr", f->name);
    if (!page_table_begin(&p->page, &table, file, "bands|relative MSE|SSIM|largest error at pixel",
                          error))
        return false;
    for (; f->bands[count]; count++) {
        char ours[64];
        snprintf(ours, sizeof ours, "%s-%d.exr", f->name, f->bands[count]);
        if (!paper_run(p, false, error,
                       "render %s %s --size %dx%d --bands %d --window hanning -o %s", f->word,
                       f->lights, f->width, f->height, f->bands[count], ours) ||
            !paper_compare(ours, pixels, &result, error))
            return false;
        x[count] = f->bands[count];
        rough[count] = result.values[COMPARE_RELMSE];
        page_table_row(&table, "%d|%.3e|%.5f|%.3g at %d×%d", f->bands[count],
                       result.values[COMPARE_RELMSE], result.values[COMPARE_SSIM],
                       result.values[COMPARE_MAX], result.max_x, result.max_y);
    }
    char again[64];
    snprintf(again, sizeof again, "%s-again.exr", f->name);
    if (!paper_compare(again, pixels, &result, error))
        return false;
    page_table_row(&table, "noise alone|%.3e|%.5f|%.3g at %d×%d", result.values[COMPARE_RELMSE],
                   result.values[COMPARE_SSIM], result.values[COMPARE_MAX], result.max_x,
                   result.max_y);
    if (!page_table_end(&table, error))
        return false;
    double noise[BANDS_MAX];
    for (int i = 0; i < count; i++)
        noise[i] = result.values[COMPARE_RELMSE];
    const figure_series series[] = { { "against truth", x, rough, count },
                                     { "noise alone", x, noise, count } };
    page_text(&p->page,
              "“Noise alone” compares two ground truths of other seeds. The largest error is often "
              "one pixel on an edge where rasterizer and ray see different surfaces.");
    snprintf(file, sizeof file, "%s-curve", f->name);
    return page_plot_write(&p->page,
                           &(figure_plot) { .file = file,
                                            .title = "Error against whole lobes by number of bands",
                                            .x_label = "bands",
                                            .y_label = "relative MSE",
                                            .log_y = true,
                                            .series = series,
                                            .series_count = 2 },
                           error);
}

/* Traces the ground truth; *exposure is its own, for all images of the figure. */
static bool trace_truth(paper *p, const figure *f, float *exposure, cli_error *error) {
    char file[64], caption[160];
    image truth;
    if (!paper_run(p, true, error, "reference %s %s --size %dx%d --spp %d -o %s-truth.exr", f->word,
                   f->lights, f->width, f->height, f->samples, f->name))
        return false;
    snprintf(file, sizeof file, "%s-truth.exr", f->name);
    if (!image_read(file, IMAGE_READ_PIXELS, &truth, error))
        return false;
    *exposure = image_auto_exposure(&truth);
    snprintf(file, sizeof file, "%s-truth.png", f->name);
    const bool ok = image_write(&truth, file, &(image_display) { .exposure = *exposure }, error);
    image_free(&truth);
    snprintf(caption, sizeof caption, "Ground truth: whole lobes, no harmonics, %d samples a pixel",
             f->samples);
    if (ok)
        page_image(&p->page, file, caption);
    return ok;
}

static bool make_figure(paper *p, const figure *f, cli_error *error) {
    char file[64], caption[160];
    float exposure;
    if (!trace_truth(p, f, &exposure, error))
        return false;
    for (int i = 0; f->shown[i]; i++) {
        snprintf(file, sizeof file, "%s-%d.png", f->name, f->shown[i]);
        snprintf(caption, sizeof caption, "%d sphere lights, %d bands", f->light_count,
                 f->shown[i]);
        if (!paper_run(
                p, true, error,
                "render %s %s --size %dx%d --bands %d --window hanning --exposure %.6g -o %s",
                f->word, f->lights, f->width, f->height, f->shown[i], (double)exposure, file))
            return false;
        page_image(&p->page, file, caption);
    }
    return time_figure(p, f, error) && judge(p, f, error);
}

static bool set_scene(figure *f, const char *name, cli_error *error) {
    f->scene = name ? name : "builtin:atrium";
    snprintf(f->lights, sizeof f->lights, "--random-lights %d --seed 1", f->light_count);
    return paper_quote(f->scene, f->word, sizeof f->word) ||
           cli_fail(error, f->scene, "is too long a name");
}

bool paper_step_san_miguel(paper *p, cli_error *error) {
    const bool full = p->options->full;
    figure f = { .name = "figure1",
                 .width = full ? 3400 : 850,
                 .height = full ? 900 : 225,
                 .light_count = 10,
                 .bands = { 3, 5, 10, 20 },
                 .shown = { 10 },
                 .paper = { 69 },
                 .paper_size = { 3400, 900 },
                 .claim = { "10 lights on 10 bands in real time" },
                 .number = { "69 ms at 3400×900: 0.225 ns" },
                 .samples = full ? 256 : 64 };
    if (!set_scene(&f, p->options->san_miguel, error))
        return false;
    page_text(&p->page, "The paper renders San Miguel at 3400×900 in 69 ms. %s",
              p->options->san_miguel ? "" : "Here <code>builtin:atrium</code> stands for it.");
    return make_figure(p, &f, error);
}

bool paper_step_sponza(paper *p, cli_error *error) {
    const bool full = p->options->full;
    figure f = { .name = "figure5",
                 .width = full ? 1980 : 660,
                 .height = full ? 995 : 332,
                 .light_count = 30,
                 .bands = { 3, 5, 8, 12, 20 },
                 .shown = { 5, 8 },
                 .paper = { 4.9, 8.3 },
                 .paper_size = { 1980, 995 },
                 .claim = { "30 lights on 5 bands in real time",
                            "30 lights on 8 bands in real time" },
                 .number = { "4.9 ms at 1980×995: 0.0166 ns", "8.3 ms at 1980×995: 0.0176 ns" },
                 .samples = full ? 256 : 64 };
    if (!set_scene(&f, p->options->sponza, error))
        return false;
    page_text(&p->page,
              "The paper renders Sponza at 1980×995 in 4.9 ms with 5 bands and 8.3 ms with 8. %s",
              p->options->sponza ? "" : "Here <code>builtin:atrium</code> stands for it.");
    return make_figure(p, &f, error);
}

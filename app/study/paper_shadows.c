/* SPDX-License-Identifier: MIT */
/* The effect of occlusion: scenes of the paper with and without shadows. */
#include "app/base/timing.h"
#include "app/study/paper_frame.h"

typedef struct subject {
    int number; /* of the figure */
    const char *name;
    const paper_scene *from;
    int size[2], samples;
} subject;

/* How an image is drawn, and whether it is shown beside the ground truth. */
typedef struct drawing {
    const char *label, *options, *caption;
} drawing;

static const drawing drawings[] = {
    { "none", "--no-shadows", "Without shadows, as the paper has it" },
    { "2, unfiltered", "--shadows --no-shadow-filter", NULL },
    { "2", "--shadows", "Shadows by 2 rays a pixel, filtered" },
    { "16", "--shadows --shadow-rays 16", NULL },
};
enum { DRAWINGS = sizeof drawings / sizeof *drawings };

typedef struct outcome {
    double seconds; /* of the whole command */
    compare_result difference;
} outcome;

static bool run(paper *p, const subject *s, const char *command, const char *options,
                const char *file, base_error *error) {
    return paper_run(p, false, error, "%s %s --size %dx%d %s -o %s", command, s->from->words,
                     s->size[0], s->size[1], options, file);
}

/* Shows an image as a .png. */
static bool show(paper *p, const char *file, const char *caption, float exposure,
                 base_error *error) {
    char shown[80];
    image pixels;
    if (!image_read(file, IMAGE_READ_PIXELS, &pixels, error))
        return false;
    snprintf(shown, sizeof shown, "%s.png", file);
    const bool ok = image_write(&pixels, shown, &(image_display) { .exposure = exposure }, error);
    image_free(&pixels);
    if (ok)
        page_image(&p->page, shown, caption);
    return ok;
}

static bool draw(paper *p, const subject *s, const drawing *d, const char *truth, float exposure,
                 outcome *result, base_error *error) {
    char file[64];
    snprintf(file, sizeof file, "shadows-%s-%d.exr", s->name, (int)(d - drawings));
    const double start = timing_now();
    if (!run(p, s, "render", d->options, file, error))
        return false;
    result->seconds = timing_now() - start;
    return paper_compare(file, truth, &result->difference, error) &&
           (!d->caption || show(p, file, d->caption, exposure, error));
}

static bool draw_all(paper *p, const subject *s, outcome results[DRAWINGS], base_error *error) {
    char truth[64], options[64];
    float exposure;
    snprintf(truth, sizeof truth, "shadows-%s-truth.exr", s->name);
    snprintf(options, sizeof options, "--shadows --spp %d", s->samples);
    if (!paper_expose_scene(s->from, s->size, &exposure, error))
        return false;
    page_row_begin(&p->page);
    bool ok = run(p, s, "reference", options, truth, error) &&
              show(p, truth, "Ground truth with shadows", exposure, error);
    for (int i = 0; i < DRAWINGS && ok; i++)
        ok = draw(p, s, &drawings[i], truth, exposure, &results[i], error);
    page_row_end(&p->page);
    return ok;
}

static bool tabulate(paper *p, const subject subjects[2], outcome results[2][DRAWINGS],
                     base_error *error) {
    page_table table;
    if (!page_table_begin(&p->page, &table, "shadows",
                          "figure|scene|rays a pixel|whole command, s|relative MSE|SSIM", error))
        return false;
    for (int i = 0; i < 2; i++)
        for (int d = 0; d < DRAWINGS; d++) {
            const double *values = results[i][d].difference.values;
            page_table_row(&table, "%d|%s|%s|%.2f|%.3g|%.5f", subjects[i].number,
                           subjects[i].from->name, drawings[d].label, results[i][d].seconds,
                           values[COMPARE_RELMSE], values[COMPARE_SSIM]);
        }
    if (!page_table_end(&table, error))
        return false;
    page_text(&p->page, "What remains along edges are pixels where rasterizer and ray see "
                        "different surfaces, and elsewhere what the bands leave out.");
    return true;
}

bool paper_step_shadows(paper *p, base_error *error) {
    const bool quick = p->options->quick;
    const subject subjects[] = {
        { 1,
          "figure1",
          &p->data.san_miguel,
          { quick ? 284 : 850, quick ? 75 : 225 },
          quick ? 64 : 32 },
        { 5,
          "figure5",
          &p->data.sponza,
          { quick ? 220 : 660, quick ? 111 : 332 },
          quick ? 64 : 32 },
    };
    outcome results[2][DRAWINGS];
    page_text(&p->page, "The paper's sums know no walls: every light reaches every surface that "
                        "faces it. <code>--shadows</code> multiplies them by the part of the "
                        "light that arrives, found by a few rays a pixel and a filter (a ratio "
                        "estimator, Heitz, Hill and McGuire 2018). Without it nearly all of what "
                        "separates an image from the truth is light that walls would stop.");
    return draw_all(p, &subjects[0], results[0], error) &&
           draw_all(p, &subjects[1], results[1], error) && tabulate(p, subjects, results, error);
}

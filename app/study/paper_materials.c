/* SPDX-License-Identifier: MIT */
/* Figure 6, compared with the reference and shown. */
#include "app/study/paper_materials.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Adaptive sampling sends the ground truth's samples where a highlight needs them. */
#define SAMPLING "--spp 2048 --error 0.05"

/* What a pixel of the mask sees. */
enum { SEES_OTHER, SEES_GRAZING, SEES_STEEP }; /* the material, seen beyond 70° or within */

/* Whether a material is drawn with so many bands. The paper asks only of (d) and (e) whether a
 * hundred bands suffice; a quick page skips these, whose tables take most of the time. */
static bool has_bands(const paper *p, int material, int count) {
    return materials_bands[count] < 100 || (material >= 3 && !p->options->quick);
}

/* --- judged ----------------------------------------------------------------------------------- */

/* Fills the mask from a frame's surfaces; a pass that leaves the image alone. */
static bool see(void *user, const render_frame *frame, const render_surfaces *surfaces, float *rgba,
                base_error *error) {
    materials_figure *f = user;
    const float steep = 0.342f; /* cos 70° */
    (void)rgba, (void)error;
    for (int y = surfaces->y; y < surfaces->y + surfaces->height; y++)
        for (int x = surfaces->x; x < surfaces->x + surfaces->width; x++) {
            const size_t i = render_surfaces_at(surfaces, x, y);
            const uint32_t seen = surfaces->seen[i];
            float dot = 0, length = 0;
            if (seen >= f->devices.world.material_count ||
                strcmp(f->devices.world.materials[seen].name, "test_material") != 0)
                continue;
            for (int k = 0; k < 3; k++) {
                const float toward = surfaces->camera.eye[k] - surfaces->position[k][i];
                dot += toward * surfaces->normal[k][i];
                length += toward * toward;
            }
            f->mask[(size_t)y * (size_t)frame->width + (size_t)x] =
                dot >= steep * sqrtf(length) ? SEES_STEEP : SEES_GRAZING;
        }
    return true;
}

static bool find_mask(materials_figure *f, base_error *error) {
    const size_t count = (size_t)f->judged_size[0] * (size_t)f->judged_size[1];
    render_frame frame = paper_frame(f->judged_size, METHOD_ZONAL, 3);
    image pixels;
    frame.shadow = (render_pass) { .run = see, .user = f };
    f->mask = calloc(count, sizeof *f->mask);
    if (!f->mask)
        return base_fail(error, NULL, "out of memory");
    if (!paper_draw(&f->devices, DEVICE_CPU, &frame, NULL, &pixels, error))
        return false;
    image_free(&pixels);
    return memchr(f->mask, SEES_STEEP, count) ||
           base_fail(error, f->devices.from->name, "shows no material named test_material");
}

/* Computes the errors of an image against the mean of two ground truths; without an image, the
 * noise of that mean. */
static materials_errors compare(const materials_figure *f, const image *pixels,
                                const image truths[2]) {
    const size_t count = (size_t)f->judged_size[0] * (size_t)f->judged_size[1];
    double all = 0, steep = 0, all_count = 0, steep_count = 0;
    for (size_t i = 0; i < 3 * count; i++) {
        const double a = (double)truths[0].rgb[i], b = (double)truths[1].rgb[i];
        const double truth = (a + b) / 2;
        const double off = pixels ? (double)pixels->rgb[i] - truth : (a - b) / 2;
        const double part = off * off / (truth * truth + 0.01);
        if (f->mask[i / 3] == SEES_OTHER)
            continue;
        all += part;
        all_count++;
        steep += f->mask[i / 3] == SEES_STEEP ? part : 0;
        steep_count += f->mask[i / 3] == SEES_STEEP;
    }
    return (materials_errors) { all / all_count, steep / steep_count };
}

static void name_file(const paper_material *m, const char *kind, char file[64]) {
    snprintf(file, 64, "figure6-%s-%s", m->letter, kind);
}

/* Draws the image with so many bands and writes it as figure6-LETTER-BANDS.exr. */
static bool draw_judged(const materials_figure *f, const paper_material *m, int bands,
                        image *pixels, base_error *error) {
    const render_frame frame = paper_frame(f->judged_size, METHOD_ZONAL, bands);
    char kind[16], file[64];
    snprintf(kind, sizeof kind, "%d.exr", bands);
    name_file(m, kind, file);
    return paper_draw(&f->devices, DEVICE_CPU, &frame, m->value, pixels, error) &&
           image_write(pixels, file, &(image_display) { .exposure = 1 }, error);
}

static bool trace(paper *p, const materials_figure *f, const paper_material *m, const char *kind,
                  int seed, image *truth, base_error *error) {
    const paper_scene *ball = &p->data.ball;
    char file[64];
    name_file(m, kind, file);
    return paper_run(p, seed == 1 && *m->letter == 'a', error,
                     "reference %s %s --no-shadows --material %s --size %dx%d " SAMPLING
                     " --noise-seed %d -o %s",
                     ball->words, ball->camera, m->word, f->judged_size[0], f->judged_size[1], seed,
                     file) &&
           image_read(file, IMAGE_READ_PIXELS, truth, error);
}

static void tell_error(page_table *table, const paper_material *m, const char *bands,
                       const materials_errors *errors) {
    page_table_row(table, "%s|%s|%s|%s|%.2e|%.2e", m->letter, m->name, m->label, bands, errors->all,
                   errors->steep);
}

static bool judge_bands(paper *p, materials_figure *f, int index, const image truths[2],
                        page_table *table, base_error *error) {
    const paper_material *m = &p->data.materials[index];
    for (int c = 0; c < MATERIALS_COUNTS; c++) {
        char bands[16];
        image pixels = { .rgb = NULL };
        if (!has_bands(p, index, c))
            continue;
        const bool ok = draw_judged(f, m, materials_bands[c], &pixels, error);
        if (ok) {
            f->errors[index][c] = compare(f, &pixels, truths);
            snprintf(bands, sizeof bands, "%d", materials_bands[c]);
            tell_error(table, m, bands, &f->errors[index][c]);
        }
        image_free(&pixels);
        if (!ok)
            return false;
    }
    f->noise[index] = compare(f, NULL, truths);
    tell_error(table, m, "noise alone", &f->noise[index]);
    return true;
}

/* Compares one material: two ground truths, the images at each number of bands, and their
 * errors. */
static bool judge(paper *p, materials_figure *f, int index, page_table *table, base_error *error) {
    const paper_material *m = &p->data.materials[index];
    image truths[2] = { { .rgb = NULL }, { .rgb = NULL } };
    const bool ok = trace(p, f, m, "truth.exr", 1, &truths[0], error) &&
                    trace(p, f, m, "again.exr", 2, &truths[1], error) &&
                    judge_bands(p, f, index, truths, table, error);
    image_free(&truths[0]);
    image_free(&truths[1]);
    return ok;
}

static bool judge_all(paper *p, materials_figure *f, base_error *error) {
    page_table table;
    if (!page_table_begin(
            &p->page, &table, "figure6",
            "figure|paper's material|material|bands|relative MSE|within 70° of the normal", error))
        return false;
    for (int i = 0; i < PAPER_MATERIALS; i++)
        if (!judge(p, f, i, &table, error))
            return false;
    return page_table_end(&table, error);
}

/* Whether bands suffice: the relative MSE, less the noise of the ground truths, is at most 2 %. */
static bool is_enough(double error, double noise) {
    return error - noise <= 0.02;
}

/* Returns the verdict of a claim that fails for the materials from first to last. */
static paper_verdict failed(const paper *p, int first, int last) {
    for (int i = first; i <= last; i++)
        if (p->data.materials[i].source == PAPER_STAND_IN)
            return PAPER_UNLIKE;
    return PAPER_FAILS;
}

static void claim_few(paper *p, const materials_figure *f) {
    paper_claim claim = { .text = "10 bands are enough for materials (a) to (c) up to 70° from the "
                                  "normal",
                          .number = "no number",
                          .why = "judged by a relative MSE of 2 % against the ground truth, of the "
                                 "pixels seen from within 70°; the lights' angles are not told "
                                 "apart" };
    bool enough = true;
    paper_name_materials(&p->data, 0, 2, claim.basis, sizeof claim.basis);
    for (int i = 0; i < 3; i++)
        enough = enough && is_enough(f->errors[i][0].steep, f->noise[i].steep);
    paper_claim_add(p, enough ? PAPER_HOLDS : failed(p, 0, 2), claim,
                    "relative MSE %.1e, %.1e, %.1e; of all angles %.1e, %.1e, %.1e",
                    f->errors[0][0].steep, f->errors[1][0].steep, f->errors[2][0].steep,
                    f->errors[0][0].all, f->errors[1][0].all, f->errors[2][0].all);
}

static void claim_many(paper *p, const materials_figure *f) {
    const int last = MATERIALS_COUNTS - 1;
    paper_claim claim = { .text = "materials (d) and (e) need more than a hundred bands",
                          .number = "an estimate",
                          .why = "judged by a relative MSE of 2 % against the ground truth" };
    bool lacking = true;
    paper_name_materials(&p->data, 3, 4, claim.basis, sizeof claim.basis);
    for (int i = 3; i < PAPER_MATERIALS; i++)
        lacking = lacking && !is_enough(f->errors[i][last].all, f->noise[i].all);
    paper_claim_add(p, lacking ? PAPER_HOLDS : failed(p, 3, 4), claim,
                    "relative MSE of (d) %.1e, %.1e, %.1e at 10, 20, 100 bands; of (e) %.1e, %.1e, "
                    "%.1e",
                    f->errors[3][0].all, f->errors[3][1].all, f->errors[3][2].all,
                    f->errors[4][0].all, f->errors[4][1].all, f->errors[4][2].all);
}

/* --- shown ------------------------------------------------------------------------------------ */

/* Shows the figure as in the paper: (a) from farther away, where the lights are visible; all with
 * 10 bands. */
static bool show_figure(paper *p, const materials_figure *f, base_error *error) {
    const paper_scene *ball = &p->data.ball;
    page_row_begin(&p->page);
    for (int i = 0; i < PAPER_MATERIALS; i++) {
        const paper_material *m = &p->data.materials[i];
        char file[64], caption[200];
        name_file(m, "figure.png", file);
        if (!paper_run(p, i < 2, error,
                       "render %s %s --no-shadows --material %s --size %dx%d --bands 10 "
                       "--window hanning -o %s",
                       ball->words, i == 0 ? ball->overview : ball->camera, m->word, f->size[0],
                       f->size[1], file))
            return false;
        snprintf(caption, sizeof caption, "(%s) %s%s", m->letter, i == 0 ? "the scene with " : "",
                 m->label);
        page_image(&p->page, file, caption);
    }
    page_row_end(&p->page);
    return true;
}

/* Shows one image of a row. */
static bool show(paper *p, const paper_material *m, const char *kind, const char *caption,
                 float exposure, base_error *error) {
    char from[64], to[64], file[32];
    image pixels;
    snprintf(file, sizeof file, "%s.exr", kind);
    name_file(m, file, from);
    snprintf(file, sizeof file, "%s.png", kind);
    name_file(m, file, to);
    if (!image_read(from, IMAGE_READ_PIXELS, &pixels, error))
        return false;
    const bool ok = image_write(&pixels, to, &(image_display) { .exposure = exposure }, error);
    image_free(&pixels);
    if (ok)
        page_image(&p->page, to, caption);
    return ok;
}

/* Shows a row per material: ground truth, then its bands. */
static bool show_rows(paper *p, const materials_figure *f, base_error *error) {
    bool ok = true;
    for (int i = 0; i < PAPER_MATERIALS && ok; i++) {
        const paper_material *m = &p->data.materials[i];
        char caption[200], kind[16];
        float exposure;
        if (!paper_expose(&f->devices, f->judged_size, m->value, &exposure, error))
            return false;
        page_row_begin(&p->page);
        snprintf(caption, sizeof caption, "(%s) %s: ground truth", m->letter, m->label);
        ok = show(p, m, "truth", caption, exposure, error);
        for (int c = 0; c < MATERIALS_COUNTS && ok; c++) {
            snprintf(kind, sizeof kind, "%d", materials_bands[c]);
            snprintf(caption, sizeof caption, "(%s) %s: %d bands", m->letter, m->label,
                     materials_bands[c]);
            ok = !has_bands(p, i, c) || show(p, m, kind, caption, exposure, error);
        }
        page_row_end(&p->page);
    }
    return ok;
}

/* --- the step --------------------------------------------------------------------------------- */

static void introduce(paper *p) {
    const paper_scene *ball = &p->data.ball;
    bool fits = false, stand_ins = false;
    page_text(&p->page,
              "The paper renders five measured materials at 600×816 under 10 sphere lights in "
              "less than 3 ms each with 10 bands, and (d) in 105 ms with 20; it finds 10 bands "
              "enough for (a) to (c) where neither view nor light is more than about 70° from the "
              "normal, and estimates that (d) and (e) need more than a hundred.");
    for (int i = 0; i < PAPER_MATERIALS; i++) {
        const paper_material *m = &p->data.materials[i];
        fits = fits || m->source == PAPER_FIT;
        stand_ins = stand_ins || m->source == PAPER_STAND_IN;
        paper_name_source(p, m->source, m->label);
    }
    if (fits)
        page_text(&p->page, "What is called a fit is a neural network fitted to the measurement "
                            "(Sztrajman et al. 2021, MIT), not the measurement: what it gets wrong "
                            "is not known here.");
    if (stand_ins)
        page_text(&p->page, "What is called a stand-in is a fit of another material of like gloss "
                            "(MERL, by Bagher et al. 2012), where the data has not the paper's.");
    page_text(&p->page, "The paper does not say what its ball is; here it is %s. %s",
              ball->real ? "the StandardShaderBall" : "<code>builtin:ball</code>", ball->credit);
}

static bool make(paper *p, materials_figure *f, base_error *error) {
    if (!find_mask(f, error) || !show_figure(p, f, error))
        return false;
    page_text(&p->page,
              "Errors are of images of %d×%d, of the pixels that show the material, against the "
              "whole BRDF: the mean of two ground truths of other seeds, whose own noise is told "
              "as “noise alone”. Where a "
              "highlight is far narrower than the bands allow, more bands can make the relative "
              "error larger, for it counts the bright ring on dark ground more than the highlight "
              "itself.%s",
              f->judged_size[0], f->judged_size[1],
              p->options->quick ? " A quick page leaves out 100 bands." : "");
    if (!judge_all(p, f, error) || !show_rows(p, f, error) || !materials_write_times(p, f, error))
        return false;
    claim_few(p, f);
    if (has_bands(p, 3, MATERIALS_COUNTS - 1))
        claim_many(p, f);
    return true;
}

bool paper_step_materials(paper *p, base_error *error) {
    const bool quick = p->options->quick;
    materials_figure f = { .size = { quick ? 200 : materials_size[0],
                                     quick ? 272 : materials_size[1] },
                           .judged_size = { quick ? 150 : 200, quick ? 204 : 272 } };
    introduce(p);
    if (!paper_devices_open(p, &p->data.ball, &f.devices, error))
        return false;
    const bool ok = make(p, &f, error);
    free(f.mask);
    paper_devices_close(&f.devices);
    return ok;
}

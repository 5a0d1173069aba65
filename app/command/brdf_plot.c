/* SPDX-License-Identifier: MIT */
#include "app/command/brdf.h"
#include "app/image/figure.h"

#include <lampion/sh.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 4, COLUMNS_MAX = 5, STEPS = 2000 };

static const double degrees[ROWS] = { 0, 25, 50, 75 };
static const lmp_rgb ink = { 0.13f, 0.14f, 0.17f }, paper = { 1, 1, 1 };
static const lmp_rgb line_gray = { 0.75f, 0.75f, 0.78f };

/* The panels of the plot: a column per number of bands; the first (0) is the BRDF itself. */
typedef struct panels {
    image *pixels;
    int columns, bands[COLUMNS_MAX];
    lmp_brdf_table *tables[COLUMNS_MAX];
    const material *material;
} panels;

/* Draws an antialiased dot the size of a pixel. */
static void dot(image *pixels, double x, double y, lmp_rgb color) {
    const int left = (int)floor(x - 0.5), top = (int)floor(y - 0.5);
    for (int j = top; j < top + 2; j++)
        for (int i = left; i < left + 2; i++) {
            if (i < 0 || j < 0 || i >= pixels->width || j >= pixels->height)
                continue;
            const float cover = (float)((1 - fabs(x - 0.5 - i)) * (1 - fabs(y - 0.5 - j)));
            float *p = pixels->rgb + 3 * ((size_t)j * (size_t)pixels->width + (size_t)i);
            const float parts[3] = { color.r, color.g, color.b };
            for (int c = 0; c < 3; c++)
                p[c] = fminf(p[c], p[c] + cover * (parts[c] - p[c]));
        }
}

static void line(image *pixels, const double a[2], const double b[2], lmp_rgb color) {
    const int steps = 2 + (int)(2 * hypot(b[0] - a[0], b[1] - a[1]));
    for (int i = 0; i < steps; i++) {
        const double t = (double)i / (steps - 1);
        dot(pixels, a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), color);
    }
}

/* Evaluates f_r cos theta_i in the plane of incidence; angle from the normal, positive on the
 * mirror side. */
static void value_at(const panels *p, int column, double theta, double angle, const float *rgb,
                     float value[3]) {
    const lmp_vec3 wi = { (float)-sin(angle), 0, (float)cos(angle) };
    if (column == 0) {
        const lmp_vec3 wo = { (float)sin(theta), 0, (float)cos(theta) };
        const lmp_rgb f = lmp_brdf_eval(p->material->brdf, wi, wo);
        value[0] = f.r * fmaxf(wi.z, 0);
        value[1] = f.g * fmaxf(wi.z, 0);
        value[2] = f.b * fmaxf(wi.z, 0);
        return;
    }
    const lmp_brdf_table_info info = lmp_brdf_table_describe(p->tables[column]);
    static float sh[LMP_SH_COUNT(LMP_BANDS_MAX)];
    lmp_sh_eval(info.bands, wi, sh);
    for (size_t c = 0; c < 3; c++) {
        const float *plane = rgb + c * info.count;
        value[c] = 0;
        for (int l = 0; l < info.bands; l++)
            for (int m = info.mirrored ? 0 : -l; m <= l; m++)
                value[c] += sh[LMP_SH_INDEX(l, m)] * *plane++;
    }
}

/* Returns the largest value of the BRDF itself, so that all columns of a row share one scale. */
static double row_scale(const panels *p, double theta) {
    float largest = 1e-20f, v[3];
    for (int i = 0; i <= STEPS; i++) {
        value_at(p, 0, theta, -1.5707 + 3.1414 * i / STEPS, NULL, v);
        for (int c = 0; c < 3; c++)
            largest = fmaxf(largest, v[c]);
    }
    return 1 / (double)largest;
}

static void draw_panel(const panels *p, int column, int row, figure_box box) {
    static const lmp_rgb colors[3] = { { 0.8f, 0.05f, 0.04f },
                                       { 0.04f, 0.5f, 0.08f },
                                       { 0.05f, 0.12f, 0.8f } };
    const double theta = degrees[row] * 1.5707963267949 / 90, scale = row_scale(p, theta);
    const double x = box.x + box.width / 2.0, y = box.y + box.height * 0.8;
    const double reach = fmin(box.width * 0.46, box.height * 0.66);
    const double left[2] = { x - reach, y }, right[2] = { x + reach, y };
    const double eye[2] = { x - reach * sin(theta), y - reach * cos(theta) }, foot[2] = { x, y };
    line(p->pixels, left, right, line_gray);
    line(p->pixels, foot, eye, line_gray);
    static float rgb[3 * LMP_BANDS_MAX * LMP_BANDS_MAX];
    if (column > 0)
        lmp_brdf_table_interpolate(p->tables[column], (float)cos(theta), 0, rgb);
    /* lobes are drawn by the root of their values, because a highlight would otherwise hide all
     * else */
    double before[3][2] = { { 0 } };
    for (int i = 0; i <= STEPS; i++) {
        const double angle =
            column == 0 ? -1.5707 + 3.1414 * i / STEPS : -3.14159265 + 6.2831853 * i / STEPS;
        float v[3];
        value_at(p, column, theta, angle, rgb, v);
        for (int c = 0; c < 3; c++) {
            const double r = reach * sqrt(fmin(fabs((double)v[c]) * scale, 1.5));
            const double here[2] = { x + r * sin(angle), y - r * cos(angle) };
            if (i > 0)
                line(p->pixels, before[c], here, colors[c]);
            before[c][0] = here[0];
            before[c][1] = here[1];
        }
    }
}

/* Labels a column: with the end of the material's name that fits, or the number of bands. */
static void name_column(const panels *p, int column, figure_box box) {
    char text[64];
    const int room = box.width / FIGURE_LETTER_WIDTH, length = (int)strlen(p->material->name);
    if (column > 0)
        snprintf(text, sizeof text, "l=0-%d", p->bands[column] - 1);
    else
        snprintf(text, sizeof text, "%s", p->material->name + (length > room ? length - room : 0));
    figure_text(p->pixels, box, column > 0 ? box.height / 3 : FIGURE_LETTER_HEIGHT, ink, text);
}

/* Labels a row: with the angle of its view, and the largest value, by which all its lobes are
 * scaled. */
static void name_row(const panels *p, int row, figure_box box) {
    char text[64];
    snprintf(text, sizeof text, "%g deg, max %.3g", degrees[row],
             1 / row_scale(p, degrees[row] * 1.5707963267949 / 90));
    figure_text(p->pixels,
                (figure_box) { box.x, box.y + box.height - 2 * FIGURE_LETTER_HEIGHT, box.width,
                               FIGURE_LETTER_HEIGHT },
                FIGURE_LETTER_HEIGHT, ink, text);
}

static void draw_all(const panels *p) {
    const int width = p->pixels->width / p->columns, head = p->pixels->height / 16;
    const int height = (p->pixels->height - head) / ROWS;
    figure_fill(p->pixels, (figure_box) { 0, 0, p->pixels->width, p->pixels->height }, paper);
    for (int column = 0; column < p->columns; column++) {
        name_column(p, column, (figure_box) { column * width, 0, width, head });
        for (int row = 0; row < ROWS; row++) {
            const figure_box box = { column * width, head + row * height, width, height };
            draw_panel(p, column, row, box);
            if (column == 0)
                name_row(p, row, box);
        }
    }
}

bool brdf_plot(const brdf_options *o, const material *m, base_error *error) {
    static const int usual[COLUMNS_MAX] = { 0, 5, 10, 20, 60 };
    if (!m->brdf)
        return base_fail(error, m->name, "is a table: plot the BRDF it was made from");
    image pixels = { 0 };
    panels p = { .pixels = &pixels, .columns = o->bands_given ? 2 : COLUMNS_MAX, .material = m };
    bool ok =
        image_check_path(o->output, error) && image_create(&pixels, o->size[0], o->size[1], error);
    for (int i = 1; i < p.columns && ok; i++) {
        lmp_brdf_table_desc desc = o->table;
        desc.bands = p.bands[i] = o->bands_given ? o->table.bands : usual[i];
        ok = material_bake(m, &desc, &p.tables[i], error);
    }
    if (ok) {
        draw_all(&p);
        ok = image_write_figure(&pixels, o->output, error);
    }
    for (int i = 1; i < p.columns; i++)
        lmp_brdf_table_destroy(p.tables[i]);
    image_free(&pixels);
    return ok;
}

/* SPDX-License-Identifier: MIT */
/* lampion basis - the paper's figure 2: the basis functions as lobes, a row per band. */
#include "app/base/cli.h"
#include "app/base/progress.h"
#include "app/command/command.h"
#include "app/image/figure.h"

#include <lampion/sh.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define BANDS_MAX 12
#define SIDE_MIN  64
#define SIDE_MAX  8192

static const lmp_rgb paper = { 1.0f, 1.0f, 1.0f };
static const lmp_rgb zonal_column = { 0.80f, 0.85f, 0.93f };
static const lmp_rgb ink = { 0.13f, 0.14f, 0.17f };
static const lmp_rgb red = { 0.72f, 0.045f, 0.035f };
static const lmp_rgb green = { 0.05f, 0.40f, 0.075f };

/* One basis function, scaled to a largest value of 1. */
typedef struct basis_lobe {
    int l, m;
    float scale;
} basis_lobe;

static float basis_value(lmp_vec3 direction, const void *user) {
    const basis_lobe *const lobe = user;
    float sh[LMP_SH_COUNT(BANDS_MAX)];
    lmp_sh_eval(lobe->l + 1, direction, sh);
    return lobe->scale * sh[LMP_SH_INDEX(lobe->l, lobe->m)];
}

/* Returns the largest magnitude of Y_lm, sought along one meridian: all meridians through a crest
 * are alike. */
static float basis_peak(int l, int m) {
    const int steps = 2048;
    const float quarter = 1.57079633f;
    const float phi = m < 0 ? quarter / (float)-m : 0.0f;
    const basis_lobe lobe = { l, m, 1.0f };
    float peak = 0.0f;
    for (int i = 0; i <= steps; i++) {
        const float theta = 2.0f * quarter * (float)i / (float)steps;
        const lmp_vec3 direction = { sinf(theta) * cosf(phi), sinf(theta) * sinf(phi),
                                     cosf(theta) };
        peak = fmaxf(peak, fabsf(basis_value(direction, &lobe)));
    }
    return peak;
}

/* The layout of the figure: a margin on the left for the names of bands, and a line below for
 * orders. */
typedef struct layout {
    int bands, cell, left, top, text_height;
} layout;

static layout lay_out(int bands, const int size[2]) {
    layout y = { .bands = bands };
    const int columns = 2 * bands - 1;
    /* the margins take 0.6 of a cell in each direction */
    const int by_width = size[0] * 10 / (columns * 10 + 12),
              by_height = size[1] * 10 / (bands * 10 + 8);
    y.cell = by_width < by_height ? by_width : by_height;
    y.left = (size[0] - y.cell * columns) / 2;
    y.top = (size[1] - y.cell * bands - y.cell / 2) / 2;
    y.text_height = y.cell / 8;
    return y;
}

static figure_box cell_of(const layout *y, int l, int m) {
    return (figure_box) { y->left + (y->bands - 1 + m) * y->cell, y->top + l * y->cell, y->cell,
                          y->cell };
}

static void draw_names(image *pixels, const layout *y) {
    char text[16];
    for (int l = 0; l < y->bands; l++) {
        figure_box box = cell_of(y, l, -y->bands + 1);
        box.x -= y->cell / 2 + y->cell / 16;
        box.width = y->cell / 2;
        snprintf(text, sizeof text, "l=%d", l);
        figure_text(pixels, box, y->text_height, ink, text);
    }
    for (int m = 1 - y->bands; m < y->bands; m++) {
        figure_box box = cell_of(y, y->bands, m);
        box.height = y->cell / 2;
        snprintf(text, sizeof text, m > 0 ? "m=+%d" : "m=%d", m);
        figure_text(pixels, box, y->text_height, ink, text);
    }
}

static bool draw_basis(image *pixels, int bands, base_error *error) {
    const int size[2] = { pixels->width, pixels->height };
    const layout y = lay_out(bands, size);
    if (y.cell < 4)
        return base_fail(error, NULL, "%d bands need a larger image than %dx%d", bands, size[0],
                         size[1]);
    figure_fill(pixels, (figure_box) { 0, 0, size[0], size[1] }, paper);
    figure_box column = cell_of(&y, 0, 0);
    column.height = y.cell * bands + y.cell / 2;
    figure_fill(pixels, column, zonal_column);
    draw_names(pixels, &y);

    bool ok = true;
    int drawn = 0;
#pragma omp parallel for schedule(dynamic) reduction(&& : ok)
    for (int k = 0; k < bands * bands; k++) {
        const int l = (int)sqrt((double)k), m = k - l * l - l;
        const basis_lobe basis = { l, m, 1.0f / basis_peak(l, m) };
        const figure_lobe lobe = { basis_value, &basis, red, green };
        base_error lobe_error;
        ok = figure_draw_lobe(pixels, cell_of(&y, l, m), &lobe, &lobe_error) && ok;
        int done;
#pragma omp atomic capture
        done = ++drawn;
        progress_show("drawing", (double)done / (bands * bands));
    }
    progress_end();
    return ok || base_fail(error, NULL, "out of memory for the lobes");
}

static int run(const cli_command *command, int argc, char **argv) {
    int bands = 5, size[2] = { 1600, 960 };
    const char *output = NULL;
    const cli_option options[] = {
        { "output", 'o', CLI_TEXT, &output, "FILE", "image to write, .png or .exr", 0, 0, NULL,
          NULL },
        { "bands", 'n', CLI_INT, &bands, "N", "bands, a row each", 1, BANDS_MAX, NULL, NULL },
        { "size", 's', CLI_SIZE, size, "WxH", "pixels", SIDE_MIN, SIDE_MAX, NULL, NULL },
        { NULL, 0, CLI_FLAG, NULL, NULL, NULL, 0, 0, NULL, NULL },
    };
    char **operands;
    int operand_count, status;
    if (!cli_parse(command, options, argc, argv, &operand_count, &operands, &status))
        return status;
    if (!output)
        return cli_usage_output(command, "FILE");
    image pixels = { 0 };
    base_error error;
    const bool ok =
        image_check_path(output, &error) && image_create(&pixels, size[0], size[1], &error) &&
        draw_basis(&pixels, bands, &error) && image_write_figure(&pixels, output, &error);
    image_free(&pixels);
    return ok ? BASE_OK : base_report(&error);
}

const cli_command command_basis = {
    .name = "basis",
    .operands = "",
    .summary = "draw the basis functions as lobes: red positive, green negative",
    .examples = "lampion basis -o basis.png\n"
                "lampion basis --bands 3 --size 1000x640 -o basis.exr",
    .run = run,
};

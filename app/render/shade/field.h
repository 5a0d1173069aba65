/* SPDX-License-Identifier: MIT */
/* field.h - the field that METHOD_FIELD reads: kept from frame to frame, computed where the camera
 * sees something, and again where lights move. */
#ifndef LAMPION_SHADE_FIELD_H
#define LAMPION_SHADE_FIELD_H

#include "app/render/frame/surfaces.h"

typedef struct shade_field_options {
    int grid[3]; /* nodes along x, y, z */
    bool grid_given;
    float error; /* as lmp_field_desc has it */
    /* A moved light changes its nodes, which are not computed anew: faster where few lights move,
     * but the last bits depend on the frames before. */
    bool moves;
    size_t bytes_max; /* that the nodes chosen may take, or 0: those that a shader reads */
} shade_field_options;

/* More than the library's default: it does not show under many lights, and fewer are near. */
#define SHADE_FIELD_ERROR 0.08f

#define SHADE_FIELD_DEFAULTS                                                                       \
    { .error = SHADE_FIELD_ERROR }

/* The rows of a command's option table that fill a shade_field_options variable, which begins as
 * SHADE_FIELD_DEFAULTS. */
#define SHADE_FIELD_OPTION_ROWS(variable)                                                          \
    { .name = "field-grid",                                                                        \
      .kind = CLI_GRID,                                                                            \
      .target = (variable).grid,                                                                   \
      .argument = "XxYxZ",                                                                         \
      .help = "nodes of the method field; without it cubes that fill the scene's bounds",          \
      .minimum = 2,                                                                                \
      .maximum = LMP_FIELD_NODES_MAX,                                                              \
      .given = &(variable).grid_given },                                                           \
    {                                                                                              \
        .name = "field-error", .kind = CLI_FLOAT, .target = &(variable).error,                     \
        .argument = "ERROR",                                                                       \
        .help = "error of the method field, in parts of a light; a smaller one sums more lights "  \
                "exactly",                                                                         \
        .minimum = 1e-4, .maximum = 1                                                              \
    }

/* The nodes that cubic cells need, about so many in all. */
#define SHADE_FIELD_NODES 40000

/* NULL on failure. */
shade_field *shade_field_create(const scene *world, const shade_field_options *options, int bands,
                                cli_error *error);
void shade_field_destroy(shade_field *field);

typedef struct shade_field_statistics {
    lmp_field_info info;
    double update_milliseconds, evaluate_milliseconds; /* of the last sample, on the host */
} shade_field_statistics;

/* Has a frame shaded by it, on either device. field may be NULL. */
void shade_field_attach(shade_field *field, render_frame *frame);

/* The next frame computes all that it needs anew, as if all lights had moved. field may be NULL. */
void shade_field_forget(shade_field *field);
shade_field_statistics shade_field_describe(const shade_field *field);

/* --- for shade.c ------------------------------------------------------------------------------ */

/* Has the field's lights be these, and its nodes computed wherever the G-buffer has surfaces. */
const lmp_field *shade_field_follow(shade_field *field, const lmp_light *lights, size_t count,
                                    const render_surfaces *surfaces);

/* How long the surfaces took. */
void shade_field_note(shade_field *field, double milliseconds);

#endif

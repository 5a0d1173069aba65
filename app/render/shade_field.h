/* SPDX-License-Identifier: MIT */
/* shade_field.h - the field that METHOD_FIELD reads: kept between frames, computed where the camera
 * sees surfaces, and recomputed where lights move. */
#ifndef LAMPION_RENDER_SHADE_FIELD_H
#define LAMPION_RENDER_SHADE_FIELD_H

#include "app/base/cli.h"
#include "app/render/surfaces.h"

typedef struct shade_field_options {
    int grid[3]; /* nodes along x, y, z */
    bool grid_given;
    float error; /* as in lmp_field_desc */
    /* Updates nodes when lights move instead of recomputing them: faster where few lights move, but
     * the last bits depend on earlier frames. */
    bool moves;
    size_t bytes_max; /* of an automatic grid's nodes, those that a shader reads; 0: no limit */
} shade_field_options;

/* An error above the library's default: it is not visible under many lights, and fewer lights are
 * near. */
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

/* The number of nodes of an automatic grid of cubic cells, about. */
#define SHADE_FIELD_NODES 40000

/* Creates the field of a scene; returns NULL on failure. */
shade_field *shade_field_create(const scene *world, const shade_field_options *options, int bands,
                                base_error *error);
void shade_field_destroy(shade_field *field);

typedef struct shade_field_statistics {
    lmp_field_info info;
    double update_milliseconds, evaluate_milliseconds; /* of the last sample, on the CPU */
} shade_field_statistics;

/* Lets a frame be shaded by the field, on either device. field may be NULL. */
void shade_field_attach(shade_field *field, render_frame *frame);

/* Makes the next frame recompute everything that it needs, as if all lights had moved. field may be
 * NULL. */
void shade_field_forget(shade_field *field);
shade_field_statistics shade_field_describe(const shade_field *field);

/* Requests the nodes of a field around all surfaces (lmp_field_want_n). Returns false if it could
 * not. */
typedef bool shade_want(lmp_field *nodes, void *user);

/* A shade_want for the surfaces of render_surfaces, `user`. */
shade_want shade_want_surfaces;

/* --- for shade.c ------------------------------------------------------------------------------ */

/* Updates the field's lights, and computes the nodes that `want` requests. Returns NULL if memory
 * ran out. */
const lmp_field *shade_field_follow(shade_field *field, const lmp_light *lights, size_t count,
                                    shade_want *want, void *user);

/* Records how long shading the surfaces took. */
void shade_field_note(shade_field *field, double milliseconds);

#endif

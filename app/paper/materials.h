/* SPDX-License-Identifier: MIT */
/* materials.h - figure 6: five materials on a ball, measured ones, fits or stand-ins, as the data
 * has them. */
#ifndef LAMPION_PAPER_MATERIALS_H
#define LAMPION_PAPER_MATERIALS_H

#include "app/paper/frame.h"

enum { MATERIALS_COUNTS = 3 };
static const int materials_bands[MATERIALS_COUNTS] = { 10, 20, 100 };
static const int materials_size[2] = { 600, 816 }; /* of the paper's images */

/* Relative mean squared errors over the pixels that show the material, and over those that show it
 * from within 70° of its normal. */
typedef struct materials_errors {
    double all, steep;
} materials_errors;

/* All that the step measures. */
typedef struct materials_figure {
    paper_devices devices;
    int size[2], judged_size[2];
    unsigned char *mask; /* of judged_size: what each pixel sees */
    materials_errors errors[PAPER_MATERIALS][MATERIALS_COUNTS], noise[PAPER_MATERIALS];
} materials_figure;

/* A table of times, and what is claimed of them. */
bool materials_write_times(paper *p, const materials_figure *f, cli_error *error);

#endif

/* SPDX-License-Identifier: MIT */
/* paper_materials.h - figure 6: five materials on a ball; depending on the data they are measured,
 * fits or stand-ins. */
#ifndef LAMPION_STUDY_PAPER_MATERIALS_H
#define LAMPION_STUDY_PAPER_MATERIALS_H

#include "app/study/paper_frame.h"

enum { MATERIALS_COUNTS = 3 };
static const int materials_bands[MATERIALS_COUNTS] = { 10, 20, 100 };
static const int materials_size[2] = { 600, 816 }; /* of the paper's images */

/* Relative mean squared errors over the pixels that see the material, and over those within 70° of
 * its normal. */
typedef struct materials_errors {
    double all, steep;
} materials_errors;

/* The data of the figure. */
typedef struct materials_figure {
    paper_devices devices;
    int size[2], judged_size[2];
    unsigned char *mask; /* of judged_size: what each pixel sees */
    materials_errors errors[PAPER_MATERIALS][MATERIALS_COUNTS], noise[PAPER_MATERIALS];
} materials_figure;

/* Writes a table of times, and the claims about them. */
bool materials_write_times(paper *p, const materials_figure *f, base_error *error);

#endif

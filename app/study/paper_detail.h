/* SPDX-License-Identifier: MIT */
/* paper_detail.h - enlarged parts of an image, and how they change with the number of bands. */
#ifndef LAMPION_STUDY_PAPER_DETAIL_H
#define LAMPION_STUDY_PAPER_DETAIL_H

#include "app/study/paper.h"

/* A part of an image, by fractions of its width and height, from the left and top. */
typedef struct paper_detail {
    const char *name;
    double x, y, width, height;
} paper_detail;

/* Statistics of a displayed part, in linear values. */
typedef struct paper_looks {
    double color;    /* sum of max - min over the channels, relative to the sum of max */
    double contrast; /* relative standard deviation of the luminance of a hundred blocks */
} paper_looks;

/* Cuts the part out of a .png, enlarges it to about `width` pixels, puts it on the page as the file
 * `to`, and measures it. */
bool paper_show_detail(paper *p, const char *from, const paper_detail *detail, int width,
                       const char *to, const char *caption, paper_looks *looks, base_error *error);

#endif

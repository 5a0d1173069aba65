/* SPDX-License-Identifier: MIT */
/* detail.h - parts of an image, enlarged, and what a number of bands changes in them. */
#ifndef LAMPION_PAPER_DETAIL_H
#define LAMPION_PAPER_DETAIL_H

#include "app/paper/paper.h"

/* Fractions of the image's width and height, from its left and top. */
typedef struct paper_detail {
    const char *name;
    double x, y, width, height;
} paper_detail;

/* Of what is displayed, linear. */
typedef struct paper_looks {
    double color;    /* sum of max - min over the channels, in parts of the sum of max */
    double contrast; /* standard deviation of the luminance of a hundred blocks, in parts of its
                        mean */
} paper_looks;

/* Cuts the detail out of a .png, enlarges it to about `width` pixels, puts it on the page as the
 * file `to`, and measures it. */
bool paper_show_detail(paper *p, const char *from, const paper_detail *detail, int width,
                       const char *to, const char *caption, paper_looks *looks, cli_error *error);

#endif

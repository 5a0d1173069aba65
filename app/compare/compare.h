/* SPDX-License-Identifier: MIT */
/* compare.h - how far an image is from a reference. */
#ifndef LAMPION_COMPARE_H
#define LAMPION_COMPARE_H

#include "app/image/image.h"

/* Metrics in the order of compare_metrics. */
typedef enum compare_metric {
    COMPARE_RMSE,   /* root of the mean squared difference of all channels */
    COMPARE_RELMSE, /* mean of difference² / (reference² + 0.01) */
    COMPARE_PSNR,   /* 20 log10(peak / RMSE), dB; infinite for equal images */
    COMPARE_MAX,    /* largest absolute difference of a channel */
    COMPARE_SSIM,   /* mean structural similarity of luminance (Wang et al. 2004); 1 = equal */
    COMPARE_SHOWN,  /* the same of what is displayed */
    COMPARE_FLIP,   /* mean FLIP of what is displayed, 0 … 1 (flip.h) */
    COMPARE_COUNT
} compare_metric;
extern const char *const compare_metrics[COMPARE_COUNT + 1]; /* names, NULL-terminated */

/* Whether a larger value of the metric is a closer image. */
bool compare_grows_with_likeness(compare_metric metric);

typedef struct compare_result {
    double values[COMPARE_COUNT]; /* all NaN if an image holds a value that is no finite number */
    int max_x, max_y;             /* where the largest difference is; of a bad value: where it is */
    size_t bad_values;            /* NaN and infinite ones, in both images */
} compare_result;

/* All metrics but the last two, which are then NaN. The images must have equal sizes. `peak` is
 * what PSNR and SSIM count as full scale; 0 means the reference's largest value. */
bool compare_images(const image *candidate, const image *reference, double peak,
                    compare_result *result, cli_error *error);

/* The last two, of images as they are displayed, 0 … 1. */
bool compare_shown(const image *candidate, const image *reference, compare_result *result,
                   cli_error *error);

/* Encodes linear values by sRGB's transfer function, in place, held to 0 … 1. */
void compare_to_display(image *candidate);

/* The color of a difference, 0 black and 1 white. */
void compare_heat_color(double value, unsigned char rgb[3]);

/* Fails without memory. Otherwise *value is the smallest difference that `percentile` percent of
 * the pixels do not exceed, 0 < percentile <= 100: that of a pixel is its largest channel's. Pixels
 * with values that are not finite do not count; without any others it is 0. */
bool compare_difference_percentile(const image *candidate, const image *reference,
                                   double percentile, double *value);

/* Largest channel's absolute difference as color, from black over purple and orange to white at
 * `scale` and above (0: the largest there is), which is returned; bad values are green. rgb8
 * receives 3 * width * height bytes. */
double compare_heat_map(const image *candidate, const image *reference, double scale,
                        unsigned char *rgb8);

#endif

/* SPDX-License-Identifier: MIT */
/* compare.h - metrics of how far an image is from a reference. */
#ifndef LAMPION_IMAGE_COMPARE_H
#define LAMPION_IMAGE_COMPARE_H

#include "app/image/image.h"

/* Metrics in the order of compare_metrics. */
typedef enum compare_metric {
    COMPARE_RMSE,   /* root of the mean squared difference of all channels */
    COMPARE_RELMSE, /* mean of difference² / (reference² + 0.01) */
    COMPARE_PSNR,   /* 20 log10(peak / RMSE), dB; infinite for equal images */
    COMPARE_MAX,    /* largest absolute difference of a channel */
    COMPARE_SSIM,   /* mean structural similarity of luminance (Wang et al. 2004); 1 = equal */
    COMPARE_SHOWN,  /* SSIM of the images as displayed */
    COMPARE_FLIP,   /* mean FLIP of the images as displayed, 0 … 1 (flip.h) */
    COMPARE_COUNT
} compare_metric;
extern const char *const compare_metrics[COMPARE_COUNT + 1]; /* names, NULL-terminated */

/* Whether a larger value of the metric means a closer image. */
bool compare_grows_with_likeness(compare_metric metric);

typedef struct compare_result {
    double values[COMPARE_COUNT]; /* all NaN if an image has a value that is not finite */
    int max_x, max_y;             /* position of the largest difference, or of a bad value */
    size_t bad_values;            /* NaN and infinite ones, in both images */
} compare_result;

/* Computes all metrics but the last two, which become NaN. The images must have equal sizes. `peak`
 * is the full scale of PSNR and SSIM; 0 means the reference's largest value. */
bool compare_images(const image *candidate, const image *reference, double peak,
                    compare_result *result, base_error *error);

/* Computes the last two metrics, of images as displayed, 0 … 1. */
bool compare_shown(const image *candidate, const image *reference, compare_result *result,
                   base_error *error);

/* Encodes linear values by sRGB's transfer function, in place, clamped to 0 … 1. */
void compare_to_display(image *candidate);

/* Returns the color of a difference, 0 black and 1 white. */
void compare_heat_color(double value, unsigned char rgb[3]);

/* Finds the smallest difference that `percentile` percent of the pixels do not exceed, 0 <
 * percentile <= 100. A pixel's difference is that of its largest channel. Pixels with values that
 * are not finite do not count; without any others *value is 0. Returns false if memory ran out. */
bool compare_difference_percentile(const image *candidate, const image *reference,
                                   double percentile, double *value);

/* Draws the largest channel's absolute difference as color, from black over purple and orange to
 * white at `scale` and above (0: the largest difference), and returns the scale; bad values are
 * green. rgb8 receives 3 * width * height bytes. */
double compare_heat_map(const image *candidate, const image *reference, double scale,
                        unsigned char *rgb8);

#endif

/* SPDX-License-Identifier: MIT */
#include "app/image/compare.h"

#include "app/image/flip.h"
#include "app/image/ssim.h"

#include <math.h>
#include <stdlib.h>

const char *const compare_metrics[COMPARE_COUNT + 1] = {
    [COMPARE_RMSE] = "rmse", [COMPARE_RELMSE] = "relmse", [COMPARE_PSNR] = "psnr",
    [COMPARE_MAX] = "max",   [COMPARE_SSIM] = "ssim",     [COMPARE_SHOWN] = "shown",
    [COMPARE_FLIP] = "flip",
};

#define RELATIVE_FLOOR 0.01 /* of relMSE: limits the contribution of black pixels */

bool compare_grows_with_likeness(compare_metric metric) {
    return metric == COMPARE_PSNR || metric == COMPARE_SSIM || metric == COMPARE_SHOWN;
}

static size_t value_count(const image *candidate) {
    return 3 * (size_t)candidate->width * (size_t)candidate->height;
}

static void find_pixel(compare_result *result, const image *candidate, size_t value) {
    result->max_x = (int)(value / 3 % (size_t)candidate->width);
    result->max_y = (int)(value / 3 / (size_t)candidate->width);
}

/* Returns whether all values are finite; if not, sets the metrics to NaN. */
static bool count_bad_values(const image *candidate, const image *reference,
                             compare_result *result) {
    for (size_t i = 0; i < value_count(candidate); i++) {
        const size_t bad =
            (isfinite(candidate->rgb[i]) ? 0U : 1U) + (isfinite(reference->rgb[i]) ? 0U : 1U);
        if (bad && !result->bad_values)
            find_pixel(result, candidate, i);
        result->bad_values += bad;
    }
    for (int m = 0; m < COMPARE_COUNT && result->bad_values; m++)
        result->values[m] = (double)NAN;
    return result->bad_values == 0;
}

bool compare_images(const image *candidate, const image *reference, double peak,
                    compare_result *result, base_error *error) {
    const size_t count = value_count(candidate);
    double squares = 0, relative = 0, largest = -1, full = peak;
    *result = (compare_result) { .bad_values = 0 };
    if (candidate->width != reference->width || candidate->height != reference->height)
        return base_fail(error, NULL, "the images have different sizes: %dx%d and %dx%d",
                         candidate->width, candidate->height, reference->width, reference->height);
    if (!count_bad_values(candidate, reference, result))
        return true;
    for (size_t i = 0; i < count; i++) {
        const double truth = (double)reference->rgb[i];
        const double difference = fabs((double)candidate->rgb[i] - truth);
        squares += difference * difference;
        relative += difference * difference / (truth * truth + RELATIVE_FLOOR);
        if (difference > largest) {
            largest = difference;
            find_pixel(result, candidate, i);
        }
        if (peak <= 0)
            full = fmax(full, truth);
    }
    const double rmse = sqrt(squares / (double)count);
    result->values[COMPARE_RMSE] = rmse;
    result->values[COMPARE_RELMSE] = relative / (double)count;
    result->values[COMPARE_PSNR] = rmse > 0 ? 20 * log10(full / rmse) : (double)INFINITY;
    result->values[COMPARE_MAX] = largest;
    result->values[COMPARE_SHOWN] = result->values[COMPARE_FLIP] = (double)NAN;
    return compare_ssim(candidate, reference, full, &result->values[COMPARE_SSIM]) ||
           base_fail(error, NULL, "out of memory");
}

bool compare_shown(const image *candidate, const image *reference, compare_result *result,
                   base_error *error) {
    return (compare_ssim(candidate, reference, 1, &result->values[COMPARE_SHOWN]) &&
            compare_flip(candidate, reference, &result->values[COMPARE_FLIP])) ||
           base_fail(error, NULL, "out of memory");
}

void compare_to_display(image *candidate) {
    for (size_t i = 0; i < value_count(candidate); i++) {
        const double v = fmin(fmax((double)candidate->rgb[i], 0), 1);
        if (isfinite(candidate->rgb[i]))
            candidate->rgb[i] =
                (float)(v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055);
    }
}

/* The colors at 0, 1/4, 1/2, 3/4 and 1. Lightness grows evenly, so the map can also be read in
 * gray. */
#define STOPS 5
static const double heat[STOPS][3] = {
    { 0, 0, 0 }, { 87, 16, 110 }, { 188, 55, 84 }, { 249, 142, 9 }, { 255, 255, 220 }
};
static const unsigned char bad_color[3] = { 0, 255, 0 };

void compare_heat_color(double value, unsigned char rgb[3]) {
    const double at = fmin(fmax(value, 0), 1) * (STOPS - 1);
    const int stop = at < STOPS - 1 ? (int)at : STOPS - 2;
    for (int c = 0; c < 3; c++)
        rgb[c] = (unsigned char)lround(heat[stop][c] +
                                       (at - stop) * (heat[stop + 1][c] - heat[stop][c]));
}

static double pixel_difference(const image *candidate, const image *reference, size_t pixel) {
    double largest = 0;
    for (size_t i = 3 * pixel; i < 3 * pixel + 3; i++) {
        const double difference = fabs((double)candidate->rgb[i] - (double)reference->rgb[i]);
        if (!isfinite(difference))
            return (double)NAN;
        largest = fmax(largest, difference);
    }
    return largest;
}

static int by_size(const void *one, const void *other) {
    const float a = *(const float *)one, b = *(const float *)other;
    return (a > b) - (a < b);
}

bool compare_difference_percentile(const image *candidate, const image *reference,
                                   double percentile, double *value) {
    const size_t pixels = value_count(candidate) / 3;
    float *differences = malloc(pixels * sizeof *differences);
    size_t count = 0;
    if (!differences)
        return false;
    for (size_t p = 0; p < pixels; p++) {
        const double difference = pixel_difference(candidate, reference, p);
        if (isfinite(difference))
            differences[count++] = (float)difference;
    }
    qsort(differences, count, sizeof *differences, by_size);
    const double rank = ceil(percentile / 100 * (double)count);
    *value = count > 0 ? (double)differences[(size_t)fmax(rank, 1) - 1] : 0;
    free(differences);
    return true;
}

double compare_heat_map(const image *candidate, const image *reference, double scale,
                        unsigned char *rgb8) {
    const size_t pixels = value_count(candidate) / 3;
    double full = scale;
    for (size_t p = 0; p < pixels && scale <= 0; p++)
        full = fmax(full, pixel_difference(candidate, reference, p));
    for (size_t p = 0; p < pixels; p++) {
        const double difference = pixel_difference(candidate, reference, p);
        if (isfinite(difference))
            compare_heat_color(full > 0 ? difference / full : 0, rgb8 + 3 * p);
        else
            for (int c = 0; c < 3; c++)
                rgb8[3 * p + (size_t)c] = bad_color[c];
    }
    return full;
}

/* SPDX-License-Identifier: MIT */
/* judge_seeds OURS.exr THEIRS.exr…: tests whether an image with its standard error (layer "stderr")
 * shows the same as the mean of several that differ only by noise. Prints how many values are more
 * than three standard errors apart, and the ratio of the sums; status 1 if these are too many, or
 * it is too far from 1. */
#include "app/image/image.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Tolerances of the peak, and of the sum: what a sphere of triangles may be off, and what rare
 * samples hide. */
#define ROUNDING 1e-3

typedef struct moments {
    double mean, error; /* error of the mean */
} moments;

/* Returns the moments of value `at` over all images. */
static moments moments_at(const image *images, int count, size_t at) {
    double sum = 0, squares = 0;
    for (int k = 0; k < count; k++)
        sum += (double)images[k].rgb[at];
    for (int k = 0; k < count; k++)
        squares += pow((double)images[k].rgb[at] - sum / count, 2);
    return (moments) { sum / count, sqrt(squares / count / (count - 1)) };
}

static double peak_of(const image *pixels, size_t values) {
    double peak = 0;
    for (size_t i = 0; i < values; i++)
        peak = fmax(peak, (double)pixels->rgb[i]);
    return peak;
}

static bool judge(const image *ours, const image *spread, const image *theirs, int count) {
    const size_t values = 3 * (size_t)ours->width * (size_t)ours->height;
    const double peak = peak_of(ours, values), scale = peak * sqrt((double)values);
    double own = 0, other = 0, variance = 0, squares = 0;
    size_t far = 0;
    for (size_t i = 0; i < values; i++) {
        const moments of = moments_at(theirs, count, i);
        const double noise = hypot(of.error, (double)spread->rgb[i]);
        const double off = fabs(of.mean - (double)ours->rgb[i]);
        own += (double)ours->rgb[i];
        other += of.mean;
        variance += noise * noise;
        squares += off * off;
        far += !(off <= 3 * noise + ROUNDING * peak);
    }
    const double energy = other / own, doubt = 3 * sqrt(variance) / own + ROUNDING;
    printf("%zu of %zu values beyond, rms %.4f of the peak, of noise %.4f, energy %.4f +- %.4f\n",
           far, values, sqrt(squares) / scale, sqrt(variance) / scale, energy, doubt);
    return far <= values / 100 && fabs(energy - 1) <= doubt;
}

int main(int argc, char **argv) {
    const int count = argc - 2;
    image ours = { .rgb = NULL }, spread = { .rgb = NULL };
    image *const theirs = calloc((size_t)argc, sizeof *theirs);
    base_error error;
    bool ok = theirs && count > 1 && image_read(argv[1], IMAGE_READ_PIXELS, &ours, &error) &&
              image_read_layer(argv[1], "stderr", &spread, &error);
    for (int k = 0; ok && k < count; k++)
        ok = image_read(argv[k + 2], IMAGE_READ_PIXELS, &theirs[k], &error) &&
             theirs[k].width == ours.width && theirs[k].height == ours.height;
    ok = ok && judge(&ours, &spread, theirs, count);
    for (int k = 0; theirs && k < count; k++)
        image_free(&theirs[k]);
    free(theirs);
    image_free(&ours);
    image_free(&spread);
    return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}

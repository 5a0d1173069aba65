/* SPDX-License-Identifier: MIT */
#include "app/image/tone.h"

#include "shaders/shared.h"

#include <math.h>

/* --- exposure -----------------------------------------------------------------------------------
 */

/* Luminance in eighths of a stop, from 2^-40 to 2^40. */
enum { BINS_A_STOP = 8, STOPS = 40, BINS = 2 * STOPS * BINS_A_STOP };

static size_t fill_histogram(const image *pixels, size_t histogram[BINS]) {
    const size_t count = (size_t)pixels->width * (size_t)pixels->height;
    size_t lit = 0;
    for (size_t i = 0; i < count; i++) {
        const float *rgb = pixels->rgb + 3 * i;
        const float luminance = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
        if (!(luminance > 0) || !isfinite(luminance))
            continue;
        const float bin = ((float)STOPS + log2f(luminance)) * (float)BINS_A_STOP;
        histogram[bin < 0 ? 0 : bin >= (float)BINS ? BINS - 1 : (int)bin]++;
        lit++;
    }
    return lit;
}

/* The bin below which `wanted` pixels lie. */
static int find_bin(const size_t histogram[BINS], double wanted) {
    double below = 0;
    int bin = 0;
    while (bin < BINS - 1 && (below += (double)histogram[bin]) < wanted)
        bin++;
    return bin;
}

float image_auto_exposure(const image *pixels) {
    static const double middle_grey = 0.18, trimmed = 0.05;
    enum { RANGE = 8 }; /* stops */
    size_t histogram[BINS] = { 0 };
    const size_t lit = fill_histogram(pixels, histogram);
    const double low = trimmed * (double)lit, high = (double)lit - low;
    const int first = find_bin(histogram, high) - RANGE * BINS_A_STOP;
    double below = 0, weight = 0, sum = 0;
    for (int bin = 0; bin < BINS; bin++) {
        const double above = below + (double)histogram[bin];
        const double inside = fmin(above, high) - fmax(below, low);
        if (bin >= first && inside > 0) {
            sum += inside * ((bin + 0.5) / BINS_A_STOP - STOPS);
            weight += inside;
        }
        below = above;
    }
    return weight > 0 ? (float)(middle_grey / exp2(sum / weight)) : 1;
}

float image_exposure_of_stops(float stops) {
    return exp2f(stops);
}

/* --- tone ---------------------------------------------------------------------------------------
 */

static float transfer(float x) {
    return x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1 / 2.4f) - 0.055f;
}

static unsigned char to_byte(float x) {
    return (unsigned char)(255 * transfer(fminf(fmaxf(x, 0), 1)) + 0.5f);
}

/* Keeps the curve's squares finite, and off its pole below 0; NaN is black. */
static float limit(float x) {
    return x > 0 ? fminf(x, SHARED_TONE_MAX) : 0;
}

void image_tone_map(const image *pixels, float exposure, unsigned char *rgb8) {
    const size_t count = (size_t)pixels->width * (size_t)pixels->height;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < count; i++) {
        float x[3], y[3];
        for (int c = 0; c < 3; c++)
            x[c] = limit(pixels->rgb[3 * i + (size_t)c] * exposure);
        for (int c = 0; c < 3; c++)
            y[c] = shared_tone_in(c, x[0], x[1], x[2]);
        const float peak = fmaxf(y[0], fmaxf(y[1], y[2]));
        for (int c = 0; c < 3; c++)
            y[c] = shared_tone(y[c], peak);
        for (int c = 0; c < 3; c++)
            rgb8[3 * i + (size_t)c] = to_byte(shared_tone_out(c, y[0], y[1], y[2]));
    }
}

void image_encode(const image *pixels, unsigned char *rgb8) {
    const size_t count = 3 * (size_t)pixels->width * (size_t)pixels->height;
    for (size_t i = 0; i < count; i++)
        rgb8[i] = to_byte(pixels->rgb[i]);
}

/* SPDX-License-Identifier: MIT */
#include "app/image/tone.h"

#include "app/base/choice.h"
#include "app/image/srgb.h"
#include "shaders/program/tone.h"

#include <math.h>
#include <stdio.h>

/* --- exposure --------------------------------------------------------------------------------- */

/* The histogram's bins: luminance in eighths of a stop, from 2^-40 to 2^40. */
enum { BINS_A_STOP = 8, STOPS = 40, BINS = 2 * STOPS * BINS_A_STOP };

/* Returns the bin of x > 0, by its exponent and eighths of an octave: arithmetic whose bits are the
 * same everywhere, unlike a logarithm's. */
static int bin_of(float x) {
    static const float eighths[BINS_A_STOP] = {
        1, 1.09050773f, 1.18920712f, 1.29683955f, 1.41421356f, 1.54221083f, 1.68179283f, 1.83400809f
    };
    int exponent, eighth = 0;
    const float mantissa = 2 * frexpf(x, &exponent);
    while (eighth + 1 < BINS_A_STOP && mantissa >= eighths[eighth + 1])
        eighth++;
    const int bin = (STOPS + exponent - 1) * BINS_A_STOP + eighth;
    return bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin;
}

static size_t fill_histogram(const image *pixels, size_t histogram[BINS]) {
    const size_t count = (size_t)pixels->width * (size_t)pixels->height;
    size_t lit = 0;
    for (size_t i = 0; i < count; i++) {
        const float *rgb = pixels->rgb + 3 * i;
        const float luminance = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
        if (!(luminance > 0) || !isfinite(luminance))
            continue;
        histogram[bin_of(luminance)]++;
        lit++;
    }
    return lit;
}

/* Returns the bin below which `wanted` pixels lie. */
static int find_bin(const size_t histogram[BINS], double wanted) {
    double below = 0;
    int bin = 0;
    while (bin < BINS - 1 && (below += (double)histogram[bin]) < wanted)
        bin++;
    return bin;
}

image_lit image_measure_lit(const image *pixels) {
    static const double trimmed = 0.05;
    enum { RANGE = 6 }; /* stops */
    size_t histogram[BINS] = { 0 };
    const size_t lit = fill_histogram(pixels, histogram);
    const double low = trimmed * (double)lit, high = (double)lit - low;
    const int brightest = find_bin(histogram, high), first = brightest - RANGE * BINS_A_STOP;
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
    if (!(weight > 0))
        return (image_lit) { 0 };
    return (image_lit) { (float)((double)lit / ((double)pixels->width * (double)pixels->height)),
                         (float)exp2(sum / weight),
                         (float)exp2((brightest + 0.5) / BINS_A_STOP - STOPS) };
}

float image_auto_exposure(const image *pixels) {
    static const double middle_grey = 0.18, bright = 1.5;
    const image_lit lit = image_measure_lit(pixels);
    return lit.average > 0
               ? (float)fmin(middle_grey / (double)lit.average, bright / (double)lit.brightest)
               : 1;
}

float image_exposure_of_stops(float stops) {
    return (float)exp2((double)stops);
}

/* --- tone curves ------------------------------------------------------------------------------ */

/* Applies a curve; inlined for each curve, so that what its channels share is computed once. */
static inline void apply(float curve(int channel, float r, float g, float b), image_tone_run rgb) {
    for (int i = 0; i < IMAGE_TONE_RUN; i++) {
        const float r = rgb[0][i], g = rgb[1][i], b = rgb[2][i];
        rgb[0][i] = curve(0, r, g, b);
        rgb[1][i] = curve(1, r, g, b);
        rgb[2][i] = curve(2, r, g, b);
    }
}

static void filmic(image_tone_run rgb) {
    apply(tone_filmic, rgb);
}

static void linear(image_tone_run rgb) {
    apply(tone_linear, rgb);
}

const image_tone_row image_tones[] = {
    { "filmic", "makes bright colors white as film does", filmic, "tone_filmic" },
    { "linear", "shows radiance up to 1 as it is", linear, "tone_linear" },
    { NULL, NULL, NULL, NULL },
};
_Static_assert(sizeof image_tones / sizeof *image_tones <= IMAGE_TONES_MAX + 1,
               "room for programs");

const char *const *image_tone_names(void) {
    static const char *names[IMAGE_TONES_MAX + 1];
    choice_names(&image_tones[0].name, sizeof *image_tones,
                 sizeof image_tones / sizeof *image_tones - 1, names);
    return names;
}

const char *image_tone_help(void) {
    static char text[256];
    return choice_help("how a .png shows radiance", &image_tones[0].name, &image_tones[0].help,
                       sizeof *image_tones, sizeof image_tones / sizeof *image_tones - 1, text,
                       sizeof text);
}

static float transfer(float radiance) {
    const float x = fminf(fmaxf(radiance, 0), 1);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1 / 2.4f) - 0.055f;
}

/* Encoding to sRGB bytes: by the least value of each byte, from a first guess by the value's root.
 * The powers are computed in double and rounded, so that the bytes of an image do not depend on the
 * machine's math library. */
enum { GUESSES = 4096 };
typedef struct byte_curve {
    float least[257];
    unsigned char guess[GUESSES + 1];
} byte_curve;

static void make_curve(byte_curve *curve) {
    curve->least[0] = -1;
    curve->least[256] = 2;
    for (int i = 1; i < 256; i++)
        curve->least[i] = (float)image_srgb_to_linear((i - 0.5) / 255);
    int byte = 0;
    for (int i = 0; i <= GUESSES; i++) {
        const float root = (float)i / GUESSES;
        while (curve->least[byte + 1] <= root * root)
            byte++;
        curve->guess[i] = (unsigned char)byte;
    }
}

static unsigned char to_byte(const byte_curve *curve, float linear) {
    const float x = linear > 0 ? (linear < 1 ? linear : 1) : 0;
    int byte = curve->guess[(int)(sqrtf(x) * GUESSES)];
    while (byte > 0 && x < curve->least[byte])
        byte--;
    while (x >= curve->least[byte + 1])
        byte++;
    return (unsigned char)byte;
}

/* Keeps the curve's squares finite, and away from its pole below 0; NaN becomes black. */
static float limit(float x) {
    return x > 0 ? (x < SHARED_TONE_MAX ? x : SHARED_TONE_MAX) : 0;
}

/* Maps up to IMAGE_TONE_RUN pixels from `first` on to displayed values; returns how many. */
static size_t map_run(const image *pixels, size_t first, const image_display *display,
                      image_tone_run shown) {
    const size_t left = (size_t)pixels->width * (size_t)pixels->height - first;
    const size_t count = left < IMAGE_TONE_RUN ? left : IMAGE_TONE_RUN;
    for (size_t i = 0; i < IMAGE_TONE_RUN; i++)
        for (size_t c = 0; c < 3; c++)
            shown[c][i] =
                i < count ? limit(pixels->rgb[3 * (first + i) + c] * display->exposure) : 0;
    image_tones[display->tone].apply(shown);
    return count;
}

void image_tone_map(const image *pixels, const image_display *display, unsigned char *rgb8) {
    const size_t all = (size_t)pixels->width * (size_t)pixels->height;
    byte_curve curve;
    make_curve(&curve);
#pragma omp parallel for schedule(static)
    for (size_t first = 0; first < all; first += IMAGE_TONE_RUN) {
        image_tone_run shown;
        const size_t count = map_run(pixels, first, display, shown);
        for (size_t i = 0; i < count; i++)
            for (size_t c = 0; c < 3; c++)
                rgb8[3 * (first + i) + c] = to_byte(&curve, shown[c][i]);
    }
}

void image_show(image *pixels, const image_display *display) {
    const size_t all = (size_t)pixels->width * (size_t)pixels->height;
#pragma omp parallel for schedule(static)
    for (size_t first = 0; first < all; first += IMAGE_TONE_RUN) {
        image_tone_run shown;
        const size_t count = map_run(pixels, first, display, shown);
        for (size_t i = 0; i < count; i++)
            for (size_t c = 0; c < 3; c++)
                pixels->rgb[3 * (first + i) + c] = transfer(shown[c][i]);
    }
}

void image_encode(const image *pixels, unsigned char *rgb8) {
    const size_t count = 3 * (size_t)pixels->width * (size_t)pixels->height;
    byte_curve curve;
    make_curve(&curve);
    for (size_t i = 0; i < count; i++)
        rgb8[i] = to_byte(&curve, pixels->rgb[i]);
}

/* SPDX-License-Identifier: MIT */
#include "app/image/image.h"

#include "app/file/file.h"
#include "app/image/internal.h"
#include "shaders/shared.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool image_create(image *pixels, int width, int height, cli_error *error) {
    memset(pixels, 0, sizeof *pixels);
    if (width < 1 || height < 1 || width > IMAGE_SIZE_MAX || height > IMAGE_SIZE_MAX ||
        (long long)width * height > IMAGE_PIXELS_MAX)
        return cli_fail(error, NULL, "an image of %d x %d (1 to %d a side, %d pixels)", width,
                        height, IMAGE_SIZE_MAX, IMAGE_PIXELS_MAX);
    pixels->rgb = calloc((size_t)width * (size_t)height, 3 * sizeof *pixels->rgb);
    if (!pixels->rgb)
        return cli_fail(error, NULL, "out of memory for an image of %d x %d", width, height);
    pixels->width = width;
    pixels->height = height;
    return true;
}

void image_free(image *pixels) {
    free(pixels->rgb);
    memset(pixels, 0, sizeof *pixels);
}

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

static void encode(const image *pixels, unsigned char *rgb8) {
    const size_t count = 3 * (size_t)pixels->width * (size_t)pixels->height;
    for (size_t i = 0; i < count; i++)
        rgb8[i] = to_byte(pixels->rgb[i]);
}

/* --- files --------------------------------------------------------------------------------------
 */

image_format image_format_of(const char *path) {
    const char *dot = strrchr(path, '.');
    if (dot && strcasecmp(dot, ".png") == 0)
        return IMAGE_PNG;
    if (dot && strcasecmp(dot, ".exr") == 0)
        return IMAGE_EXR;
    return IMAGE_UNKNOWN;
}

static bool unknown_format(const char *path, cli_error *error) {
    return cli_fail(error, path, "unknown kind of image (name it .png or .exr)");
}

bool image_check_path(const char *path, cli_error *error) {
    file_writer writer;
    if (image_format_of(path) == IMAGE_UNKNOWN)
        return unknown_format(path, error);
    if (!file_write_begin(&writer, path, error))
        return false;
    file_write_abort(&writer);
    return true;
}

/* exposure 0: no filmic curve. */
static bool write_by_extension(const image *pixels, const char *path, float exposure,
                               cli_error *error) {
    const image_format format = image_format_of(path);
    if (format == IMAGE_EXR)
        return image_write_exr_layers(path, &(image_layer) { NULL, pixels }, 1, error);
    if (format != IMAGE_PNG)
        return unknown_format(path, error);
    unsigned char *rgb8 = malloc(3 * (size_t)pixels->width * (size_t)pixels->height);
    if (!rgb8)
        return cli_fail(error, path, "out of memory");
    if (exposure > 0)
        image_tone_map(pixels, exposure, rgb8);
    else
        encode(pixels, rgb8);
    const bool ok = image_write_png8(rgb8, pixels->width, pixels->height, path, error);
    free(rgb8);
    return ok;
}

bool image_write(const image *pixels, const char *path, float exposure, cli_error *error) {
    return write_by_extension(pixels, path, exposure, error);
}

bool image_write_figure(const image *pixels, const char *path, cli_error *error) {
    return write_by_extension(pixels, path, 0, error);
}

bool image_read(const char *path, image *pixels, cli_error *error) {
    memset(pixels, 0, sizeof *pixels);
    switch (image_format_of(path)) {
    case IMAGE_PNG:
        return image_read_png(path, pixels, error);
    case IMAGE_EXR:
        return image_read_exr(path, pixels, error);
    case IMAGE_UNKNOWN:
        break;
    }
    return unknown_format(path, error);
}

bool image_create_read(const char *path, long long width, long long height, image *pixels,
                       cli_error *error) {
    if (width < 1 || height < 1 || width > IMAGE_SIZE_MAX || height > IMAGE_SIZE_MAX ||
        width * height > IMAGE_PIXELS_MAX)
        return cli_fail(error, path, "an image of %lld x %lld is too large (%d a side, %d pixels)",
                        width, height, IMAGE_SIZE_MAX, IMAGE_PIXELS_MAX);
    return image_create(pixels, (int)width, (int)height, error);
}

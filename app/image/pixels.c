/* SPDX-License-Identifier: MIT */
#include "app/image/pixels.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool image_create(image *pixels, int width, int height, base_error *error) {
    memset(pixels, 0, sizeof *pixels);
    if (width < 1 || height < 1 || width > IMAGE_SIZE_MAX || height > IMAGE_SIZE_MAX ||
        (long long)width * height > IMAGE_PIXELS_MAX)
        return base_fail(error, NULL, "an image of %d x %d (1 to %d a side, %d pixels)", width,
                         height, IMAGE_SIZE_MAX, IMAGE_PIXELS_MAX);
    pixels->rgb = calloc((size_t)width * (size_t)height, 3 * sizeof *pixels->rgb);
    if (!pixels->rgb)
        return base_fail(error, NULL, "out of memory for an image of %d x %d", width, height);
    pixels->width = width;
    pixels->height = height;
    return true;
}

void image_free(image *pixels) {
    free(pixels->rgb);
    memset(pixels, 0, sizeof *pixels);
}

void image_make_finite(image *pixels, const char *path) {
    const size_t count = 3 * (size_t)pixels->width * (size_t)pixels->height;
    size_t changed = 0;
    for (size_t i = 0; i < count; i++) {
        float *value = &pixels->rgb[i];
        if (fabsf(*value) <= FLT_MAX)
            continue;
        *value = *value > 0 ? FLT_MAX : *value < 0 ? -FLT_MAX : 0;
        changed++;
    }
    if (changed > 0)
        base_note(path,
                  "%zu values are beyond what float32 holds, and written as the largest that it "
                  "does, or as 0",
                  changed);
}

bool image_create_decoded(const image_source *source, long long width, long long height,
                          image *pixels, base_error *error) {
    const bool fits = width >= 1 && height >= 1 && width <= IMAGE_SIZE_MAX &&
                      height <= IMAGE_SIZE_MAX && width * height <= IMAGE_PIXELS_MAX;
    if (!fits)
        return base_fail(error, source->path,
                         "an image of %lld x %lld is too large (%d a side, %d pixels)", width,
                         height, IMAGE_SIZE_MAX, IMAGE_PIXELS_MAX);
    if (width * height > source->pixels_max)
        return base_fail(error, source->path,
                         "an image of %lld x %lld is too large (%lld pixels; see --max-pixels)",
                         width, height, source->pixels_max);
    return image_create(pixels, (int)width, (int)height, error);
}

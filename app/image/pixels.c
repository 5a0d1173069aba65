/* SPDX-License-Identifier: MIT */
#include "app/image/pixels.h"

#include <stdlib.h>
#include <string.h>

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

bool image_create_decoded(const image_source *source, long long width, long long height,
                          image *pixels, cli_error *error) {
    const bool fits = width >= 1 && height >= 1 && width <= IMAGE_SIZE_MAX &&
                      height <= IMAGE_SIZE_MAX && width * height <= IMAGE_PIXELS_MAX;
    if (!fits)
        return cli_fail(error, source->path,
                        "an image of %lld x %lld is too large (%d a side, %d pixels)", width,
                        height, IMAGE_SIZE_MAX, IMAGE_PIXELS_MAX);
    if (width * height > source->pixels_max)
        return cli_fail(error, source->path,
                        "an image of %lld x %lld is too large (%lld pixels; see --max-pixels)",
                        width, height, source->pixels_max);
    return image_create(pixels, (int)width, (int)height, error);
}

/* SPDX-License-Identifier: MIT */
#include "app/image/image.h"
#include "app/base/file_writer.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

image_format image_format_of(const char *path) {
    const char *dot = strrchr(path, '.');
    if (dot && strcasecmp(dot, ".png") == 0)
        return IMAGE_PNG;
    if (dot && strcasecmp(dot, ".exr") == 0)
        return IMAGE_EXR;
    return IMAGE_UNKNOWN;
}

static bool fail_format(const char *path, base_error *error) {
    return base_fail(error, path, "unknown kind of image (name it .png or .exr)");
}

bool image_check_path(const char *path, base_error *error) {
    file_writer writer;
    if (image_format_of(path) == IMAGE_UNKNOWN)
        return fail_format(path, error);
    if (!file_write_begin(&writer, path, error))
        return false;
    file_write_abort(&writer);
    return true;
}

/* Writes an image for the display or, with display NULL, as it is. */
static bool write_by_extension(const image *pixels, const char *path, const image_display *display,
                               base_error *error) {
    const image_format format = image_format_of(path);
    if (format == IMAGE_EXR)
        return image_write_exr_layers(path, &(image_layer) { NULL, pixels }, 1, error);
    if (format != IMAGE_PNG)
        return fail_format(path, error);
    unsigned char *rgb8 = malloc(3 * (size_t)pixels->width * (size_t)pixels->height);
    if (!rgb8)
        return base_fail(error, path, "out of memory");
    if (display)
        image_tone_map(pixels, display, rgb8);
    else
        image_encode(pixels, rgb8);
    const bool ok = image_write_png8(rgb8, pixels->width, pixels->height, path, error);
    free(rgb8);
    return ok;
}

bool image_write(const image *pixels, const char *path, const image_display *display,
                 base_error *error) {
    return write_by_extension(pixels, path, display, error);
}

bool image_write_figure(const image *pixels, const char *path, base_error *error) {
    return write_by_extension(pixels, path, NULL, error);
}

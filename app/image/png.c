/* SPDX-License-Identifier: MIT */
#include "app/image/png.h"

#include <math.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

bool image_write_png8(const unsigned char *rgb8, int width, int height, const char *path,
                      base_error *error) {
    return image_write_png8_text(rgb8, width, height, NULL, path, error);
}

static float linearize(unsigned char byte) {
    const float x = (float)byte / 255;
    return x <= 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
}

static bool decode_pixels(png_image *png, const image_source *source, image *pixels,
                          base_error *error) {
    png->format = PNG_FORMAT_RGB;
    if (!image_create_decoded(source, png->width, png->height, pixels, error))
        return false;
    const size_t count = 3 * (size_t)pixels->width * (size_t)pixels->height;
    unsigned char *rgb8 = malloc(count);
    static const png_color black = { 0, 0, 0 };
    if (!rgb8 || !png_image_finish_read(png, &black, rgb8, 0, NULL)) {
        free(rgb8);
        image_free(pixels);
        return rgb8 ? base_fail(error, source->path, "is a damaged or truncated PNG (libpng: %s)",
                                png->message)
                    : base_fail(error, source->path, "out of memory");
    }
    float linear[256];
    for (int i = 0; i < 256; i++)
        linear[i] = linearize((unsigned char)i);
    for (size_t i = 0; i < count; i++)
        pixels->rgb[i] = linear[rgb8[i]];
    free(rgb8);
    return true;
}

bool image_decode_png(const image_source *source, image *pixels, base_error *error) {
    png_image png = { .version = PNG_IMAGE_VERSION };
    bool ok = png_image_begin_read_from_memory(&png, source->data, source->size);
    if (!ok)
        base_fail(error, source->path, "is damaged, truncated or not a PNG (libpng: %s)",
                  png.message);
    ok = ok && decode_pixels(&png, source, pixels, error);
    png_image_free(&png);
    return ok;
}

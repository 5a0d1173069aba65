/* SPDX-License-Identifier: MIT */
/* texels_stb.c - formats without a library of their own, by stb_image: TGA and BMP. */
#include "app/image/texels.h"

#include <limits.h>
#include <stb_image.h>
#include <stdio.h>
#include <string.h>

static bool begins_bmp(const unsigned char *data, size_t size) {
    return size >= 2 && memcmp(data, "BM", 2) == 0;
}

/* Whether a file looks like TGA, which has no signature: an identifier's length, whether there is a
 * color map, and a known type of image. */
static bool begins_tga(const unsigned char *data, size_t size) {
    const unsigned kind = size >= 18 ? data[2] : 0;
    const bool mapped = kind == 1 || kind == 9, plain = (kind & 7) == 2 || (kind & 7) == 3;
    return (mapped && data[1] == 1) || (plain && kind <= 11 && data[1] <= 1);
}

static bool fail(texels_reason *reason) {
    snprintf(reason->text, sizeof reason->text, "stb_image: %s", stbi_failure_reason());
    return false;
}

bool texels_stb_measure(const unsigned char *data, size_t size, int *width, int *height,
                        texels_reason *reason) {
    int channels;
    return (size <= INT_MAX && stbi_info_from_memory(data, (int)size, width, height, &channels)) ||
           fail(reason);
}

bool texels_stb_decode(const unsigned char *data, size_t size, int width, int height,
                       unsigned char *rgba, texels_reason *reason) {
    int w, h, channels;
    unsigned char *const pixels = stbi_load_from_memory(data, (int)size, &w, &h, &channels, 4);
    const bool ok = pixels && w == width && h == height;
    if (ok)
        memcpy(rgba, pixels, 4 * (size_t)width * (size_t)height);
    stbi_image_free(pixels);
    return ok || fail(reason);
}

const texels_decoder texels_tga = { begins_tga, texels_stb_measure, texels_stb_decode };
const texels_decoder texels_bmp = { begins_bmp, texels_stb_measure, texels_stb_decode };

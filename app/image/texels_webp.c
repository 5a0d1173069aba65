/* SPDX-License-Identifier: MIT */
/* texels_webp.c - WebP by libwebp: lossy and lossless, with and without alpha. */
#include "app/image/texels.h"

#include <stdio.h>
#include <string.h>
#include <webp/decode.h>

static bool begins(const unsigned char *data, size_t size) {
    return size >= 12 && memcmp(data, "RIFF", 4) == 0 && memcmp(data + 8, "WEBP", 4) == 0;
}

static bool fail(texels_reason *reason, const char *why) {
    snprintf(reason->text, sizeof reason->text, "%s", why);
    return false;
}

static bool measure(const unsigned char *data, size_t size, int *width, int *height,
                    texels_reason *reason) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(data, size, &features) != VP8_STATUS_OK)
        return fail(reason, "it is damaged");
    *width = features.width;
    *height = features.height;
    return !features.has_animation || fail(reason, "it is an animation");
}

static bool decode(const unsigned char *data, size_t size, int width, int height,
                   unsigned char *rgba, texels_reason *reason) {
    const size_t row = 4 * (size_t)width;
    return WebPDecodeRGBAInto(data, size, rgba, row * (size_t)height, (int)row) ||
           fail(reason, "it is damaged or truncated");
}

const texels_decoder texels_webp = { begins, measure, decode };

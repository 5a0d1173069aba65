/* SPDX-License-Identifier: MIT */
/* Images for `compare`: .png. */
#include "app/image/png.h"
#include "fuzz/png.h"

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const fuzz_png png = fuzz_png_make(data, size);
    const image_source source = {
        .path = "input", .data = png.bytes, .size = png.size, .pixels_max = 1 << 16
    };
    image pixels;
    base_error error;
    if (png.bytes && image_decode_png(&source, &pixels, &error)) {
        for (size_t i = 0; i < 3 * (size_t)pixels.width * (size_t)pixels.height; i++)
            if (!(pixels.rgb[i] >= 0 && pixels.rgb[i] <= 1))
                abort();
        image_free(&pixels);
    }
    free(png.bytes);
    return 0;
}

/* SPDX-License-Identifier: MIT */
/* Environments: .hdr. */
#include "app/image/hdr.h"
#include "fuzz/file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const image_source source = {
        .path = "input", .data = data, .size = size, .pixels_max = 1 << 22
    };
    image pixels;
    base_error error;
    if (image_decode_hdr(&source, &pixels, &error))
        image_free(&pixels);
    return 0;
}

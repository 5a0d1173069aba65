/* SPDX-License-Identifier: MIT */
/* Text chunks of screenshots: of any kind, deflated or not, and never larger than the limit. */
#include "app/image/png.h"
#include "fuzz/png.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const fuzz_png png = fuzz_png_make(data, size);
    const image_source source = { .path = "input", .data = png.bytes, .size = png.size };
    char *text;
    base_error error;
    if (png.bytes && image_decode_png_text(&source, "lampion", &text, &error)) {
        if (strlen(text) > IMAGE_TEXT_MAX)
            abort();
        free(text);
    }
    free(png.bytes);
    return 0;
}

/* SPDX-License-Identifier: MIT */
/* Textures: what is decoded has all of its texels. A PNG gets valid checksums. stb_image decodes
 * TGA and BMP here, and also PNG and JPEG in a browser. */
#include "app/scene/texture.h"
#include "app/image/texels.h"
#include "fuzz/png.h"

#include <stdlib.h>

static void decode_as_browser(const uint8_t *data, size_t size) {
    enum { LARGEST = 1 << 12 };
    int width, height;
    texels_reason reason;
    if (!texels_stb_measure(data, size, &width, &height, &reason) || width <= 0 || height <= 0 ||
        width > LARGEST || height > LARGEST)
        return;
    unsigned char *const rgba = malloc(4 * (size_t)width * (size_t)height);
    if (rgba)
        texels_stb_decode(data, size, width, height, rgba, &reason);
    free(rgba);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const bool is_png = size >= 13 && memcmp(data, "\x89PNG", 4) == 0;
    const fuzz_png png = is_png ? fuzz_png_make(data, size) : (fuzz_png) { .bytes = NULL };
    scene_builder builder = { 0 };
    scene_texture texture = { 0 };
    base_error error;
    if (texture_keep(&builder, is_png ? png.bytes : data, size, TEXTURE_ANY, "input", "image",
                     &texture, &error) &&
        texture_decode_all(&builder, "input", &error) &&
        builder_count(&builder, BLOB_UNSUPPORTED) == 0 &&
        builder_count(&builder, BLOB_TEXELS) != 4 * (size_t)texture.width * texture.height)
        abort();
    builder_free(&builder);
    decode_as_browser(is_png ? png.bytes : data, size);
    free(png.bytes);
    return 0;
}

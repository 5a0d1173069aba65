/* SPDX-License-Identifier: MIT */
/* Textures: what is decoded has all its texels. A PNG has its checksums mended. */
#include "app/scene/texture.h"
#include "fuzz/png.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const bool is_png = size >= 13 && memcmp(data, "\x89PNG", 4) == 0;
    const fuzz_png png = is_png ? fuzz_png_make(data, size) : (fuzz_png) { .bytes = NULL };
    scene_builder builder = { 0 };
    scene_texture texture = { 0 };
    cli_error error;
    if (texture_keep(&builder, is_png ? png.bytes : data, size, TEXTURE_ANY, "input", "image",
                     &texture, &error) &&
        texture_decode_all(&builder, "input", &error) &&
        builder_count(&builder, BLOB_LEFT_OUT) == 0 &&
        builder_count(&builder, BLOB_TEXELS) != 4 * (size_t)texture.width * texture.height)
        abort();
    builder_free(&builder);
    free(png.bytes);
    return 0;
}

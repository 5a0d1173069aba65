/* SPDX-License-Identifier: MIT */
/* Images to be compared: .exr. */
#include "app/image/image.h"
#include "fuzz/file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    image pixels;
    cli_error error;
    char path[64];
    if (fuzz_file_write(data, size, ".exr", path) && image_read(path, &pixels, &error))
        image_free(&pixels);
    unlink(path);
    return 0;
}

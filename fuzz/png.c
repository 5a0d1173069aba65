/* SPDX-License-Identifier: MIT */
/* Pictures to be compared: .png. */
#include "app/image/image.h"
#include "fuzz/file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    image picture;
    cli_error error;
    char path[64];
    if (fuzz_file_write(data, size, ".png", path) && image_read(path, &picture, &error))
        image_free(&picture);
    unlink(path);
    return 0;
}

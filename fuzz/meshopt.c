/* SPDX-License-Identifier: MIT */
/* Buffer views that meshoptimizer compressed: four bytes say how, and the rest is the stream. */
#include "app/scene/gltf/meshopt.h"
#include "fuzz/file.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const char *wrong;
    if (size < 4)
        return 0;
    const meshopt_layout layout = { (meshopt_mode)(data[0] % 3), (meshopt_filter)(data[1] % 5),
                                    (size_t)data[2] * 3, 1 + (size_t)data[3] };
    unsigned char *const bytes = meshopt_decode(&layout, data + 4, size - 4, &wrong);
    if (!bytes == !wrong)
        abort();
    free(bytes);
    return 0;
}

/* SPDX-License-Identifier: MIT */
/* MERL .binary files. */
#include <lampion/brdf.h>

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    lmp_brdf *brdf;
    lmp_brdf_fault fault;
    if (lmp_brdf_read_merl(NULL, data, size, &fault, &brdf) != LMP_OK)
        return 0;
    static const lmp_vec3 directions[] = { { 0, 0, 1 },
                                           { 0.6f, 0, 0.8f },
                                           { -0.48f, 0.64f, 0.6f } };
    for (int i = 0; i < 9; i++)
        if (!(lmp_brdf_eval(brdf, directions[i / 3], directions[i % 3]).r >= 0))
            abort();
    lmp_brdf_destroy(brdf);
    return 0;
}

/* SPDX-License-Identifier: MIT */
/* Preintegrated lobes, .lmpr. */
#include "fuzz/checksum.h"
#include "fuzz/shade.h"

#include <math.h>

static void use(const lmp_preintegrated_lobe *lobe) {
    static const float exponents[] = { 0, 1, 7.5f, 300, 1e6f, 1e12f },
                       points[] = { 0, 0.1f, 0.5f, 1 };
    for (int e = 0; e < 6; e++)
        for (int i = 0; i < 16; i++)
            if (!isfinite(lmp_preintegrated_lobe_eval(lobe, exponents[e], points[i / 4],
                                                      2 * points[i % 4] - 1)))
                abort();
    /* The kernel has a lookup of its own. */
    const lmp_shade_settings settings = { .method = LMP_SHADE_PREINTEGRATED, .lobe = lobe };
    for (int e = 0; e < 6; e++) {
        const lmp_surface surface = { .normal = { 0, 0, 1 }, .view = { 0.6f, 0, 0.8f } };
        const lmp_material material = { .diffuse = { 1, 1, 1 },
                                        .specular = { 1, 1, 1 },
                                        .exponent = exponents[e] };
        (void)lmp_shade(&settings, &material, &surface, fuzz_lights, FUZZ_LIGHTS);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    lmp_preintegrated_lobe *lobe;
    lmp_result result = lmp_preintegrated_lobe_read(NULL, data, size, NULL, &lobe);
    if (result == LMP_ERROR_CHECKSUM) {
        unsigned char *valid = fuzz_checksum(data, size);
        if (!valid)
            return 0;
        result = lmp_preintegrated_lobe_read(NULL, valid, size, NULL, &lobe);
        free(valid);
    }
    if (result == LMP_OK)
        use(lobe);
    lmp_preintegrated_lobe_destroy(lobe);
    return 0;
}

/* SPDX-License-Identifier: MIT */
/* Preintegrated BRDFs, .lmps. */
#include "fuzz/checksum.h"
#include "fuzz/shade.h"

/* Checks that lookups stay inside the table, whatever the numbers are. */
static void use(const lmp_preintegrated_brdf *preintegrated) {
    static const float points[] = { 0, 0.1f, 0.5f, 1 };
    static const lmp_vec3 axes[] = {
        { 0, 0, 1 }, { 0, 0, -1 }, { -1, 0, 0 }, { 0.6f, -0.8f, 0 }, { -0.6f, 0, 0.8f }
    };
    for (int i = 0; i < 16; i++)
        for (int k = 0; k < 5; k++)
            (void)lmp_preintegrated_brdf_eval(preintegrated, points[i / 4], axes[k], points[i % 4]);
    for (int i = 0; i < 4; i++)
        (void)lmp_preintegrated_brdf_ambient(preintegrated, points[i]);
    /* The kernel has a lookup of its own. */
    for (int k = 0; k < 5; k++) {
        const lmp_surface surface = { .normal = { 0, 0, 1 }, .view = axes[k] };
        const lmp_material material = { .kind = LMP_MATERIAL_PREINTEGRATED,
                                        .preintegrated = preintegrated };
        (void)lmp_shade(NULL, &material, &surface, fuzz_lights, FUZZ_LIGHTS);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    lmp_preintegrated_brdf *preintegrated;
    lmp_result result = lmp_preintegrated_brdf_read(NULL, data, size, NULL, &preintegrated);
    if (result == LMP_ERROR_CHECKSUM) {
        unsigned char *valid = fuzz_checksum(data, size);
        if (!valid)
            return 0;
        result = lmp_preintegrated_brdf_read(NULL, valid, size, NULL, &preintegrated);
        free(valid);
    }
    if (result == LMP_OK)
        use(preintegrated);
    lmp_preintegrated_brdf_destroy(preintegrated);
    return 0;
}

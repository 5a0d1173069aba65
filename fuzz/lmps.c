/* SPDX-License-Identifier: MIT */
/* Responses of measured materials, .lmps. */
#include "fuzz/checksum.h"
#include "fuzz/shade.h"

/* Whatever the numbers are, readings stay inside. */
static void use(const lmp_preintegrated_brdf *response) {
    static const float places[] = { 0, 0.1f, 0.5f, 1 };
    static const lmp_vec3 axes[] = {
        { 0, 0, 1 }, { 0, 0, -1 }, { -1, 0, 0 }, { 0.6f, -0.8f, 0 }, { -0.6f, 0, 0.8f }
    };
    for (int i = 0; i < 16; i++)
        for (int k = 0; k < 5; k++)
            (void)lmp_preintegrated_brdf_eval(response, places[i / 4], axes[k], places[i % 4]);
    for (int i = 0; i < 4; i++)
        (void)lmp_preintegrated_brdf_ambient(response, places[i]);
    /* The kernel has a reading of its own. */
    for (int k = 0; k < 5; k++) {
        const lmp_surface surface = { .normal = { 0, 0, 1 }, .view = axes[k] };
        const lmp_material material = { .kind = LMP_MATERIAL_PREINTEGRATED,
                                        .preintegrated = response };
        (void)lmp_shade(NULL, &material, &surface, fuzz_lights, FUZZ_LIGHTS);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    lmp_preintegrated_brdf *response;
    lmp_result result = lmp_preintegrated_brdf_read(NULL, data, size, &response);
    if (result == LMP_ERROR_CHECKSUM) {
        unsigned char *valid = fuzz_checksum(data, size);
        if (!valid)
            return 0;
        result = lmp_preintegrated_brdf_read(NULL, valid, size, &response);
        free(valid);
    }
    if (result == LMP_OK)
        use(response);
    lmp_preintegrated_brdf_destroy(response);
    return 0;
}

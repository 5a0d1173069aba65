/* SPDX-License-Identifier: MIT */
/* Tables of SGD fits: an accepted row has finite numbers, and its BRDF reflects no negative light
 * and no NaN. */
#include "app/scene/sgd_file.h"
#include "fuzz/numbers.h"

static void check(const lmp_sgd *sgd) {
    lmp_brdf *brdf;
    if (lmp_brdf_create_sgd(NULL, sgd, &brdf) != LMP_OK)
        return;
    const lmp_vec3 out = { 0.6f, 0, 0.8f }, in[] = { { 0, 0, 1 }, { -0.6f, 0, 0.8f } };
    for (int i = 0; i < 2; i++) {
        const lmp_rgb f = lmp_brdf_eval(brdf, in[i], out);
        fuzz_expect(f.r >= 0 && f.g >= 0 && f.b >= 0);
    }
    lmp_brdf_destroy(brdf);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    lmp_sgd sgd;
    base_error error;
    char *const text = fuzz_text(data, size);
    if (!text)
        return 0;
    if (sgd_file_find(text, "a", "input", &sgd, &error))
        check(&sgd);
    free(text);
    return 0;
}

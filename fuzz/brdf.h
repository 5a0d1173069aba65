/* SPDX-License-Identifier: MIT */
/* brdf.h - the check of a reader of measured BRDFs: what it accepts reflects no negative light and
 * no NaN. */
#ifndef LAMPION_FUZZ_BRDF_H
#define LAMPION_FUZZ_BRDF_H

#include <lampion/brdf.h>

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef lmp_result (*fuzz_brdf_reader)(const lmp_host *, const void *, size_t, lmp_parse_error *,
                                       lmp_brdf **);

static inline int fuzz_brdf(fuzz_brdf_reader read, const uint8_t *data, size_t size) {
    lmp_brdf *brdf;
    lmp_parse_error error;
    if (read(NULL, data, size, &error, &brdf) != LMP_OK)
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

#endif

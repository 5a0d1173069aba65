/* SPDX-License-Identifier: MIT */
/* RGL .bsdf tensor files. */
#include "fuzz/brdf.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    return fuzz_brdf(lmp_brdf_read_rgl, data, size);
}

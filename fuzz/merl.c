/* SPDX-License-Identifier: MIT */
/* MERL .binary files. */
#include "fuzz/brdf.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    return fuzz_brdf(lmp_brdf_read_merl, data, size);
}

/* SPDX-License-Identifier: MIT */
/* checksum.h - for formats whose last 4 bytes are a checksum: the input with a valid one, so that
 * the rest of the reader is reached. */
#ifndef LAMPION_FUZZ_CHECKSUM_H
#define LAMPION_FUZZ_CHECKSUM_H

#include "src/base/bytes.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The caller frees it; NULL without memory, or for inputs too short. */
static inline unsigned char *fuzz_checksum(const uint8_t *data, size_t size) {
    unsigned char *valid = size >= 4 ? malloc(size) : NULL;
    if (!valid)
        return NULL;
    memcpy(valid, data, size);
    lmp_bytes_store_u32(valid + size - 4, lmp_bytes_checksum(valid, size - 4));
    return valid;
}

#endif

/* SPDX-License-Identifier: MIT */
/* checksum.h - for formats that end with a checksum of 4 bytes: replaces it by a valid one, so that
 * the rest of the reader is reached. */
#ifndef LAMPION_FUZZ_CHECKSUM_H
#define LAMPION_FUZZ_CHECKSUM_H

#include "src/base/bytes.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Returns a copy of the input with a valid checksum, to be freed; NULL for inputs that are too
 * short, or if memory ran out. */
static inline unsigned char *fuzz_checksum(const uint8_t *data, size_t size) {
    unsigned char *valid = size >= 4 ? malloc(size) : NULL;
    if (!valid)
        return NULL;
    memcpy(valid, data, size);
    lmpi_bytes_store_u32(valid + size - 4, lmpi_bytes_checksum(valid, size - 4));
    return valid;
}

#endif

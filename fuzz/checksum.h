/* SPDX-License-Identifier: MIT */
/* checksum.h - for formats whose last 4 bytes are a checksum: the input with a sound one, so that
 * the rest of the reader is reached. */
#ifndef LAMPION_FUZZ_CHECKSUM_H
#define LAMPION_FUZZ_CHECKSUM_H

#include "src/base/bytes.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The caller frees it; NULL without memory, or for inputs too short. */
static inline unsigned char *fuzz_checksum(const uint8_t *data, size_t size) {
    unsigned char *sound = size >= 4 ? malloc(size) : NULL;
    if (!sound)
        return NULL;
    memcpy(sound, data, size);
    lmp_bytes_store_u32(sound + size - 4, lmp_bytes_checksum(sound, size - 4));
    return sound;
}

#endif

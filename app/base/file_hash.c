/* SPDX-License-Identifier: MIT */
#include "app/base/file_hash.h"

#include <stdio.h>
#include <xxhash.h>

void file_hash_add(file_hash *hash, const void *data, size_t size) {
    const XXH128_hash_t part = XXH3_128bits(data, size);
    const uint64_t chain[] = { hash->low, hash->high, part.low64, part.high64 };
    const XXH128_hash_t sum = XXH3_128bits(chain, sizeof chain);
    *hash = (file_hash) { sum.low64, sum.high64 };
}

void file_hash_text(const file_hash *hash, char text[33]) {
    snprintf(text, 33, "%016llx%016llx", (unsigned long long)hash->high,
             (unsigned long long)hash->low);
}

/* SPDX-License-Identifier: MIT */
/* damage.h - checks that the library's readers survive files whose bytes change. */
#ifndef LAMPION_DAMAGE_H
#define LAMPION_DAMAGE_H

#include "src/base/bytes.h"
#include "tests/oracle/check.h"

/* A reader that checks that a failure leaves nothing, uses what was read, and frees it. */
typedef lmp_result (*damage_reader)(const unsigned char *bytes, size_t size);

/* Replaces the checksum at the end by that of the bytes before it. */
static inline void damage_sign(unsigned char *bytes, size_t size) {
    lmpi_bytes_store_u32(bytes + size - 4, lmpi_bytes_checksum(bytes, size - 4));
}

/* Checks that truncated bytes, a wrong bit and another version are refused, each for its own
 * reason. */
static inline void damage_is_refused(unsigned char *bytes, size_t size, damage_reader read) {
    for (size_t length = 0; length < size; length += 1 + length / 16)
        assert_int_not_equal(read(bytes, length), LMP_OK);
    bytes[size / 2] ^= 1;
    assert_int_equal(read(bytes, size), LMP_ERROR_CHECKSUM);
    bytes[size / 2] ^= 1;
    const unsigned char version = bytes[8];
    bytes[8] = 99;
    assert_int_equal(read(bytes, size), LMP_ERROR_VERSION);
    bytes[8] = version;
    assert_int_equal(read(bytes, size), LMP_OK);
}

/* Checks that each byte from `first` to `end`, changed and signed, is refused or gives what stays
 * in bounds. */
static inline void damage_stays_in_bounds(unsigned char *bytes, size_t size, size_t first,
                                          size_t end, int count, damage_reader read) {
    for (int i = 0; i < count; i++) {
        const size_t at = first + (size_t)(check_random() * (double)(end - first));
        const unsigned char was = bytes[at];
        bytes[at] = (unsigned char)(check_random() * 256);
        damage_sign(bytes, size);
        (void)read(bytes, size);
        bytes[at] = was;
    }
    damage_sign(bytes, size);
}

#endif

/* SPDX-License-Identifier: MIT */
/* bytes.h - little-endian numbers in a file format, on any machine, and its checksum. */
#ifndef LAMPION_BASE_BYTES_H
#define LAMPION_BASE_BYTES_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Each returns the place after what it wrote. */
static inline unsigned char *lmp_bytes_store_u16(unsigned char *to, uint16_t value) {
    to[0] = (unsigned char)value;
    to[1] = (unsigned char)(value >> 8);
    return to + 2;
}
static inline unsigned char *lmp_bytes_store_u32(unsigned char *to, uint32_t value) {
    return lmp_bytes_store_u16(lmp_bytes_store_u16(to, (uint16_t)value), (uint16_t)(value >> 16));
}
static inline unsigned char *lmp_bytes_store_f32(unsigned char *to, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return lmp_bytes_store_u32(to, bits);
}

/* Each reads at *from and moves it on. */
static inline uint16_t lmp_bytes_load_u16(const unsigned char **from) {
    const unsigned char *p = *from;
    *from += 2;
    return (uint16_t)(p[0] | p[1] << 8);
}
static inline uint32_t lmp_bytes_load_u32(const unsigned char **from) {
    const uint32_t low = lmp_bytes_load_u16(from);
    return low | (uint32_t)lmp_bytes_load_u16(from) << 16;
}
static inline float lmp_bytes_load_f32(const unsigned char **from) {
    const uint32_t bits = lmp_bytes_load_u32(from);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* CRC-32C (Castagnoli), eight bytes a step. */
uint32_t lmp_bytes_checksum(const void *bytes, size_t size);

#endif

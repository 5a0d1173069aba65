/* SPDX-License-Identifier: MIT */
/* bytes.h - little-endian numbers in a file format, on any machine, and its checksum. */
#ifndef LAMPION_BASE_BYTES_H
#define LAMPION_BASE_BYTES_H

#include <lampion/base.h>

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Each returns the address after what it wrote. */
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
static inline unsigned char *lmp_bytes_store_u64(unsigned char *to, uint64_t value) {
    return lmp_bytes_store_u32(lmp_bytes_store_u32(to, (uint32_t)value), (uint32_t)(value >> 32));
}
static inline unsigned char *lmp_bytes_store_f64(unsigned char *to, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return lmp_bytes_store_u64(to, bits);
}

/* Each reads in place. */
static inline uint16_t lmp_bytes_at_u16(const unsigned char *p) {
    return (uint16_t)(p[0] | p[1] << 8);
}
static inline uint32_t lmp_bytes_at_u32(const unsigned char *p) {
    return lmp_bytes_at_u16(p) | (uint32_t)lmp_bytes_at_u16(p + 2) << 16;
}
static inline uint64_t lmp_bytes_at_u64(const unsigned char *p) {
    return lmp_bytes_at_u32(p) | (uint64_t)lmp_bytes_at_u32(p + 4) << 32;
}
static inline float lmp_bytes_at_f32(const unsigned char *p) {
    const uint32_t bits = lmp_bytes_at_u32(p);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}
static inline double lmp_bytes_at_f64(const unsigned char *p) {
    const uint64_t bits = lmp_bytes_at_u64(p);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Each reads at *from and moves it on. */
static inline uint16_t lmp_bytes_load_u16(const unsigned char **from) {
    *from += 2;
    return lmp_bytes_at_u16(*from - 2);
}
static inline uint32_t lmp_bytes_load_u32(const unsigned char **from) {
    *from += 4;
    return lmp_bytes_at_u32(*from - 4);
}
static inline float lmp_bytes_load_f32(const unsigned char **from) {
    *from += 4;
    return lmp_bytes_at_f32(*from - 4);
}

/* Many of them, as they lie where that is their order here. */
static inline void lmp_bytes_load_i16s(const unsigned char *from, size_t count, int16_t *values) {
    const uint16_t one = 1;
    if (*(const unsigned char *)&one == 1)
        memcpy(values, from, count * sizeof *values);
    else
        for (size_t i = 0; i < count; i++)
            values[i] = (int16_t)lmp_bytes_at_u16(from + 2 * i);
}

/* CRC-32C (Castagnoli), sixteen bytes a step. */
uint32_t lmp_bytes_checksum(const void *bytes, size_t size);

/* What every file format here has around its numbers: a header that begins with the magic and the
 * version, and the checksum of all before it at the end. */
typedef struct lmp_bytes_format {
    unsigned char magic[8];
    uint32_t version;
    size_t header; /* bytes */
} lmp_bytes_format;

enum { LMP_BYTES_BEGIN = 12, LMP_BYTES_CHECKSUM = 4 };

/* Writes the magic and the version; returns the address after them. */
unsigned char *lmp_bytes_begin(void *bytes, const lmp_bytes_format *format);
/* Writes the checksum of all from bytes to end there. */
void lmp_bytes_end(void *bytes, unsigned char *end);

/* Each returns LMP_OK or what is wrong: whether a file has room for its header and checksum and
 * begins as its format does, whether its checksum holds, and both. */
lmp_result lmp_bytes_check_begin(const void *bytes, size_t size, const lmp_bytes_format *format);
lmp_result lmp_bytes_check_end(const void *bytes, size_t size);
lmp_result lmp_bytes_check_frame(const void *bytes, size_t size, const lmp_bytes_format *format);

#endif

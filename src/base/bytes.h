/* SPDX-License-Identifier: MIT */
/* bytes.h - little-endian numbers in a file format, on any machine, and its checksum. */
#ifndef LAMPION_BASE_BYTES_H
#define LAMPION_BASE_BYTES_H

#include <lampion/base.h>

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Each function stores a number and returns the address after it. */
static inline unsigned char *lmpi_bytes_store_u16(unsigned char *to, uint16_t value) {
    to[0] = (unsigned char)value;
    to[1] = (unsigned char)(value >> 8);
    return to + 2;
}
static inline unsigned char *lmpi_bytes_store_u32(unsigned char *to, uint32_t value) {
    return lmpi_bytes_store_u16(lmpi_bytes_store_u16(to, (uint16_t)value), (uint16_t)(value >> 16));
}
static inline unsigned char *lmpi_bytes_store_f32(unsigned char *to, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return lmpi_bytes_store_u32(to, bits);
}
static inline unsigned char *lmpi_bytes_store_u64(unsigned char *to, uint64_t value) {
    return lmpi_bytes_store_u32(lmpi_bytes_store_u32(to, (uint32_t)value), (uint32_t)(value >> 32));
}
static inline unsigned char *lmpi_bytes_store_f64(unsigned char *to, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return lmpi_bytes_store_u64(to, bits);
}

/* Each function reads a number in place. */
static inline uint16_t lmpi_bytes_at_u16(const unsigned char *p) {
    return (uint16_t)(p[0] | p[1] << 8);
}
static inline uint32_t lmpi_bytes_at_u32(const unsigned char *p) {
    return lmpi_bytes_at_u16(p) | (uint32_t)lmpi_bytes_at_u16(p + 2) << 16;
}
static inline uint64_t lmpi_bytes_at_u64(const unsigned char *p) {
    return lmpi_bytes_at_u32(p) | (uint64_t)lmpi_bytes_at_u32(p + 4) << 32;
}
static inline float lmpi_bytes_at_f32(const unsigned char *p) {
    const uint32_t bits = lmpi_bytes_at_u32(p);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}
static inline double lmpi_bytes_at_f64(const unsigned char *p) {
    const uint64_t bits = lmpi_bytes_at_u64(p);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Each function reads a number at *from and moves *from past it. */
static inline uint16_t lmpi_bytes_load_u16(const unsigned char **from) {
    *from += 2;
    return lmpi_bytes_at_u16(*from - 2);
}
static inline uint32_t lmpi_bytes_load_u32(const unsigned char **from) {
    *from += 4;
    return lmpi_bytes_at_u32(*from - 4);
}
static inline float lmpi_bytes_load_f32(const unsigned char **from) {
    *from += 4;
    return lmpi_bytes_at_f32(*from - 4);
}

/* Each function reads many numbers, by one copy where the machine's byte order is the file's. */
static inline void lmpi_bytes_load_i16s(const unsigned char *from, size_t count, int16_t *values) {
    const uint16_t one = 1;
    if (*(const unsigned char *)&one == 1)
        memcpy(values, from, count * sizeof *values);
    else
        for (size_t i = 0; i < count; i++)
            values[i] = (int16_t)lmpi_bytes_at_u16(from + 2 * i);
}

/* Returns the CRC-32C (Castagnoli), computed sixteen bytes a step. */
uint32_t lmpi_bytes_checksum(const void *bytes, size_t size);

/* What every file format of the library has around its numbers: a header that begins with the magic
 * and the version, and at the end the checksum of all before it. */
typedef struct lmpi_bytes_format {
    const char *name; /* "table (.lmpt)" */
    unsigned char magic[8];
    uint32_t version;
    size_t header; /* in bytes */
} lmpi_bytes_format;

enum { LMPI_BYTES_BEGIN = 12, LMPI_BYTES_CHECKSUM = 4 };

/* Writes the magic and the version; returns the address after them. */
unsigned char *lmpi_bytes_begin(void *bytes, const lmpi_bytes_format *format);
/* Writes the checksum of all bytes from `bytes` to `end` at `end`. */
void lmpi_bytes_end(void *bytes, unsigned char *end);

/* Check what is around a file's numbers, and return LMP_OK or what is wrong, of which error (may be
 * NULL) tells: check_begin, whether the file has room for its header and checksum and begins as its
 * format does; check_end, whether its checksum holds; check_frame, both. */
lmp_result lmpi_bytes_check_begin(const void *bytes, size_t size, const lmpi_bytes_format *format,
                                  lmp_parse_error *error);
lmp_result lmpi_bytes_check_end(const void *bytes, size_t size, lmp_parse_error *error);
lmp_result lmpi_bytes_check_frame(const void *bytes, size_t size, const lmpi_bytes_format *format,
                                  lmp_parse_error *error);

#endif

/* SPDX-License-Identifier: MIT */
#include "src/base/bytes.h"
#include "src/base/parse_error.h"

/* table[k][b] is the checksum's table for byte b where it lies k bytes before the end of a step. */
enum { STEP = 16 };

static void fill(uint32_t table[STEP][256]) {
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t crc = i;
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0x82f63b78u : 0);
        table[0][i] = crc;
    }
    for (uint32_t i = 0; i < 256; i++)
        for (int k = 1; k < STEP; k++)
            table[k][i] = table[k - 1][i] >> 8 ^ table[0][table[k - 1][i] & 0xff];
}

/* Folds four bytes of a step, of which `after` more follow. */
static uint32_t fold(uint32_t table[STEP][256], uint32_t word, int after) {
    return table[after + 3][word & 0xff] ^ table[after + 2][word >> 8 & 0xff] ^
           table[after + 1][word >> 16 & 0xff] ^ table[after][word >> 24];
}

/* Returns the register after one step of 16 bytes. */
static uint32_t step(uint32_t table[STEP][256], uint32_t crc, const unsigned char *p) {
    return fold(table, lmpi_bytes_at_u32(p) ^ crc, 12) ^ fold(table, lmpi_bytes_at_u32(p + 4), 8) ^
           fold(table, lmpi_bytes_at_u32(p + 8), 4) ^ fold(table, lmpi_bytes_at_u32(p + 12), 0);
}

/* --- three runs at once: one waits for its tables while the others read theirs ---------------- */

/* Bytes of a run, a power of two. */
enum { RUN_LOG2 = 13, RUN = 1 << RUN_LOG2 };

/* A linear map over the bits of a register, what some zero bytes make of it: columns[i] is what bit
 * i becomes. */
typedef struct zeros {
    uint32_t columns[32];
} zeros;

static uint32_t zeros_after(const zeros *map, uint32_t crc) {
    uint32_t sum = 0;
    for (int i = 0; i < 32; i++)
        sum ^= crc >> i & 1 ? map->columns[i] : 0;
    return sum;
}

/* Makes the map of RUN zero bytes: that of one byte, squared RUN_LOG2 times. */
static zeros zeros_of_run(uint32_t table[STEP][256]) {
    zeros map;
    for (int i = 0; i < 32; i++) {
        const uint32_t bit = (uint32_t)1 << i;
        map.columns[i] = bit >> 8 ^ table[0][bit & 0xff];
    }
    for (int k = 0; k < RUN_LOG2; k++) {
        const zeros before = map;
        for (int i = 0; i < 32; i++)
            map.columns[i] = zeros_after(&before, before.columns[i]);
    }
    return map;
}

/* Returns the register after three runs. */
static uint32_t three_runs(uint32_t table[STEP][256], const zeros *map, uint32_t crc,
                           const unsigned char *p) {
    uint32_t second = 0, third = 0;
    for (int i = 0; i < RUN; i += STEP) {
        crc = step(table, crc, p + i);
        second = step(table, second, p + RUN + i);
        third = step(table, third, p + 2 * RUN + i);
    }
    return zeros_after(map, zeros_after(map, crc) ^ second) ^ third;
}

uint32_t lmpi_bytes_checksum(const void *bytes, size_t size) {
    uint32_t table[STEP][256];
    fill(table);
    const unsigned char *p = bytes;
    uint32_t crc = 0xffffffffu;
    if (size >= 3 * RUN) {
        const zeros map = zeros_of_run(table);
        for (; size >= 3 * RUN; size -= 3 * RUN, p += 3 * RUN)
            crc = three_runs(table, &map, crc, p);
    }
    for (; size >= STEP; size -= STEP, p += STEP)
        crc = step(table, crc, p);
    for (; size > 0; size--)
        crc = crc >> 8 ^ table[0][(crc ^ *p++) & 0xff];
    return ~crc;
}

/* --- what is around the numbers of a file ----------------------------------------------------- */

unsigned char *lmpi_bytes_begin(void *bytes, const lmpi_bytes_format *format) {
    memcpy(bytes, format->magic, sizeof format->magic);
    return lmpi_bytes_store_u32((unsigned char *)bytes + sizeof format->magic, format->version);
}

void lmpi_bytes_end(void *bytes, unsigned char *end) {
    lmpi_bytes_store_u32(end, lmpi_bytes_checksum(bytes, (size_t)(end - (unsigned char *)bytes)));
}

lmp_result lmpi_bytes_check_begin(const void *bytes, size_t size, const lmpi_bytes_format *format,
                                  lmp_parse_error *error) {
    const unsigned char *p = bytes;
    if (size < format->header + LMPI_BYTES_CHECKSUM ||
        memcmp(p, format->magic, sizeof format->magic) != 0)
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, 0, "not a Lampion %s", format->name);
    const uint32_t version = lmpi_bytes_at_u32(p + sizeof format->magic);
    if (version != format->version)
        return lmpi_parse_fail(error, LMP_ERROR_VERSION, sizeof format->magic,
                               "format version %zu, this library knows version %zu",
                               (size_t)version, (size_t)format->version);
    return LMP_OK;
}

lmp_result lmpi_bytes_check_end(const void *bytes, size_t size, lmp_parse_error *error) {
    const size_t end = size - LMPI_BYTES_CHECKSUM;
    if (lmpi_bytes_checksum(bytes, end) != lmpi_bytes_at_u32((const unsigned char *)bytes + end))
        return lmpi_parse_fail(error, LMP_ERROR_CHECKSUM, end,
                               "checksum mismatch: the file is damaged");
    return LMP_OK;
}

lmp_result lmpi_bytes_check_frame(const void *bytes, size_t size, const lmpi_bytes_format *format,
                                  lmp_parse_error *error) {
    const lmp_result begun = lmpi_bytes_check_begin(bytes, size, format, error);
    return begun == LMP_OK ? lmpi_bytes_check_end(bytes, size, error) : begun;
}

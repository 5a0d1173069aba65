/* SPDX-License-Identifier: MIT */
#include "src/base/bytes.h"

uint32_t lmp_bytes_checksum(const void *bytes, size_t size) {
    uint32_t table[8][256];
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t crc = i;
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0x82f63b78u : 0);
        table[0][i] = crc;
    }
    for (uint32_t i = 0; i < 256; i++)
        for (int k = 1; k < 8; k++)
            table[k][i] = table[k - 1][i] >> 8 ^ table[0][table[k - 1][i] & 0xff];

    const unsigned char *p = bytes;
    uint32_t crc = 0xffffffffu;
    for (; size >= 8; size -= 8) {
        const uint32_t low = lmp_bytes_load_u32(&p) ^ crc, high = lmp_bytes_load_u32(&p);
        crc = table[7][low & 0xff] ^ table[6][low >> 8 & 0xff] ^ table[5][low >> 16 & 0xff] ^
              table[4][low >> 24] ^ table[3][high & 0xff] ^ table[2][high >> 8 & 0xff] ^
              table[1][high >> 16 & 0xff] ^ table[0][high >> 24];
    }
    for (; size > 0; size--)
        crc = crc >> 8 ^ table[0][(crc ^ *p++) & 0xff];
    return ~crc;
}

lmp_result lmp_bytes_check_frame(const void *bytes, size_t size, const unsigned char magic[8],
                                 uint32_t version, size_t header) {
    const size_t checksum = 4;
    const unsigned char *p = bytes;
    if (size < header + checksum || memcmp(p, magic, 8) != 0)
        return LMP_ERROR_FORMAT;
    if (lmp_bytes_at_u32(p + 8) != version)
        return LMP_ERROR_VERSION;
    if (lmp_bytes_checksum(p, size - checksum) != lmp_bytes_at_u32(p + size - checksum))
        return LMP_ERROR_CHECKSUM;
    return LMP_OK;
}

/* SPDX-License-Identifier: MIT */
/* lanes_any.h - what no instruction does, in plain C for any number of lanes (lanes.h). */
#ifndef LAMPION_KERNELS_LANES_ANY_H
#define LAMPION_KERNELS_LANES_ANY_H

LMPI_INLINE void texel_rows(const int16_t *from, size_t row, const uint32_t weights[2],
                            texel_lanes sums[TEXEL_PARTS]) {
    int32_t totals[TEXEL_NUMBERS] = { 0 };
    for (int k = 0; k < 4; k++, from += row) {
        const int32_t weight = (int32_t)(weights[k / 2] >> 16 * (k % 2) & 0xffff);
        for (int i = 0; i < TEXEL_NUMBERS; i++)
            totals[i] += weight * from[i];
    }
    for (int i = 0; i < TEXEL_PARTS; i++) {
        vi part;
        memcpy(&part, totals + TEXEL_LANES * i, sizeof part);
        sums[i] = vf_from(part);
    }
}

#endif

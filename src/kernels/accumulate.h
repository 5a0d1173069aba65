/* SPDX-License-Identifier: MIT */
/* accumulate.h - many RGB lights into each of many points: lanes are points, lights are broadcast.
 *
 * The sums lie in memory by columns m. Columns go by tiles that fit LMP_TILE planes; up to 31 bands
 * (15 with gradients) one tile holds all. Lights go some at a time, so that a sum is loaded
 * and stored once for all of them; each is still added on its own, in order. */
#ifndef LAMPION_KERNELS_ACCUMULATE_H
#define LAMPION_KERNELS_ACCUMULATE_H

#include "src/kernels/basis.h"
#include "src/kernels/cap.h"

/* Planes of a tile, enough for the longest column with gradients; 192 KiB of 16 lanes. */
#define LMP_TILE (24 * LMP_BANDS_MAX)

/* Lights a pass. */
#define ACCUMULATE_LIGHTS (LMP_LANES == 16 ? 4 : 2)

static inline float lights_at(const float *array, size_t stride, size_t i) {
    float value;
    memcpy(&value, (const char *)array + i * stride, sizeof value);
    return value;
}

static inline lmp_rgb lights_radiance(const lmp_kernel_lights *lights, size_t i) {
    const lmp_vec3_array *radiance = &lights->radiance;
    const lmp_rgb rgb = { lights_at(radiance->x, radiance->stride, i),
                          lights_at(radiance->y, radiance->stride, i),
                          lights_at(radiance->z, radiance->stride, i) };
    return rgb;
}

LMP_INLINE cap_lanes lights_cap(const lmp_kernel_lights *lights, size_t i, const vf point[3],
                                int gradient) {
    const lmp_vec3_array *center = &lights->center;
    return cap_from(lights_at(center->x, center->stride, i) - point[0],
                    lights_at(center->y, center->stride, i) - point[1],
                    lights_at(center->z, center->stride, i) - point[2],
                    vf_set(lights_at(lights->radius.at, lights->radius.stride, i)), gradient);
}

/* Columns first … end-1 are summed: the sums of (l, m) at sums[6 * place], m > 0: red, green, blue
 * of +m, then of -m; places follow one another by m, then l. Monic recurrences leave the norm N_lm
 * to the end, and are for LMP_TABLE_MONIC_BANDS (tables.h). */
LMP_INLINE void accumulate_lights(int bands, int first, int end, int monic, int at_once,
                                  const lmp_kernel_lights *lights, size_t light, const vf point[3],
                                  vf *sums) {
    vf axis[ACCUMULATE_LIGHTS][3], radial[ACCUMULATE_LIGHTS][LMP_BANDS_MAX];
    vf c[ACCUMULATE_LIGHTS], s[ACCUMULATE_LIGHTS], q0[ACCUMULATE_LIGHTS], q1[ACCUMULATE_LIGHTS];
    lmp_rgb rgb[ACCUMULATE_LIGHTS];
    LMP_ROLLED for (int k = 0; k < at_once; k++) {
        cap_lanes cap = lights_cap(lights, light + (size_t)k, point, 0);
        cap_axis(&cap);
        cap_radial(bands, &cap, vf_set(LMP_KERNEL_PI), radial[k]);
        axis[k][0] = cap.x;
        axis[k][1] = cap.y;
        axis[k][2] = cap.z;
        rgb[k] = lights_radiance(lights, light + (size_t)k);
        c[k] = vf_set(1);
        s[k] = vf_set(0);
        for (int m = 1; m < first; m++)
            basis_turn(m, axis[k][0], axis[k][1], &c[k], &s[k]);
    }
    for (int m = first; m < end; m++) {
        vf color[ACCUMULATE_LIGHTS][6];
        LMP_UNROLL for (int k = 0; k < at_once; k++) {
            if (m > 0)
                basis_turn(m, axis[k][0], axis[k][1], &c[k], &s[k]);
            color[k][0] = rgb[k].r * c[k];
            color[k][1] = rgb[k].g * c[k];
            color[k][2] = rgb[k].b * c[k];
            color[k][3] = rgb[k].r * s[k];
            color[k][4] = rgb[k].g * s[k];
            color[k][5] = rgb[k].b * s[k];
            q0[k] = vf_set(0);
            q1[k] = vf_set(monic ? 1 : lmp_table_diagonal[m]);
        }
        const size_t base = lmp_table_index(m, m);
        LMP_ROLLED for (int l = m; l < bands; l++) {
            vf value[ACCUMULATE_LIGHTS];
            LMP_UNROLL for (int k = 0; k < at_once; k++) value[k] = q1[k] * radial[k][l];
            LMP_UNROLL for (int i = 0; i < 6; i++) {
                if (m == 0 && i == 3)
                    break;
                vf sum = sums[i];
                LMP_UNROLL for (int k = 0; k < at_once; k++) sum = sum + color[k][i] * value[k];
                sums[i] = sum;
            }
            sums += 6;
            const size_t next = base + (size_t)(l + 1 - m);
            if (l + 1 == bands)
                break;
            LMP_UNROLL for (int k = 0; k < at_once; k++) {
                const vf z = axis[k][2];
                const vf q2 = monic ? z * q1[k] - lmp_table_monic[next] * q0[k]
                                    : lmp_table_a[next] * z * q1[k] + lmp_table_b[next] * q0[k];
                q0[k] = q1[k];
                q1[k] = q2;
            }
        }
    }
}

/* What accumulate_put writes: of a (l, m) with `planes` sums of +m, then as many of -m, the sums
 * skip … skip+sets-1, which are the output's sets of bands^2 values. */
typedef struct accumulate_sets {
    int planes, skip, sets;
} accumulate_sets;

/* One set in the order of the sums: columns first … end-1 of bands low … high-1, value l*l+l±m at
 * to + (l*l+l±m - from) * stride. */
LMP_INLINE void accumulate_set(int bands, int first, int end, int low, int high, int monic,
                               int planes, const vf *sums, float *to, int from, size_t stride) {
    for (int m = first; m < end && m < high; m++) {
        const float *norms = lmp_table_norm + lmp_table_index(m, m);
        for (int l = m > low ? m : low; l < high; l++) {
            const vf *sum = sums + (l - m) * 2 * planes;
            const float norm = monic ? norms[l - m] : 1;
            float *middle = to + (size_t)(l * l + l - from) * stride;
            vf_store(middle + (size_t)m * stride, norm * sum[0]);
            if (m > 0)
                vf_store(middle - (size_t)m * stride, norm * sum[planes]);
        }
        sums += (bands - m) * 2 * planes;
    }
}

/* Bands low … high-1 of a set, which lie in planes from value low*low on, as rows. */
static inline void accumulate_rows(int first, int end, int low, int high, const float *planes,
                                   size_t place, const lmp_kernel_out *out, size_t element,
                                   size_t live) {
    if (first == 0 && high <= end) {
        layout_put(planes, place, (size_t)(high * high - low * low), out, element, live);
        return;
    }
    for (int l = low; l < high; l++) {
        const int middle = l * l + l - low * low, last = l < end ? l : end - 1;
        const size_t run = (size_t)(first == 0 ? 2 * last + 1 : last - first + 1);
        const int runs[] = { middle - last, middle + first };
        for (int i = 0; i < (first == 0 ? 1 : 2); i++)
            layout_put(planes + runs[i] * LMP_LANES, place + (size_t)runs[i], run, out, element,
                       live);
    }
}

/* Writes columns first … end-1. */
LMP_INLINE void accumulate_put(int bands, int first, int end, int monic, accumulate_sets of,
                               const vf *sums, const lmp_kernel_out *out, size_t element,
                               size_t live) {
    const int direct = LMP_LANES == 1 || (out->planar && live == LMP_LANES);
    const size_t stride = out->planar ? out->stride : 1;
    for (int p = 0; p < of.sets; p++) {
        const vf *set = sums + of.skip + p;
        const size_t place = (size_t)(p * bands * bands);
        if (direct) {
            float *to = out->at + element * (out->planar ? 1 : out->stride) + place * stride;
            accumulate_set(bands, first, end, first, bands, monic, of.planes, set, to, 0, stride);
            continue;
        }
        /* Some bands at a time. */
        float LMP_ALIGNED block[BASIS_WAITING * LMP_LANES];
        for (int low = first, high; low < bands; low = high) {
            const int from = low * low;
            high = low + 1;
            while (high < bands && (high + 1) * (high + 1) - from <= BASIS_WAITING)
                high++;
            accumulate_set(bands, first, end, low, high, monic, of.planes, set, block, from,
                           LMP_LANES);
            accumulate_rows(first, end, low, high, block, place + (size_t)from, out, element, live);
        }
    }
}

/* The end of the tile that begins with column `first`, its sums set to 0; a (l, m) takes `width`.
 */
static inline int accumulate_tile(int bands, int first, int width, vf *sums) {
    int end = first, planes = 0;
    while (end < bands && planes + (bands - end) * width <= LMP_TILE)
        planes += (bands - end++) * width;
    memset(sums, 0, (size_t)planes * sizeof *sums);
    return end;
}

LMP_INLINE void accumulate_points(int bands, int monic, const lmp_kernel_lights *lights,
                                  const lmp_kernel_vec3 *points, size_t count,
                                  const lmp_kernel_out *out) {
    vf sums[LMP_TILE];
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const vf point[3] = { vf_load(points->x + e), vf_load(points->y + e),
                              vf_load(points->z + e) };
        for (int first = 0, end; first < bands; first = end) {
            end = accumulate_tile(bands, first, 6, sums);
            size_t light = 0;
            for (; light + ACCUMULATE_LIGHTS <= lights->count; light += ACCUMULATE_LIGHTS)
                accumulate_lights(bands, first, end, monic, ACCUMULATE_LIGHTS, lights, light, point,
                                  sums);
            for (; light < lights->count; light++)
                accumulate_lights(bands, first, end, monic, 1, lights, light, point, sums);
            accumulate_put(bands, first, end, monic, (accumulate_sets) { 3, 0, 3 }, sums, out, e,
                           layout_live(count, e));
        }
    }
}

static void kernel_accumulate(int bands, const lmp_kernel_lights *lights,
                              const lmp_kernel_vec3 *points, size_t count,
                              const lmp_kernel_out *out) {
    if (bands <= LMP_TABLE_MONIC_BANDS)
        accumulate_points(bands, 1, lights, points, count, out);
    else
        accumulate_points(bands, 0, lights, points, count, out);
}

#endif

/* SPDX-License-Identifier: MIT */
/* accumulate.h - many RGB lights into each of many points: lanes are points, lights are broadcast.
 *
 * The sums lie in memory by columns m, a tile of them at a time: no function of the library may
 * need more than 64 KB of stack, and a tile that stays in the first cache costs least. Lights go
 * some at a time, so that a sum is loaded and stored once for all of them; each is still added on
 * its own, in order. */
#ifndef LAMPION_KERNELS_ACCUMULATE_H
#define LAMPION_KERNELS_ACCUMULATE_H

#include "src/kernels/basis.h"
#include "src/kernels/cap.h"

/* 45 KiB of sums, but no more than help: of 15 bands and more. */
#define ACCUMULATE_SUMS (LMP_LANES > 4 ? 11520 / LMP_LANES : 2880)

/* Bands of lights that wait, 8 KiB; then values on their way out. */
#define ACCUMULATE_WAITING (LMP_LANES > 4 ? 2048 / LMP_LANES : 512)

/* Lights a pass, where their bands fit. */
#define ACCUMULATE_LIGHTS (LMP_LANES == 16 ? 4 : 2)

/* Columns first … end-1 of bands low … high-1: whole columns, which begin at their own band m, a
 * part of one, or whole bands. */
typedef struct accumulate_tile {
    int first, end, low, high;
} accumulate_tile;

/* The tile after this one, of at most `most` pairs (l, m); its first is `bands` when all are done.
 */
static inline accumulate_tile accumulate_next(int bands, accumulate_tile tile, int most) {
    if (tile.high < bands) {
        tile.low = tile.high;
        tile.high = tile.low + most < bands ? tile.low + most : bands;
        return tile;
    }
    const int first = tile.end;
    int end = first + 1, high = bands;
    if (bands - first > most)
        high = first + most;
    for (int left = most - (bands - first); end < bands && left >= bands - end; end++)
        left -= bands - end;
    return (accumulate_tile) { first, end, first, high };
}

static inline accumulate_tile accumulate_first(int bands, int most) {
    return accumulate_next(bands, (accumulate_tile) { .high = bands }, most);
}

/* Pairs (l, m) of a tile. */
static inline size_t accumulate_pairs(accumulate_tile tile) {
    size_t pairs = 0;
    for (int m = tile.first; m < tile.end; m++)
        pairs += (size_t)(tile.high - (m > tile.low ? m : tile.low));
    return pairs;
}

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

/* A light's radiance at +m, then at -m: times the cosine and the sine of m times its azimuth. */
LMP_INLINE void accumulate_colors(lmp_rgb rgb, vf c, vf s, vf color[6]) {
    color[0] = rgb.r * c;
    color[1] = rgb.g * c;
    color[2] = rgb.b * c;
    color[3] = rgb.r * s;
    color[4] = rgb.g * s;
    color[5] = rgb.b * s;
}

/* Adds `at_once` lights to the sums of a tile: of a pair (l, m) six, red, green, blue of +m, then
 * of -m; pairs follow one another by m, then l. Monic recurrences leave the norm N_lm to the end,
 * and are for LMP_TABLE_MONIC_BANDS (tables.h). */
LMP_INLINE void accumulate_lights(accumulate_tile tile, int monic, int at_once,
                                  const lmp_kernel_lights *lights, size_t light, const vf point[3],
                                  vf *sums) {
    vf waiting[ACCUMULATE_WAITING], axis[ACCUMULATE_LIGHTS][3];
    const vf *radial[ACCUMULATE_LIGHTS];
    vf c[ACCUMULATE_LIGHTS], s[ACCUMULATE_LIGHTS], q0[ACCUMULATE_LIGHTS], q1[ACCUMULATE_LIGHTS];
    lmp_rgb rgb[ACCUMULATE_LIGHTS];
    LMP_ROLLED for (int k = 0; k < at_once; k++) {
        cap_lanes cap = lights_cap(lights, light + (size_t)k, point, 0);
        cap_axis(&cap);
        cap_radial(tile.high, &cap, vf_set(LMP_KERNEL_PI), waiting + k * tile.high);
        radial[k] = waiting + k * tile.high;
        axis[k][0] = cap.x;
        axis[k][1] = cap.y;
        axis[k][2] = cap.z;
        rgb[k] = lights_radiance(lights, light + (size_t)k);
        c[k] = vf_set(1);
        s[k] = vf_set(0);
        for (int m = 1; m < tile.first; m++)
            basis_rotate(m, axis[k][0], axis[k][1], &c[k], &s[k]);
    }
    for (int m = tile.first; m < tile.end; m++) {
        vf color[ACCUMULATE_LIGHTS][6];
        LMP_UNROLL for (int k = 0; k < at_once; k++) {
            if (m > 0)
                basis_rotate(m, axis[k][0], axis[k][1], &c[k], &s[k]);
            accumulate_colors(rgb[k], c[k], s[k], color[k]);
            q0[k] = vf_set(0);
            q1[k] = vf_set(monic ? 1 : lmp_table_diagonal[m]);
        }
        const size_t base = lmp_table_index(m, m);
        LMP_ROLLED for (int l = m; l < tile.high; l++) {
            if (l >= tile.low) {
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
            }
            const size_t next = base + (size_t)(l + 1 - m);
            if (l + 1 == tile.high)
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

/* Band l of a set: value m at plus + m * stride, value -m at minus - m * stride. */
LMP_INLINE void accumulate_band(accumulate_tile tile, int l, int monic, int planes, const vf *sums,
                                float *plus, float *minus, size_t stride) {
    const vf *sum = sums + (l - tile.low) * 2 * planes;
    for (int m = tile.first; m < tile.end && m <= l; m++) {
        const float norm = monic ? lmp_table_norm[lmp_table_index(l, m)] : 1;
        vf_store(plus + (size_t)m * stride, norm * sum[0]);
        if (m > 0)
            vf_store(minus - (size_t)m * stride, norm * sum[planes]);
        sum += (tile.high - (m + 1 > tile.low ? m + 1 : tile.low)) * 2 * planes;
    }
}

/* Band l of a set as rows, from `place` on: its values from -last to -first and from first to last,
 * or all between. */
LMP_INLINE void accumulate_runs(accumulate_tile tile, int l, int monic, int planes, const vf *sums,
                                float *block, size_t place, const lmp_kernel_out *out,
                                size_t element, size_t live) {
    const int last = l < tile.end ? l : tile.end - 1, middle = l * l + l;
    const int wide = tile.first == 0 ? 2 * last + 1 : last - tile.first + 1;
    float *minus = block + last * LMP_LANES;
    float *plus = tile.first == 0 ? minus : block + (wide - tile.first) * LMP_LANES;
    accumulate_band(tile, l, monic, planes, sums, plus, minus, LMP_LANES);
    layout_put(block, place + (size_t)(middle - last), (size_t)wide, out, element, live);
    if (tile.first > 0)
        layout_put(block + wide * LMP_LANES, place + (size_t)(middle + tile.first), (size_t)wide,
                   out, element, live);
}

/* Bands low … high-1 of a set, which are whole, as rows. */
LMP_INLINE void accumulate_whole(accumulate_tile tile, int low, int high, int monic, int planes,
                                 const vf *sums, float *block, size_t place,
                                 const lmp_kernel_out *out, size_t element, size_t live) {
    for (int l = low; l < high; l++) {
        float *middle = block + (l * l + l - low * low) * LMP_LANES;
        accumulate_band(tile, l, monic, planes, sums, middle, middle, LMP_LANES);
    }
    layout_put(block, place + (size_t)(low * low), (size_t)(high * high - low * low), out, element,
               live);
}

/* Writes a tile. */
LMP_INLINE void accumulate_put(int bands, accumulate_tile tile, int monic, accumulate_sets of,
                               const vf *sums, const lmp_kernel_out *out, size_t element,
                               size_t live) {
    const int direct = LMP_LANES == 1 || (out->planar && live == LMP_LANES);
    const size_t stride = out->planar ? out->stride : 1;
    float *to = out->at + element * (out->planar ? 1 : out->stride);
    float LMP_ALIGNED block[ACCUMULATE_WAITING * LMP_LANES];
    for (int p = 0; p < of.sets; p++) {
        const vf *set = sums + of.skip + p;
        const size_t place = (size_t)(p * bands * bands);
        int low = tile.low, high;
        for (; low < tile.high; low = high) {
            high = low + 1;
            float *middle = to + (place + (size_t)(low * low + low)) * stride;
            if (direct) {
                accumulate_band(tile, low, monic, of.planes, set, middle, middle, stride);
            } else if (tile.first > 0 || low >= tile.end) {
                accumulate_runs(tile, low, monic, of.planes, set, block, place, out, element, live);
            } else {
                while (high < tile.end && high < tile.high &&
                       (high + 1) * (high + 1) - low * low <= ACCUMULATE_WAITING)
                    high++;
                accumulate_whole(tile, low, high, monic, of.planes, set, block, place, out, element,
                                 live);
            }
        }
    }
}

/* Not inlined, like all that has arrays of its own: what waits in one gives its stack to the next.
 */
static LMP_NOINLINE void accumulate_tile_put(int bands, accumulate_tile tile, int monic,
                                             const vf *sums, const lmp_kernel_out *out,
                                             size_t element, size_t live) {
    if (monic)
        accumulate_put(bands, tile, 1, (accumulate_sets) { 3, 0, 3 }, sums, out, element, live);
    else
        accumulate_put(bands, tile, 0, (accumulate_sets) { 3, 0, 3 }, sums, out, element, live);
}

LMP_INLINE void accumulate_all_lights(int bands, accumulate_tile tile, int monic,
                                      const lmp_kernel_lights *lights, const vf point[3],
                                      vf *sums) {
    size_t light = 0;
    if (bands <= ACCUMULATE_WAITING / ACCUMULATE_LIGHTS)
        for (; light + ACCUMULATE_LIGHTS <= lights->count; light += ACCUMULATE_LIGHTS)
            accumulate_lights(tile, monic, ACCUMULATE_LIGHTS, lights, light, point, sums);
    else if (bands <= ACCUMULATE_WAITING / 2)
        for (; light + 2 <= lights->count; light += 2)
            accumulate_lights(tile, monic, 2, lights, light, point, sums);
    for (; light < lights->count; light++)
        accumulate_lights(tile, monic, 1, lights, light, point, sums);
}

static LMP_NOINLINE void accumulate_monic(int bands, accumulate_tile tile,
                                          const lmp_kernel_lights *lights, const vf point[3],
                                          vf *sums) {
    accumulate_all_lights(bands, tile, 1, lights, point, sums);
}

static LMP_NOINLINE void accumulate_long(int bands, accumulate_tile tile,
                                         const lmp_kernel_lights *lights, const vf point[3],
                                         vf *sums) {
    accumulate_all_lights(bands, tile, 0, lights, point, sums);
}

static void kernel_accumulate(int bands, const lmp_kernel_lights *lights,
                              const lmp_kernel_vec3 *points, size_t count,
                              const lmp_kernel_out *out) {
    enum { MOST = ACCUMULATE_SUMS / 6 };
    const int monic = bands <= LMP_TABLE_MONIC_BANDS;
    vf sums[ACCUMULATE_SUMS];
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const vf point[3] = { vf_load(points->x + e), vf_load(points->y + e),
                              vf_load(points->z + e) };
        for (accumulate_tile tile = accumulate_first(bands, MOST); tile.first < bands;
             tile = accumulate_next(bands, tile, MOST)) {
            memset(sums, 0, 6 * accumulate_pairs(tile) * sizeof *sums);
            if (monic)
                accumulate_monic(bands, tile, lights, point, sums);
            else
                accumulate_long(bands, tile, lights, point, sums);
            accumulate_tile_put(bands, tile, monic, sums, out, e, layout_live(count, e));
        }
    }
}

#endif

/* SPDX-License-Identifier: MIT */
/* accumulate_tile_tmpl.h - tiles of the sums over lights for pairs (l, m), stored column by column
 * (one column per m), and how a tile is written to the output. */
#ifndef LAMPION_KERNELS_ACCUMULATE_TILE_TMPL_H
#define LAMPION_KERNELS_ACCUMULATE_TILE_TMPL_H

#include "src/kernels/basis_tmpl.h"

/* The minimum number of vector registers (8 KiB; 2 KiB in the scalar build) set aside for the bands
 * of a pass; they also buffer the values that are being written. */
#define ACCUMULATE_WAITING (LMPI_LANES > 4 ? 2048 / LMPI_LANES : 512)

/* A tile: columns first … end-1 of bands low … high-1. It consists either of whole columns, each
 * starting at its own band m, or of part of a single column. */
typedef struct accumulate_tile {
    int first, end, low, high;
} accumulate_tile;

/* Returns the next tile, of at most `most` pairs (l, m); its first column is `bands` once all tiles
 * are done. A column that does not fit is split into equal parts, because each part runs the
 * recurrences from their start. */
static inline accumulate_tile accumulate_next(int bands, accumulate_tile tile, int most) {
    const int begun = tile.high < bands, first = begun ? tile.first : tile.end;
    const int column = bands - first;
    if (column > most) {
        const int parts = (column + most - 1) / most, low = begun ? tile.high : first;
        const int high = low + (column + parts - 1) / parts;
        return (accumulate_tile) { first, first + 1, low, high < bands ? high : bands };
    }
    int end = first;
    for (int left = most; end < bands && left >= bands - end; end++)
        left -= bands - end;
    return (accumulate_tile) { first, end, first, bands };
}

static inline accumulate_tile accumulate_first(int bands, int most) {
    return accumulate_next(bands, (accumulate_tile) { .high = bands }, most);
}

/* Returns the number of pairs (l, m) in a tile. */
static inline size_t accumulate_pairs(accumulate_tile tile) {
    size_t pairs = 0;
    for (int m = tile.first; m < tile.end; m++)
        pairs += (size_t)(tile.high - (m > tile.low ? m : tile.low));
    return pairs;
}

/* The sums that accumulate_put writes, or adds, to the output. A pair (l, m) has `planes` sums for
 * +m, then as many for -m; of these, sums skip … skip+sets-1 are used, and each gives a set of
 * bands^2 values in the output. */
typedef struct accumulate_sets {
    int planes, skip, sets, adds;
} accumulate_sets;

/* Writes the values of a block to the output, or adds them to it. */
static inline void accumulate_out(int adds, const float *block, size_t first, size_t values,
                                  const lmpi_kernel_out *out, size_t element, size_t live) {
    if (adds)
        layout_add(block, first, values, out, element, live);
    else
        layout_put(block, first, values, out, element, live);
}

/* Writes band l of a set: value m goes to plus + m * stride, value -m to minus - m * stride. */
LMPI_INLINE void accumulate_band(accumulate_tile tile, int l, int monic, int planes, const vf *sums,
                                 float *plus, float *minus, size_t stride) {
    const vf *sum = sums + (l - tile.low) * 2 * planes;
    for (int m = tile.first; m < tile.end && m <= l; m++) {
        const float norm = monic ? lmpi_table_norm[lmpi_table_index(l, m)] : 1;
        vf_store(plus + (size_t)m * stride, norm * sum[0]);
        if (m > 0)
            vf_store(minus - (size_t)m * stride, norm * sum[planes]);
        sum += (tile.high - (m + 1 > tile.low ? m + 1 : tile.low)) * 2 * planes;
    }
}

/* Writes band l of a set, which starts at `index`, as rows: the values from -last to -first and
 * those from first to last, or, if first is 0, all from -last to last. */
LMPI_INLINE void accumulate_runs(accumulate_tile tile, int l, int monic, accumulate_sets of,
                                 const vf *sums, float *block, size_t index,
                                 const lmpi_kernel_out *out, size_t element, size_t live) {
    const int last = l < tile.end ? l : tile.end - 1, middle = l * l + l;
    const int wide = tile.first == 0 ? 2 * last + 1 : last - tile.first + 1;
    float *minus = block + last * LMPI_LANES;
    float *plus = tile.first == 0 ? minus : block + (wide - tile.first) * LMPI_LANES;
    accumulate_band(tile, l, monic, of.planes, sums, plus, minus, LMPI_LANES);
    accumulate_out(of.adds, block, index + (size_t)(middle - last), (size_t)wide, out, element,
                   live);
    if (tile.first > 0)
        accumulate_out(of.adds, block + wide * LMPI_LANES, index + (size_t)(middle + tile.first),
                       (size_t)wide, out, element, live);
}

/* Writes bands low … high-1 of a set, which must be complete, as rows. */
LMPI_INLINE void accumulate_whole(accumulate_tile tile, int low, int high, int monic,
                                  accumulate_sets of, const vf *sums, float *block, size_t index,
                                  const lmpi_kernel_out *out, size_t element, size_t live) {
    for (int l = low; l < high; l++) {
        float *middle = block + (l * l + l - low * low) * LMPI_LANES;
        accumulate_band(tile, l, monic, of.planes, sums, middle, middle, LMPI_LANES);
    }
    accumulate_out(of.adds, block, index + (size_t)(low * low), (size_t)(high * high - low * low),
                   out, element, live);
}

/* Writes a tile of whole columns of a set in the order of its sums: value l*l+l±m goes to `to` +
 * (l*l+l±m) * stride. */
LMPI_INLINE void accumulate_columns(int bands, accumulate_tile tile, int monic, int planes,
                                    const vf *sums, float *to, size_t stride) {
    for (int m = tile.first; m < tile.end; m++) {
        const float *norm = lmpi_table_norm + lmpi_table_index(m, m);
        float *plus = to + (size_t)(m * m + 2 * m) * stride, *minus = to + (size_t)(m * m) * stride;
        size_t step = (size_t)(2 * m + 2) * stride;
        for (int l = m; l < bands; l++, norm++, sums += 2 * planes) {
            vf_store(plus, (monic ? *norm : 1) * sums[0]);
            if (m > 0)
                vf_store(minus, (monic ? *norm : 1) * sums[planes]);
            plus += step;
            minus += step;
            step += 2 * stride;
        }
    }
}

/* Writes a tile; `waiting` is scratch space of ACCUMULATE_WAITING registers. */
LMPI_INLINE void accumulate_put(int bands, accumulate_tile tile, int monic, accumulate_sets of,
                                const vf *sums, vf *waiting, const lmpi_kernel_out *out,
                                size_t element, size_t live) {
    const int direct = !of.adds && (LMPI_LANES == 1 || (out->planar && live == LMPI_LANES));
    const int columns = tile.low == tile.first && tile.high == bands;
    const int all = tile.first == 0 && tile.end == bands && bands * bands <= ACCUMULATE_WAITING;
    const size_t stride = out->planar ? out->stride : 1;
    float *to = out->at + element * (out->planar ? 1 : out->stride);
    float *block = (float *)(void *)waiting;
    for (int p = 0; p < of.sets; p++) {
        const vf *set = sums + of.skip + p;
        const size_t index = (size_t)(p * bands * bands);
        int low = tile.low, high;
        if (direct && columns) {
            accumulate_columns(bands, tile, monic, of.planes, set, to + index * stride, stride);
            continue;
        }
        if (columns && all) {
            accumulate_columns(bands, tile, monic, of.planes, set, block, LMPI_LANES);
            accumulate_out(of.adds, block, index, (size_t)(bands * bands), out, element, live);
            continue;
        }
        for (; low < tile.high; low = high) {
            high = low + 1;
            float *middle = to + (index + (size_t)(low * low + low)) * stride;
            if (direct) {
                accumulate_band(tile, low, monic, of.planes, set, middle, middle, stride);
            } else if (tile.first > 0 || low >= tile.end) {
                accumulate_runs(tile, low, monic, of, set, block, index, out, element, live);
            } else {
                while (high < tile.end && high < tile.high &&
                       (high + 1) * (high + 1) - low * low <= ACCUMULATE_WAITING)
                    high++;
                accumulate_whole(tile, low, high, monic, of, set, block, index, out, element, live);
            }
        }
    }
}

#endif

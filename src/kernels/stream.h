/* SPDX-License-Identifier: MIT */
/* stream.h - results that no cache holds, stored past all of them: an ordinary store fetches its
 * line from memory first. A tile of elements is computed as planes, which stay in the first cache,
 * and goes out by whole lines. Rows go a block after they were made: a load of what is still on its
 * way to the cache would wait for the stores to memory before it. */
#ifndef LAMPION_KERNELS_STREAM_H
#define LAMPION_KERNELS_STREAM_H

#include "src/kernels/layout.h"

/* Where there are no such stores, the kernels that stream are the others; and AVX2's, which wait
 * for memory, too, with the same bits, take less than AVX-512's would. */
#if (LMP_LANES == 4 || LMP_LANES == 8) && defined(__SSE2__)
#define STREAM 1

/* Elements of a tile. */
#define STREAM_TILE 32

/* Floats of a block of rows with what was left of a line, rounded up to pages: a store across the
 * border of two pages waits for all before it, and rows begin anywhere. */
#define STREAM_ROWS 1024

_Static_assert(STREAM_ROWS >= LMP_KERNEL_LINE + LMP_LANES * LMP_KERNEL_STREAM_VALUES_MAX,
               "rows fit");

/* Rows that wait lie at rows[half]: `waiting` floats without gaps, which belong at `to`. */
typedef struct stream {
    const lmp_kernel_out *out;
    size_t values, waiting;
    float *to;
    int half;
    float LMP_ALIGNED planes[LMP_KERNEL_STREAM_VALUES_MAX * STREAM_TILE];
    float __attribute__((aligned(4096))) rows[2][STREAM_ROWS];
} stream;

LMP_INLINE void stream_begin(stream *s, const lmp_kernel_out *out, size_t values) {
    s->out = out;
    s->values = values;
    s->waiting = 0;
    s->to = out->at;
    s->half = 0;
}

/* Floats from the beginning of the line to this one. */
LMP_INLINE size_t stream_into_line(const float *at) {
    return (uintptr_t)at / sizeof *at % LMP_KERNEL_LINE;
}

/* Lines that are not written whole, by ordinary stores. */
LMP_INLINE void stream_run(float *to, const float *from, size_t count) {
    const size_t head = (LMP_KERNEL_LINE - stream_into_line(to)) % LMP_KERNEL_LINE;
    size_t i = 0;
    for (; i < head && i < count; i++)
        to[i] = from[i];
    for (; i + LMP_KERNEL_LINE <= count; i += LMP_KERNEL_LINE)
        LMP_UNROLL for (size_t k = 0; k < LMP_KERNEL_LINE; k += LMP_LANES)
            vf_stream(to + i + k, vf_load(from + i + k));
    for (; i < count; i++)
        to[i] = from[i];
}

/* Rows that follow one another: the line that the next ones begin in waits with them. */
LMP_INLINE void stream_tight(stream *s, const float *planes, size_t live) {
    const float *rows = s->rows[s->half];
    const size_t begun = stream_into_line(s->to + s->waiting);
    const size_t left = begun < s->waiting ? begun : s->waiting, whole = s->waiting - left;
    float *next = s->rows[s->half = !s->half];
    for (size_t i = 0; i < left; i++)
        next[i] = rows[whole + i];
    layout_rows_of(planes, STREAM_TILE, s->values, next + left, s->values, live);
    stream_run(s->to, rows, whole);
    s->to += whole;
    s->waiting = left + live * s->values;
}

/* Rows with something between them. */
LMP_INLINE void stream_apart(stream *s, const float *planes, size_t live) {
    const float *rows = s->rows[s->half];
    float *next = s->rows[s->half = !s->half];
    layout_rows_of(planes, STREAM_TILE, s->values, next, s->values, live);
    for (size_t i = 0; i < s->waiting; i += s->values, s->to += s->out->stride)
        stream_run(s->to, rows + i, s->values);
    s->waiting = live * s->values;
}

/* Sends a tile, but for rows of its last block. */
static LMP_NOINLINE void stream_put(stream *s, size_t element, size_t count) {
    if (s->out->planar) {
        float *to = s->out->at + element;
        for (size_t v = 0; v < s->values; v++)
            stream_run(to + v * s->out->stride, s->planes + v * STREAM_TILE, count);
        return;
    }
    for (size_t e = 0; e < count; e += LMP_LANES)
        if (s->out->stride == s->values)
            stream_tight(s, s->planes + e, layout_live(count, e));
        else
            stream_apart(s, s->planes + e, layout_live(count, e));
}

/* And those. */
LMP_INLINE void stream_end(stream *s) {
    const float *rows = s->rows[s->half];
    const size_t run = s->out->stride == s->values ? s->waiting : s->values;
    for (size_t i = 0; i < s->waiting; i += run, s->to += s->out->stride)
        stream_run(s->to, rows + i, run);
}

/* Computes elements of some inputs, `count` from `element` on. */
typedef void stream_compute(int bands, const void *inputs, size_t element, size_t count,
                            const lmp_kernel_out *out);

static void stream_all(stream_compute *compute, int bands, const void *inputs, size_t count,
                       const lmp_kernel_out *out) {
    stream s;
    stream_begin(&s, out, (size_t)(bands * bands));
    const lmp_kernel_out tile = { s.planes, STREAM_TILE, 1 };
    for (size_t e = 0; e < count; e += STREAM_TILE) {
        const size_t n = count - e < STREAM_TILE ? count - e : STREAM_TILE;
        compute(bands, inputs, e, n, &tile);
        stream_put(&s, e, n);
    }
    stream_end(&s);
}

#else
#define STREAM 0
#endif

#endif

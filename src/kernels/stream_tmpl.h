/* SPDX-License-Identifier: MIT */
/* stream_tmpl.h - stores results that no cache holds past all caches, because an ordinary store
 * first fetches its line from memory. A tile of elements is computed as planes, which stay in the
 * first-level cache, and is written by whole lines. Rows are written one block after they were
 * computed: a load of values still on their way to the cache would wait for the stores to memory
 * before it. Without such stores, ordinary kernels take the place of those that stream
 * (build_tmpl.h). */
#ifndef LAMPION_KERNELS_STREAM_TMPL_H
#define LAMPION_KERNELS_STREAM_TMPL_H

#include "src/kernels/layout_tmpl.h"
#include "src/kernels/project_tmpl.h"

/* Elements of a tile. */
#define STREAM_TILE 32

/* Floats of a block of rows with the rest of a cache line, rounded up to pages: a store across the
 * border of two pages waits for all before it, and rows begin anywhere. */
#define STREAM_ROWS 1024

_Static_assert(STREAM_ROWS >= LMPI_KERNEL_LINE + LMPI_LANES * LMPI_KERNEL_STREAM_VALUES_MAX,
               "rows fit");

/* A result being streamed. Rows that wait are at rows[current]: `waiting` floats without gaps,
 * whose destination is `to`. */
typedef struct stream {
    const lmpi_kernel_out *out;
    size_t values, waiting;
    float *to;
    int current;
    float LMPI_ALIGNED planes[LMPI_KERNEL_STREAM_VALUES_MAX * STREAM_TILE];
    float __attribute__((aligned(4096))) rows[2][STREAM_ROWS];
} stream;

LMPI_INLINE void stream_begin(stream *s, const lmpi_kernel_out *out, size_t values) {
    s->out = out;
    s->values = values;
    s->waiting = 0;
    s->to = out->at;
    s->current = 0;
}

/* Returns the floats from the beginning of a cache line to this one. */
LMPI_INLINE size_t stream_into_line(const float *at) {
    return (uintptr_t)at / sizeof *at % LMPI_KERNEL_LINE;
}

/* Writes a run of floats; lines that are not written whole take ordinary stores. */
LMPI_INLINE void stream_run(float *to, const float *from, size_t count) {
    const size_t head = (LMPI_KERNEL_LINE - stream_into_line(to)) % LMPI_KERNEL_LINE;
    size_t i = 0;
    for (; i < head && i < count; i++)
        to[i] = from[i];
    for (; i + LMPI_KERNEL_LINE <= count; i += LMPI_KERNEL_LINE)
        LMPI_UNROLL for (size_t k = 0; k < LMPI_KERNEL_LINE; k += LMPI_LANES)
            vf_stream(to + i + k, vf_load(from + i + k));
    for (; i < count; i++)
        to[i] = from[i];
}

/* Writes rows that follow one another; the line in which the next rows begin waits with them. */
LMPI_INLINE void stream_tight(stream *s, const float *planes, size_t live) {
    const float *rows = s->rows[s->current];
    const size_t begun = stream_into_line(s->to + s->waiting);
    const size_t left = begun < s->waiting ? begun : s->waiting, whole = s->waiting - left;
    float *next = s->rows[s->current = !s->current];
    for (size_t i = 0; i < left; i++)
        next[i] = rows[whole + i];
    layout_rows_of(planes, STREAM_TILE, s->values, next + left, s->values, live);
    stream_run(s->to, rows, whole);
    s->to += whole;
    s->waiting = left + live * s->values;
}

/* Writes rows with gaps between them. */
LMPI_INLINE void stream_apart(stream *s, const float *planes, size_t live) {
    const float *rows = s->rows[s->current];
    float *next = s->rows[s->current = !s->current];
    layout_rows_of(planes, STREAM_TILE, s->values, next, s->values, live);
    for (size_t i = 0; i < s->waiting; i += s->values, s->to += s->out->stride)
        stream_run(s->to, rows + i, s->values);
    s->waiting = live * s->values;
}

/* Writes a tile, except rows of its last block, which wait. */
static LMPI_NOINLINE void stream_put(stream *s, size_t element, size_t count) {
    if (s->out->planar) {
        float *to = s->out->at + element;
        for (size_t v = 0; v < s->values; v++)
            stream_run(to + v * s->out->stride, s->planes + v * STREAM_TILE, count);
        return;
    }
    for (size_t e = 0; e < count; e += LMPI_LANES)
        if (s->out->stride == s->values)
            stream_tight(s, s->planes + e, layout_live(count, e));
        else
            stream_apart(s, s->planes + e, layout_live(count, e));
}

/* Writes the rows that still wait. */
LMPI_INLINE void stream_end(stream *s) {
    const float *rows = s->rows[s->current];
    const size_t run = s->out->stride == s->values ? s->waiting : s->values;
    for (size_t i = 0; i < s->waiting; i += run, s->to += s->out->stride)
        stream_run(s->to, rows + i, run);
}

/* Computes `count` elements of some inputs from `element` on. */
typedef void stream_compute(int bands, const void *inputs, size_t element, size_t count,
                            const lmpi_kernel_out *out);

static void stream_all(stream_compute *compute, int bands, const void *inputs, size_t count,
                       const lmpi_kernel_out *out) {
    stream s;
    stream_begin(&s, out, (size_t)(bands * bands));
    const lmpi_kernel_out tile = { s.planes, STREAM_TILE, 1 };
    for (size_t e = 0; e < count; e += STREAM_TILE) {
        const size_t n = count - e < STREAM_TILE ? count - e : STREAM_TILE;
        compute(bands, inputs, e, n, &tile);
        stream_put(&s, e, n);
    }
    stream_end(&s);
}

/* --- what is streamed ------------------------------------------------------------------------- */

static void eval_tile(int bands, const void *directions, size_t element, size_t count,
                      const lmpi_kernel_out *out) {
    const lmpi_kernel_vec3 at = project_from(directions, element);
    eval_straight(bands, &at, count, out);
}

static void kernel_eval_streamed(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                                 const lmpi_kernel_out *out) {
    stream_all(eval_tile, bands, directions, count, out);
}

static void project_tile(int bands, const void *inputs, size_t element, size_t count,
                         const lmpi_kernel_out *out) {
    const lmpi_kernel_pairs *pairs = inputs;
    const lmpi_kernel_pairs at = { project_from(&pairs->center, element),
                                   project_from(&pairs->point, element), pairs->radius + element };
    project_straight(bands, &at, count, out);
}

static void kernel_project_streamed(int bands, const lmpi_kernel_pairs *pairs, size_t count,
                                    const lmpi_kernel_out *out) {
    stream_all(project_tile, bands, pairs, count, out);
}

#endif

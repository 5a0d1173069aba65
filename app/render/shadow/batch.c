/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/batch.h"

static int source_of(const shadow_batch *b, uint32_t ray) {
    return b->shots[ray / SHADOW_LANES].source[ray % SHADOW_LANES];
}

/* Sorts rays stably by one byte of their source's number. */
static void order_by(const shadow_batch *b, int shift, size_t count, const uint32_t *from,
                     uint32_t *to) {
    uint32_t starts[257] = { 0 };
    for (size_t i = 0; i < count; i++)
        starts[((uint32_t)source_of(b, from[i]) >> shift & 255) + 1]++;
    for (int k = 0; k < 256; k++)
        starts[k + 1] += starts[k];
    for (size_t i = 0; i < count; i++)
        to[starts[(uint32_t)source_of(b, from[i]) >> shift & 255]++] = from[i];
}

/* Lists the rays to be sent, sorted by their sources; *list belongs to the batch. */
static size_t order_rays(shadow_batch *b, const uint32_t **list) {
    size_t count = 0;
    int last = 0, now = 0;
    for (uint32_t i = 0; i < (uint32_t)b->count * SHADOW_LANES; i++) {
        shadow_shot *shot = &b->shots[i / SHADOW_LANES];
        shot->distance[i % SHADOW_LANES] = INFINITY;
        if (shot->rays.length[i % SHADOW_LANES] < 0)
            continue;
        b->order[0][count++] = i;
        last = source_of(b, i) > last ? source_of(b, i) : last;
    }
    for (int shift = 0; shift == 0 || last >> shift > 0; shift += 8, now = 1 - now)
        order_by(b, shift, count, b->order[now], b->order[1 - now]);
    *list = b->order[now];
    return count;
}

/* Sends at most SHADOW_LANES rays. */
static void send_some(shadow_batch *b, const trace_bvh *bvh, const uint32_t *list, size_t count,
                      bool together) {
    trace_rays rays;
    trace_hit hits[SHADOW_LANES];
    for (size_t i = 0; i < SHADOW_LANES; i++) {
        const uint32_t ray = list[i < count ? i : 0], lane = ray % SHADOW_LANES;
        const trace_rays *from = &b->shots[ray / SHADOW_LANES].rays;
        for (int c = 0; c < 3; c++) {
            rays.origin[c][i] = from->origin[c][lane];
            rays.direction[c][i] = from->direction[c][lane];
        }
        rays.start[i] = from->start[lane];
        rays.length[i] = i < count ? from->length[lane] : -1;
    }
    rays.together = together;
    trace_nearest_n(bvh, TRACE_LIGHT, &rays, hits);
    for (size_t i = 0; i < count; i++)
        b->shots[list[i] / SHADOW_LANES].distance[list[i] % SHADOW_LANES] = hits[i].distance;
}

/* Fewer rays than this are faster one at a time. */
enum { TOGETHER_MIN = 4 };

size_t shadow_batch_send(shadow_batch *b, const trace_bvh *bvh) {
    const uint32_t *list;
    const size_t count = order_rays(b, &list);
    for (size_t i = 0; i < count;) {
        size_t some = 1;
        while (i + some < count && some < SHADOW_LANES &&
               source_of(b, list[i + some]) == source_of(b, list[i]))
            some++;
        send_some(b, bvh, list + i, some,
                  some >= TOGETHER_MIN && source_of(b, list[i]) != b->around);
        i += some;
    }
    return count;
}

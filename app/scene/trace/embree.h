/* SPDX-License-Identifier: MIT */
/* embree.h - the use of Embree that the files of this folder share. */
#ifndef LAMPION_SCENE_TRACE_EMBREE_H
#define LAMPION_SCENE_TRACE_EMBREE_H

#include "app/scene/trace/rays.h"

#include <embree3/rtcore.h>

/* Creates a device with the configuration in LAMPION_EMBREE; returns NULL if memory ran out. */
RTCDevice embree_device_create(void);

/* The layout of Embree's packets, planar arrays of n values: only C++ has names for them. */
enum {
    EMBREE_START = 3,
    EMBREE_END = 8,
    EMBREE_RAY = 10,
    EMBREE_U = 15,
    EMBREE_V = 16,
    EMBREE_PRIMITIVE = 17,
    EMBREE_GEOMETRY = 18,
    EMBREE_INSTANCE = 19
};

typedef struct embree_packet {
    float *rows;
    unsigned count;
} embree_packet;

static inline float *embree_value(const embree_packet *p, unsigned row, unsigned lane) {
    return &p->rows[row * p->count + lane];
}

static inline uint32_t *embree_number(const embree_packet *p, unsigned row, unsigned lane) {
    return (uint32_t *)(void *)embree_value(p, row, lane);
}

/* Builds a tree with Embree's threads. These are not instrumented, so the thread sanitizer has to
 * be told what they wait for: their callbacks begin with embree_enter and end with embree_leave. */
void embree_commit(RTCScene tree);
void embree_enter(void);
void embree_leave(void);

/* Makes a packet of rays, numbered by their lanes; valid marks lanes that hold a ray. */
void embree_set_rays(const trace_rays *rays, struct RTCRay16 *packet, int valid[TRACE_LANES]);

/* Sets the hits of a packet to none. */
void embree_clear_hits(struct RTCHit16 *hits);

#endif

/* SPDX-License-Identifier: MIT */
#include "app/scene/trace/embree.h"

#include <stdlib.h>

RTCDevice embree_device_create(void) {
    return rtcNewDevice(getenv("LAMPION_EMBREE"));
}

void embree_set_rays(const trace_rays *rays, struct RTCRay16 *packet, int valid[TRACE_LANES]) {
    for (int i = 0; i < TRACE_LANES; i++) {
        valid[i] = rays->length[i] >= 0 ? -1 : 0;
        packet->org_x[i] = rays->origin[0][i];
        packet->org_y[i] = rays->origin[1][i];
        packet->org_z[i] = rays->origin[2][i];
        packet->dir_x[i] = rays->direction[0][i];
        packet->dir_y[i] = rays->direction[1][i];
        packet->dir_z[i] = rays->direction[2][i];
        packet->tnear[i] = rays->start[i];
        packet->tfar[i] = rays->length[i];
        packet->mask[i] = ~0u;
        packet->id[i] = (unsigned)i;
        packet->time[i] = 0;
        packet->flags[i] = 0;
    }
}

void embree_clear_hits(struct RTCHit16 *hits) {
    for (int i = 0; i < TRACE_LANES; i++)
        hits->geomID[i] = RTC_INVALID_GEOMETRY_ID;
}

#if defined __has_feature
#if __has_feature(thread_sanitizer)
#define IS_WATCHED
#include <sanitizer/tsan_interface.h>
static char handed_over; /* its address stands for the data that threads hand over */
#endif
#endif

void embree_enter(void) {
#ifdef IS_WATCHED
    __tsan_acquire(&handed_over);
#endif
}

void embree_leave(void) {
#ifdef IS_WATCHED
    __tsan_release(&handed_over);
#endif
}

void embree_commit(RTCScene tree) {
    embree_leave();
    rtcCommitScene(tree);
    embree_enter();
}

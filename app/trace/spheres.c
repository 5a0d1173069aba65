/* SPDX-License-Identifier: MIT */
#include "app/trace/spheres.h"

#include "app/trace/embree.h"
#include "app/trace/tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct trace_spheres {
    trace_sphere *of;
    RTCScene rays;
};

typedef struct sphere_context {
    struct RTCIntersectContext embree;
    const trace_rays *rays;
} sphere_context;

/* The distance to the side that is seen of it, in lengths of the direction; NaN of a miss. The
 * ray's nearest point to the center comes from a cross section, which is exact far away. */
static float distance_to(const trace_sphere *sphere, const trace_rays *rays, unsigned lane) {
    float d[3], to[3], length2 = 0, along = 0, miss2 = 0;
    for (int c = 0; c < 3; c++) {
        d[c] = rays->direction[c][lane];
        to[c] = sphere->center[c] - rays->origin[c][lane];
        length2 += d[c] * d[c];
    }
    const float length = sqrtf(length2), scale = 1 / length;
    for (int c = 0; c < 3; c++)
        along += d[c] * scale * to[c];
    for (int c = 0; c < 3; c++) {
        const float miss = to[c] - d[c] * scale * along;
        miss2 += miss * miss;
    }
    const float half2 = sphere->radius * sphere->radius - miss2;
    if (!(half2 >= 0))
        return NAN;
    const float half = sqrtf(half2);
    return (along - half > 0 ? along - half : along + half) / length;
}

static void intersect(const struct RTCIntersectFunctionNArguments *a) {
    const trace_spheres *spheres = a->geometryUserPtr;
    const sphere_context *context = (const sphere_context *)(const void *)a->context;
    const embree_packet p = { (float *)a->rayhit, a->N };
    for (unsigned i = 0; i < p.count; i++) {
        if (!a->valid[i])
            continue;
        const float distance =
            distance_to(&spheres->of[a->primID], context->rays, *embree_number(&p, EMBREE_RAY, i));
        const float end = *embree_value(&p, EMBREE_END, i);
        if (!(distance > *embree_value(&p, EMBREE_START, i) && distance <= end))
            continue;
        uint32_t *const before = embree_number(&p, EMBREE_PRIMITIVE, i);
        if (distance == end && *embree_number(&p, EMBREE_GEOMETRY, i) != RTC_INVALID_GEOMETRY_ID &&
            *before < a->primID)
            continue;
        *embree_value(&p, EMBREE_END, i) = distance;
        *embree_number(&p, EMBREE_GEOMETRY, i) = a->geomID;
        *before = a->primID;
    }
}

/* Widened, so that the tree's rounding drops no sphere. */
static void find_bounds(const struct RTCBoundsFunctionArguments *a) {
    const trace_spheres *spheres = a->geometryUserPtr;
    embree_enter();
    const trace_sphere *s = &spheres->of[a->primID];
    float r[3];
    for (int c = 0; c < 3; c++)
        r[c] = s->radius * 1.0001f + 1e-5f * fabsf(s->center[c]);
    *a->bounds_o = (struct RTCBounds) {
        .lower_x = s->center[0] - r[0],
        .lower_y = s->center[1] - r[1],
        .lower_z = s->center[2] - r[2],
        .upper_x = s->center[0] + r[0],
        .upper_y = s->center[1] + r[1],
        .upper_z = s->center[2] + r[2],
    };
    embree_leave();
}

static bool build(trace_spheres *s, RTCDevice device, size_t count) {
    if (!(s->rays = rtcNewScene(device)))
        return false;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, (unsigned)count);
    rtcSetGeometryUserData(geometry, s);
    rtcSetGeometryBoundsFunction(geometry, find_bounds, NULL);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(s->rays, geometry, 0);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(s->rays, RTC_SCENE_FLAG_ROBUST);
    embree_commit(s->rays);
    return rtcGetDeviceError(device) == RTC_ERROR_NONE;
}

trace_spheres *trace_spheres_create(const trace_bvh *bvh, const trace_sphere *spheres,
                                    size_t count) {
    trace_spheres *s = calloc(1, sizeof *s);
    if (s)
        s->of = malloc((count + 1) * sizeof *s->of);
    if (s && s->of) {
        memcpy(s->of, spheres, count * sizeof *spheres);
        if (build(s, bvh->device, count))
            return s;
    }
    trace_spheres_destroy(s);
    return NULL;
}

void trace_spheres_destroy(trace_spheres *s) {
    if (!s)
        return;
    if (s->rays)
        rtcReleaseScene(s->rays);
    free(s->of);
    free(s);
}

void trace_spheres_nearest_n(const trace_spheres *s, const trace_rays *rays,
                             bool found[TRACE_LANES], trace_hit hits[TRACE_LANES]) {
    sphere_context context;
    struct RTCRayHit16 query;
    _Alignas(64) int valid[TRACE_LANES];
    embree_set_rays(rays, &query, valid);
    for (int i = 0; i < TRACE_LANES; i++)
        if (hits[i].distance < query.ray.tfar[i])
            query.ray.tfar[i] = hits[i].distance;
    rtcInitIntersectContext(&context.embree);
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context.rays = rays;
    rtcIntersect16(valid, s->rays, &context.embree, &query);
    for (int i = 0; i < TRACE_LANES; i++) {
        found[i] = query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        if (found[i])
            hits[i] = (trace_hit) { .distance = query.ray.tfar[i],
                                    .instance = s->of[query.hit.primID[i]].number };
    }
}

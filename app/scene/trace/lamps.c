/* SPDX-License-Identifier: MIT */
#include "app/scene/trace/lamps.h"

#include "app/scene/emitter.h"
#include "app/scene/trace/embree.h"
#include "app/scene/trace/tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct lamp {
    float center[3], radius;   /* of a sphere, or of one around an area */
    const scene_emitter *area; /* NULL for a sphere */
    uint32_t number;
} lamp;

struct trace_lamps {
    lamp *of;
    scene_emitter *areas;
    RTCScene rays;
};

typedef struct lamp_context {
    struct RTCIntersectContext embree;
    const trace_rays *rays;
} lamp_context;

/* Returns the distance to the visible side, in lengths of the direction; NaN for a miss. The ray's
 * nearest point to the center comes from a cross product, which is accurate far away. */
static float distance_to_sphere(const lamp *sphere, const trace_rays *rays, unsigned lane) {
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
    const float half_chord2 = sphere->radius * sphere->radius - miss2;
    if (!(half_chord2 >= 0))
        return NAN;
    const float half_chord = sqrtf(half_chord2);
    return (along - half_chord > 0 ? along - half_chord : along + half_chord) / length;
}

static float distance_to(const lamp *l, const trace_rays *rays, unsigned lane) {
    const float origin[3] = { rays->origin[0][lane], rays->origin[1][lane], rays->origin[2][lane] };
    const float direction[3] = { rays->direction[0][lane], rays->direction[1][lane],
                                 rays->direction[2][lane] };
    return l->area ? scene_emitter_distance(l->area, origin, direction)
                   : distance_to_sphere(l, rays, lane);
}

static void intersect(const struct RTCIntersectFunctionNArguments *a) {
    const trace_lamps *lamps = a->geometryUserPtr;
    const lamp_context *context = (const lamp_context *)(const void *)a->context;
    const embree_packet p = { (float *)a->rayhit, a->N };
    for (unsigned i = 0; i < p.count; i++) {
        if (!a->valid[i])
            continue;
        const float distance =
            distance_to(&lamps->of[a->primID], context->rays, *embree_number(&p, EMBREE_RAY, i));
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

/* Finds a light's bounds, widened so that the tree's rounding drops none. */
static void find_bounds(const struct RTCBoundsFunctionArguments *a) {
    const trace_lamps *lamps = a->geometryUserPtr;
    embree_enter();
    const lamp *s = &lamps->of[a->primID];
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

static bool build(trace_lamps *s, RTCDevice device, size_t count) {
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

/* Takes over a light; *used counts the areas. */
static void set_lamp(const trace_lamp *from, scene_emitter *areas, size_t *used, lamp *to) {
    const lmp_light *light = from->light;
    lmp_vec3 center = light->position;
    *to = (lamp) { .radius = light->radius, .number = from->number };
    if (scene_light_is_area(light)) {
        scene_emitter *area = &areas[(*used)++];
        scene_emitter_set(light, area);
        to->area = area;
        to->radius = area->extent;
        center = area->center;
    }
    to->center[0] = center.x;
    to->center[1] = center.y;
    to->center[2] = center.z;
}

trace_lamps *trace_lamps_create(const trace_bvh *bvh, const trace_lamp *lamps, size_t count) {
    trace_lamps *s = calloc(1, sizeof *s);
    size_t areas = 0, used = 0;
    for (size_t i = 0; i < count; i++)
        areas += scene_light_is_area(lamps[i].light);
    if (s) {
        s->of = malloc((count + 1) * sizeof *s->of);
        s->areas = malloc((areas + 1) * sizeof *s->areas);
    }
    if (s && s->of && s->areas) {
        for (size_t i = 0; i < count; i++)
            set_lamp(&lamps[i], s->areas, &used, &s->of[i]);
        if (build(s, bvh->device, count))
            return s;
    }
    trace_lamps_destroy(s);
    return NULL;
}

void trace_lamps_destroy(trace_lamps *s) {
    if (!s)
        return;
    if (s->rays)
        rtcReleaseScene(s->rays);
    free(s->areas);
    free(s->of);
    free(s);
}

void trace_lamps_nearest_n(const trace_lamps *s, const trace_rays *rays, bool found[TRACE_LANES],
                           trace_hit hits[TRACE_LANES]) {
    lamp_context context;
    struct RTCRayHit16 query;
    _Alignas(64) int valid[TRACE_LANES];
    embree_set_rays(rays, &query.ray, valid);
    embree_clear_hits(&query.hit);
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

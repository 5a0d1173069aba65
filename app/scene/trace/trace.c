/* SPDX-License-Identifier: MIT */
#include "app/scene/trace/trace.h"

#include "app/scene/texture_at.h"
#include "app/scene/trace/embree.h"
#include "app/scene/trace/tree.h"
#include "app/scene/trace/triangle.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

/* The context that Embree passes to the intersection test. */
typedef struct trace_context {
    struct RTCIntersectContext embree;
    const trace_bvh *bvh;
    trace_kind kind;
    triangle_rays rays; /* the rays in the world, by their number */
} trace_context;

typedef struct trace_triangle {
    const scene_vertex *corners[3];
    double weights[3];
} trace_triangle;

static void set_weights(float u, float v, double weights[3]) {
    weights[0] = 1 - (double)u - (double)v;
    weights[1] = (double)u;
    weights[2] = (double)v;
}

void trace_corners(const scene *world, const trace_hit *hit, scene_vertex corners[3],
                   double weights[3]) {
    scene_triangle(world, hit->instance, hit->triangle, corners);
    set_weights(hit->u, hit->v, weights);
}

/* --- what lets rays pass ---------------------------------------------------------------------- */

/* Whether a material may let rays pass. For light, blended materials act as masks. */
static bool may_be_cut(const scene_material *material, trace_kind kind) {
    return material->flags & SCENE_ALPHA_MASK ||
           (material->flags & SCENE_ALPHA_BLEND && kind != TRACE_CAMERA);
}

static double alpha_of(const scene *world, const scene_material *material,
                       const trace_triangle *t) {
    const uint32_t set = material->base_color_map.set;
    double uv[2] = { 0, 0 }, alpha = material->flags & SCENE_VERTEX_COLORS ? 0 : 1;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++)
            uv[k] += t->weights[i] * (double)t->corners[i]->uv[set][k];
        if (material->flags & SCENE_VERTEX_COLORS)
            alpha += t->weights[i] * (double)t->corners[i]->color[3] / 65535;
    }
    return texture_alpha_at(world, &material->base_color_map, uv) * alpha *
           (double)material->base_color[3];
}

double trace_alpha(const scene *world, const trace_hit *hit) {
    const uint32_t material = scene_instance_material(world, hit->instance);
    trace_triangle t;
    scene_triangle_vertices(world, hit->instance, hit->triangle, t.corners);
    set_weights(hit->u, hit->v, t.weights);
    return alpha_of(world, &world->materials[material], &t);
}

/* --- rays against a triangle ------------------------------------------------------------------ */

/* A packet of rays and a triangle of an instance. */
typedef struct trace_packet {
    embree_packet lanes;
    bool any; /* whether any hit ends a ray, and the packet has no rows for hits */
    const trace_instance *instance;
    const trace_context *context;
    uint32_t number, triangle; /* of the instance, and of the triangle in it */
} trace_packet;

/* Whether a hit lies on the lane's ray and comes before its current one: the nearest triangle, and
 * among equally near ones the first. So results depend neither on the tree's shape nor on the order
 * of traversal. */
static bool comes_first(const trace_packet *p, unsigned lane, float distance) {
    const float end = *embree_value(&p->lanes, EMBREE_END, lane);
    if (!(distance > *embree_value(&p->lanes, EMBREE_START, lane) && distance <= end))
        return false;
    if (p->any)
        return true;
    const uint32_t last = *embree_number(&p->lanes, EMBREE_GEOMETRY, lane);
    return distance < end || p->number < last ||
           (p->number == last && p->triangle < *embree_number(&p->lanes, EMBREE_PRIMITIVE, lane));
}

static bool lets_pass(const trace_packet *p, const triangle_hit *hit) {
    const scene_material *material = p->instance->material;
    const trace_kind kind = p->context->kind;
    if (kind != TRACE_LIGHT && !hit->front && !(material->flags & SCENE_DOUBLE_SIDED))
        return true;
    if (!may_be_cut(material, kind))
        return false;
    trace_triangle t;
    const scene *world = p->context->bvh->scene;
    scene_triangle_vertices(world, p->number, p->triangle, t.corners);
    set_weights(hit->u, hit->v, t.weights);
    const double alpha = alpha_of(world, material, &t);
    return alpha < (double)material->alpha_cutoff;
}

/* Ends the lane's ray, where no further hit counts, or shortens it. */
static void keep(const trace_packet *p, unsigned lane, const triangle_hit *hit) {
    *embree_value(&p->lanes, EMBREE_END, lane) = p->any ? -INFINITY : hit->distance;
    if (p->any)
        return;
    *embree_value(&p->lanes, EMBREE_U, lane) = hit->u;
    *embree_value(&p->lanes, EMBREE_V, lane) = hit->v;
    *embree_number(&p->lanes, EMBREE_PRIMITIVE, lane) = p->triangle;
    *embree_number(&p->lanes, EMBREE_GEOMETRY, lane) = p->number;
    *embree_number(&p->lanes, EMBREE_INSTANCE, lane) = RTC_INVALID_GEOMETRY_ID;
}

/* Takes a hit of a lane's ray unless it is farther than the current one or the triangle lets it
 * pass. */
static void consider(const trace_packet *p, unsigned lane, triangle_hit hit) {
    if (comes_first(p, lane, hit.distance) && !lets_pass(p, &hit))
        keep(p, lane, &hit);
}

/* Up to this many active lanes of a packet are tested one at a time, by the same arithmetic. */
enum { FEW = 3 };

/* Returns the active lanes of a packet, lane i as bit i. */
static uint32_t active_of(const int *valid, unsigned count) {
    static const uint32_t bits[TRACE_LANES] = { 1u << 0,  1u << 1,  1u << 2,  1u << 3,
                                                1u << 4,  1u << 5,  1u << 6,  1u << 7,
                                                1u << 8,  1u << 9,  1u << 10, 1u << 11,
                                                1u << 12, 1u << 13, 1u << 14, 1u << 15 };
    uint32_t active = 0;
    if (count == TRACE_LANES) {
        for (unsigned i = 0; i < TRACE_LANES; i++)
            active |= (uint32_t)valid[i] & bits[i];
        return active;
    }
    for (unsigned i = 0; i < count; i++)
        active |= (uint32_t)valid[i] & bits[i];
    return active;
}

static bool are_few(uint32_t active) {
    for (int i = 0; i < FEW; i++)
        active &= active - 1;
    return active == 0;
}

/* Takes the lowest of some lanes out of them. */
static unsigned next_lane(uint32_t *lanes) {
    const unsigned lane = (unsigned)__builtin_ctz(*lanes);
    *lanes &= *lanes - 1;
    return lane;
}

/* Tests the packet's active rays against its triangle; `first` is the number of the ray that lane 0
 * holds. */
static void meet(trace_packet *p, uint32_t active, unsigned first, bool few) {
    const triangle_rays *const rays = &p->context->rays;
    const float *const ends = embree_value(&p->lanes, EMBREE_END, 0), *corners[3];
    float moved[3][3];
    triangle_hits hits;
    tree_corners(p->instance, p->triangle, moved, corners);
    if (!few)
        active &= triangle_test(rays, first, p->lanes.count, corners, ends, &hits);
    while (active) {
        const unsigned lane = next_lane(&active);
        if (!few)
            consider(p, lane, triangle_hit_at(&hits, lane));
        else if (triangle_test(rays, first + lane, 1, corners, ends + lane, &hits))
            consider(p, lane, triangle_hit_at(&hits, 0));
    }
}

/* Tests rays against a group of triangles. Embree has transformed its rays into the mesh's space by
 * arithmetic that differs between instruction sets, so the test uses the rays in the world. */
static void meet_group(embree_packet lanes, bool any, const struct RTCIntersectContext *embree,
                       const int *valid, unsigned geometry, unsigned primitive) {
    const trace_context *context = (const trace_context *)(const void *)embree;
    const uint32_t active = active_of(valid, lanes.count);
    if (active == 0)
        return;
    const unsigned outer = context->embree.instID[0];
    const uint32_t number = outer == RTC_INVALID_GEOMETRY_ID ? geometry : outer;
    trace_packet p = { .lanes = lanes,
                       .any = any,
                       .instance = &context->bvh->instances[number],
                       .context = context,
                       .number = number };
    const uint32_t *group = &p.instance->groups[primitive];
    /* the numbers of active rays are consecutive */
    const unsigned lane = (unsigned)__builtin_ctz(active);
    const unsigned first = *embree_number(&lanes, EMBREE_RAY, lane) - lane;
    const bool few = are_few(active);
    for (p.triangle = group[0]; p.triangle < group[1]; p.triangle++)
        meet(&p, active, first, few);
}

static void intersect(const struct RTCIntersectFunctionNArguments *a) {
    meet_group((embree_packet) { (float *)a->rayhit, a->N }, false, a->context, a->valid, a->geomID,
               a->primID);
}

static void occlude(const struct RTCOccludedFunctionNArguments *a) {
    meet_group((embree_packet) { (float *)a->ray, a->N }, true, a->context, a->valid, a->geomID,
               a->primID);
}

/* --- creation --------------------------------------------------------------------------------- */

/* Upper bounds on the memory of Embree and its threads, in bytes: its allocator asks for 128 MiB at
 * once. */
#define ROOM          ((size_t)192 << 20)
#define ROOM_THREAD   ((size_t)16 << 20)
#define ROOM_TRIANGLE 292
#define ROOM_INSTANCE 2048

/* Whether that memory is available where the address space is limited: Embree is C++, and its
 * threads end the program if an allocation fails. */
static bool has_room(const scene *world) {
    const size_t threads = (size_t)sysconf(_SC_NPROCESSORS_ONLN);
    const size_t room = ROOM + ROOM_THREAD * threads + ROOM_TRIANGLE * (world->index_count / 3) +
                        ROOM_INSTANCE * world->instance_count;
    struct rlimit space;
    if (getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur == RLIM_INFINITY)
        return true;
    void *memory = mmap(NULL, room, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return memory != MAP_FAILED && munmap(memory, room) == 0;
}

trace_bvh *trace_create(const scene *world) {
    trace_bvh *bvh = calloc(1, sizeof *bvh);
    if (bvh && has_room(world) && tree_build(bvh, world, intersect, occlude))
        return bvh;
    trace_destroy(bvh);
    return NULL;
}

void trace_destroy(trace_bvh *bvh) {
    if (!bvh)
        return;
    tree_free(bvh);
    free(bvh);
}

/* --- rays ------------------------------------------------------------------------------------- */

static void set_context(const trace_bvh *bvh, trace_kind kind, bool together,
                        trace_context *context) {
    rtcInitIntersectContext(&context->embree);
    context->bvh = bvh;
    context->kind = kind;
    if (together)
        context->embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
}

static struct RTCRay ray_of(const float origin[3], const float direction[3], float start,
                            float length, unsigned number) {
    return (struct RTCRay) { .org_x = origin[0],
                             .org_y = origin[1],
                             .org_z = origin[2],
                             .tnear = start,
                             .dir_x = direction[0],
                             .dir_y = direction[1],
                             .dir_z = direction[2],
                             .tfar = length,
                             .id = number,
                             .mask = ~0u };
}

static struct RTCRay ray_at(const trace_rays *rays, unsigned lane) {
    const float origin[3] = { rays->origin[0][lane], rays->origin[1][lane], rays->origin[2][lane] };
    const float direction[3] = { rays->direction[0][lane], rays->direction[1][lane],
                                 rays->direction[2][lane] };
    return ray_of(origin, direction, rays->start[lane], rays->length[lane], lane);
}

static void set_ray(const trace_bvh *bvh, trace_kind kind, const float origin[3],
                    const float direction[3], trace_context *context) {
    const float *const from[3] = { &origin[0], &origin[1], &origin[2] };
    const float *const along[3] = { &direction[0], &direction[1], &direction[2] };
    triangle_rays_set(from, along, 1, &context->rays);
    set_context(bvh, kind, kind != TRACE_LIGHT, context);
}

/* Returns whether rays are traced together, as they are if their directions are similar, like those
 * of a camera. Rays to several lights diverge so soon that tracing each by itself takes 0.87 of the
 * time in San Miguel. */
static bool set_rays(const trace_bvh *bvh, trace_kind kind, const trace_rays *rays,
                     trace_context *context) {
    const float *const from[3] = { rays->origin[0], rays->origin[1], rays->origin[2] };
    const float *const along[3] = { rays->direction[0], rays->direction[1], rays->direction[2] };
    const bool together = kind != TRACE_LIGHT || rays->together;
    triangle_rays_set(from, along, TRACE_LANES, &context->rays);
    set_context(bvh, kind, together, context);
    return together;
}

/* --- the nearest hit -------------------------------------------------------------------------- */

static trace_hit nearest(const trace_bvh *bvh, trace_context *context, struct RTCRay ray) {
    struct RTCRayHit query = { .ray = ray, .hit = { .geomID = RTC_INVALID_GEOMETRY_ID } };
    rtcIntersect1(bvh->rays, &context->embree, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return trace_miss();
    return (trace_hit) { query.ray.tfar, query.hit.geomID, query.hit.primID, query.hit.u,
                         query.hit.v };
}

trace_hit trace_nearest(const trace_bvh *bvh, trace_kind kind, const float origin[3],
                        const float direction[3]) {
    trace_context context;
    set_ray(bvh, kind, origin, direction, &context);
    return nearest(bvh, &context, ray_of(origin, direction, 0, INFINITY, 0));
}

static void trace_together(const trace_bvh *bvh, trace_context *context, const trace_rays *rays,
                           trace_hit hits[TRACE_LANES]) {
    struct RTCRayHit16 query;
    _Alignas(64) int valid[TRACE_LANES];
    embree_set_rays(rays, &query.ray, valid);
    embree_clear_hits(&query.hit);
    rtcIntersect16(valid, bvh->rays, &context->embree, &query);
    for (int i = 0; i < TRACE_LANES; i++)
        hits[i] = query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                      ? trace_miss()
                      : (trace_hit) { query.ray.tfar[i], query.hit.geomID[i], query.hit.primID[i],
                                      query.hit.u[i], query.hit.v[i] };
}

void trace_nearest_n(const trace_bvh *bvh, trace_kind kind, const trace_rays *rays,
                     trace_hit hits[TRACE_LANES]) {
    trace_context context;
    if (set_rays(bvh, kind, rays, &context)) {
        trace_together(bvh, &context, rays, hits);
        return;
    }
    for (unsigned i = 0; i < TRACE_LANES; i++)
        hits[i] = rays->length[i] >= 0 ? nearest(bvh, &context, ray_at(rays, i)) : trace_miss();
}

/* --- any hit ---------------------------------------------------------------------------------- */

static bool occluded(const trace_bvh *bvh, trace_context *context, struct RTCRay ray) {
    rtcOccluded1(bvh->rays, &context->embree, &ray);
    return ray.tfar < 0;
}

bool trace_occluded(const trace_bvh *bvh, const float origin[3], const float direction[3],
                    float length) {
    trace_context context;
    set_ray(bvh, TRACE_LIGHT, origin, direction, &context);
    return occluded(bvh, &context, ray_of(origin, direction, 0, length, 0));
}

static void occlude_together(const trace_bvh *bvh, trace_context *context, const trace_rays *rays,
                             bool hit[TRACE_LANES]) {
    struct RTCRay16 query;
    _Alignas(64) int valid[TRACE_LANES];
    embree_set_rays(rays, &query, valid);
    rtcOccluded16(valid, bvh->rays, &context->embree, &query);
    for (int i = 0; i < TRACE_LANES; i++)
        hit[i] = valid[i] && query.tfar[i] < 0;
}

void trace_occluded_n(const trace_bvh *bvh, const trace_rays *rays, bool hit[TRACE_LANES]) {
    trace_context context;
    if (set_rays(bvh, TRACE_LIGHT, rays, &context)) {
        occlude_together(bvh, &context, rays, hit);
        return;
    }
    for (unsigned i = 0; i < TRACE_LANES; i++)
        hit[i] = rays->length[i] >= 0 && occluded(bvh, &context, ray_at(rays, i));
}

void trace_version(const trace_bvh *bvh, char *text, size_t size) {
    const RTCDevice device = bvh ? bvh->device : embree_device_create();
    if (!device) {
        snprintf(text, size, "Embree (does not start)");
        return;
    }
    snprintf(text, size, "Embree %d.%d.%d",
             (int)rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_MAJOR),
             (int)rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_MINOR),
             (int)rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_PATCH));
    if (!bvh)
        rtcReleaseDevice(device);
}

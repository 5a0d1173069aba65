/* SPDX-License-Identifier: MIT */
#include "app/trace/trace.h"

#include "app/trace/blend.h"
#include "app/trace/embree.h"
#include "app/trace/texture.h"
#include "app/trace/tree.h"
#include "app/trace/triangle.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

/* Embree hands the context it was called with to the test. */
typedef struct trace_context {
    struct RTCIntersectContext embree;
    const trace_bvh *bvh;
    trace_kind kind;
    triangle_rays rays;      /* Embree's, by their number, in the world */
    const trace_rays *image; /* of TRACE_IMAGE */
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

/* Light passes what blends where a mask would let it. */
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
    return trace_texture_alpha(world, &material->base_color_map, uv) * alpha *
           (double)material->base_color[3];
}

/* --- rays against a triangle ------------------------------------------------------------------ */

/* Of some rays and a triangle of an instance. */
typedef struct trace_packet {
    embree_packet lanes;
    const trace_instance *instance;
    const trace_context *context;
    uint32_t number, triangle; /* of the instance, and in it */
} trace_packet;

/* The nearest triangle counts, and of those at one distance the first: so it matters neither which
 * shape the tree has nor in which order it is visited. */
static bool comes_first(const trace_packet *p, unsigned lane, float distance) {
    const float end = *embree_value(&p->lanes, EMBREE_END, lane);
    if (!(distance > *embree_value(&p->lanes, EMBREE_START, lane) && distance <= end))
        return false;
    const uint32_t last = *embree_number(&p->lanes, EMBREE_GEOMETRY, lane);
    return distance < end || p->number < last ||
           (p->number == last && p->triangle < *embree_number(&p->lanes, EMBREE_PRIMITIVE, lane));
}

/* Of the ray's pixel and the triangle. */
static double threshold_of(const trace_packet *p, unsigned lane) {
    const trace_rays *rays = p->context->image;
    const uint32_t pixel = rays->pixel[*embree_number(&p->lanes, EMBREE_RAY, lane)];
    return (double)blend_threshold(pixel + p->number * 747796405u + p->triangle * 2891336453u,
                                   rays->sample, rays->samples);
}

static bool lets_pass(const trace_packet *p, unsigned lane, const triangle_hit *hit) {
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
    return kind == TRACE_IMAGE && material->flags & SCENE_ALPHA_BLEND
               ? alpha <= threshold_of(p, lane)
               : alpha < (double)material->alpha_cutoff;
}

static void keep(const trace_packet *p, unsigned lane, const triangle_hit *hit) {
    *embree_value(&p->lanes, EMBREE_END, lane) = hit->distance;
    *embree_value(&p->lanes, EMBREE_U, lane) = hit->u;
    *embree_value(&p->lanes, EMBREE_V, lane) = hit->v;
    *embree_number(&p->lanes, EMBREE_PRIMITIVE, lane) = p->triangle;
    *embree_number(&p->lanes, EMBREE_GEOMETRY, lane) = p->number;
    *embree_number(&p->lanes, EMBREE_INSTANCE, lane) = RTC_INVALID_GEOMETRY_ID;
}

/* A lane's ray, of which the test says that it meets the triangle, or that it passes by. */
static void consider(const trace_packet *p, unsigned lane, triangle_hit hit) {
    if (comes_first(p, lane, hit.distance) && !lets_pass(p, lane, &hit))
        keep(p, lane, &hit);
}

/* Few lanes of a packet are tested one at a time, by the same arithmetic. */
enum { FEW = 3 };

static bool are_few(const int *valid, unsigned count) {
    unsigned sum = 0;
    for (unsigned i = 0; i < count; i++)
        sum += valid[i] != 0;
    return sum <= FEW;
}

/* The number of the packet's first ray: numbers run on, and are those of rays that take part. */
static unsigned first_ray(const trace_packet *p, const int *valid) {
    unsigned lane = 0;
    while (lane + 1 < p->lanes.count && !valid[lane])
        lane++;
    return *embree_number(&p->lanes, EMBREE_RAY, lane) - lane;
}

/* Embree has taken its rays into the space of a mesh with a tree of its own, by arithmetic that
 * differs between instruction sets: the test is that of the rays in the world all the same. */
static void intersect(const struct RTCIntersectFunctionNArguments *a) {
    const trace_context *context = (const trace_context *)(const void *)a->context;
    const unsigned outer = context->embree.instID[0];
    const uint32_t number = outer == RTC_INVALID_GEOMETRY_ID ? a->geomID : outer;
    const trace_packet p = { .lanes = { (float *)a->rayhit, a->N },
                             .instance = &context->bvh->instances[number],
                             .context = context,
                             .number = number,
                             .triangle = a->primID };
    const float *corners[3];
    float moved[3][3];
    triangle_hits hits;
    const unsigned first = first_ray(&p, a->valid);
    tree_corners(p.instance, p.triangle, moved, corners);
    if (are_few(a->valid, a->N)) {
        for (unsigned i = 0; i < a->N; i++)
            if (a->valid[i] && triangle_test(&context->rays, first + i, 1, corners, &hits))
                consider(&p, i, triangle_hit_at(&hits, 0));
    } else if (triangle_test(&context->rays, first, a->N, corners, &hits)) {
        const float *ends = embree_value(&p.lanes, EMBREE_END, 0);
        for (unsigned i = 0; i < a->N; i++)
            if (a->valid[i] && hits.distance[i] <= ends[i]) /* most pass by, or behind another */
                consider(&p, i, triangle_hit_at(&hits, i));
    }
}

/* --- creation --------------------------------------------------------------------------------- */

/* What Embree and its threads take at most, in bytes: its allocator asks for 128 MiB at once. */
#define ROOM          ((size_t)192 << 20)
#define ROOM_THREAD   ((size_t)16 << 20)
#define ROOM_TRIANGLE 292
#define ROOM_INSTANCE 2048

/* Whether all of it is there where the address space is limited: Embree is C++, and its threads end
 * the program where memory is refused to them. */
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
    if (bvh && has_room(world) && tree_build(bvh, world, intersect))
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

static trace_hit nearest(const trace_bvh *bvh, trace_context *context, const float origin[3],
                         const float direction[3], float start, float length, unsigned number) {
    struct RTCRayHit query = {
        .ray = { .org_x = origin[0],
                 .org_y = origin[1],
                 .org_z = origin[2],
                 .tnear = start,
                 .dir_x = direction[0],
                 .dir_y = direction[1],
                 .dir_z = direction[2],
                 .tfar = length,
                 .id = number,
                 .mask = ~0u },
        .hit = { .geomID = RTC_INVALID_GEOMETRY_ID },
    };
    rtcIntersect1(bvh->rays, &context->embree, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return trace_miss();
    return (trace_hit) { query.ray.tfar, query.hit.geomID, query.hit.primID, query.hit.u,
                         query.hit.v };
}

trace_hit trace_nearest(const trace_bvh *bvh, trace_kind kind, const float origin[3],
                        const float direction[3]) {
    trace_context context;
    const float *const from[3] = { &origin[0], &origin[1], &origin[2] };
    const float *const along[3] = { &direction[0], &direction[1], &direction[2] };
    triangle_rays_set(from, along, 1, &context.rays);
    context.image = NULL;
    set_context(bvh, kind, kind != TRACE_LIGHT, &context);
    return nearest(bvh, &context, origin, direction, 0, INFINITY, 0);
}

static void trace_apart(const trace_bvh *bvh, trace_context *context, const trace_rays *rays,
                        trace_hit hits[TRACE_LANES]) {
    for (unsigned i = 0; i < TRACE_LANES; i++) {
        const float origin[3] = { rays->origin[0][i], rays->origin[1][i], rays->origin[2][i] };
        const float direction[3] = { rays->direction[0][i], rays->direction[1][i],
                                     rays->direction[2][i] };
        hits[i] = rays->length[i] >= 0
                      ? nearest(bvh, context, origin, direction, rays->start[i], rays->length[i], i)
                      : trace_miss();
    }
}

static void trace_together(const trace_bvh *bvh, trace_context *context, const trace_rays *rays,
                           trace_hit hits[TRACE_LANES]) {
    struct RTCRayHit16 query;
    _Alignas(64) int valid[TRACE_LANES];
    embree_set_rays(rays, &query, valid);
    rtcIntersect16(valid, bvh->rays, &context->embree, &query);
    for (int i = 0; i < TRACE_LANES; i++)
        hits[i] = query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                      ? trace_miss()
                      : (trace_hit) { query.ray.tfar[i], query.hit.geomID[i], query.hit.primID[i],
                                      query.hit.u[i], query.hit.v[i] };
}

/* Rays of a camera go the same way; those to several lights part so soon that each is traced by
 * itself: that takes 0.87 of the time in San Miguel. */
void trace_nearest_n(const trace_bvh *bvh, trace_kind kind, const trace_rays *rays,
                     trace_hit hits[TRACE_LANES]) {
    trace_context context;
    const float *const from[3] = { rays->origin[0], rays->origin[1], rays->origin[2] };
    const float *const along[3] = { rays->direction[0], rays->direction[1], rays->direction[2] };
    triangle_rays_set(from, along, TRACE_LANES, &context.rays);
    context.image = rays;
    const bool together = kind != TRACE_LIGHT || rays->together;
    set_context(bvh, kind, together, &context);
    if (together)
        trace_together(bvh, &context, rays, hits);
    else
        trace_apart(bvh, &context, rays, hits);
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

/* SPDX-License-Identifier: MIT */
#include "app/trace/trace.h"

#include "app/trace/texture.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

/* One Embree geometry a mesh. */
typedef struct trace_mesh {
    const scene *scene;
    const scene_mesh *mesh;
    const scene_material *material;
} trace_mesh;

struct trace_bvh {
    trace_mesh *meshes;
    RTCDevice device;
    RTCScene rays;
};

/* Embree hands the context it was called with to the filter. */
typedef struct trace_context {
    struct RTCIntersectContext embree;
    const trace_bvh *bvh;
    trace_kind kind;
} trace_context;

typedef struct trace_triangle {
    const scene_vertex *corners[3];
    double weights[3];
} trace_triangle;

static void set_corners(const scene *world, const scene_mesh *mesh, uint32_t triangle, float u,
                        float v, const scene_vertex *corners[3], double weights[3]) {
    const uint32_t *index = world->indices + mesh->first_index + 3 * (size_t)triangle;
    for (int i = 0; i < 3; i++)
        corners[i] = &world->vertices[index[i]];
    weights[0] = 1 - (double)u - (double)v;
    weights[1] = (double)u;
    weights[2] = (double)v;
}

void trace_corners(const scene *world, const trace_hit *hit, const scene_vertex *corners[3],
                   double weights[3]) {
    set_corners(world, &world->meshes[hit->mesh], hit->triangle, hit->u, hit->v, corners, weights);
}

double trace_lift(const scene *world) {
    double size = 0;
    for (int i = 0; i < 3; i++)
        size = fmax(size, fmax(fabs((double)world->minimum[i]), fabs((double)world->maximum[i])));
    return 1e-5 * size;
}

/* --- what lets rays pass ---------------------------------------------------------------------- */

/* Light passes what blends where a mask would let it. */
static bool may_be_cut(const scene_material *material, trace_kind kind) {
    return material->flags & SCENE_ALPHA_MASK ||
           (material->flags & SCENE_ALPHA_BLEND && kind == TRACE_LIGHT);
}

static bool cut_out(const trace_mesh *mesh, const trace_triangle *t, trace_kind kind) {
    const scene_material *material = mesh->material;
    const uint32_t set = material->base_color_map.set;
    double uv[2] = { 0, 0 }, rgba[4], alpha = material->flags & SCENE_VERTEX_COLORS ? 0 : 1;
    if (!may_be_cut(material, kind))
        return false;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++)
            uv[k] += t->weights[i] * (double)t->corners[i]->uv[set][k];
        if (material->flags & SCENE_VERTEX_COLORS)
            alpha += t->weights[i] * (double)t->corners[i]->color[3] / 65535;
    }
    trace_texture_at(mesh->scene, &material->base_color_map, uv, rgba);
    return rgba[3] * alpha * (double)material->base_color[3] < (double)material->alpha_cutoff;
}

/* Embree hands rays and hits over as rows of n values; C++ alone has names for them. */
enum { ROW_DIRECTION = 4, ROW_NORMAL = 0, ROW_U = 3, ROW_V = 4, ROW_TRIANGLE = 5, ROW_MESH = 6 };

static float value_at(const void *rows, unsigned row, unsigned n, unsigned lane) {
    return ((const float *)rows)[row * n + lane];
}

static uint32_t number_at(const void *rows, unsigned row, unsigned n, unsigned lane) {
    return ((const uint32_t *)rows)[row * n + lane];
}

/* Faces are counter-clockwise to their viewer, and Embree's normals point to him. */
static bool shows_back(const struct RTCFilterFunctionNArguments *a, unsigned lane) {
    float facing = 0;
    for (unsigned c = 0; c < 3; c++)
        facing += value_at(a->hit, ROW_NORMAL + c, a->N, lane) *
                  value_at(a->ray, ROW_DIRECTION + c, a->N, lane);
    return facing >= 0;
}

static void pass_cut_out(const struct RTCFilterFunctionNArguments *a) {
    const trace_context *context = (const trace_context *)(const void *)a->context;
    const trace_mesh *mesh = a->geometryUserPtr;
    for (unsigned i = 0; i < a->N; i++) {
        if (!a->valid[i])
            continue;
        trace_triangle t;
        set_corners(mesh->scene, mesh->mesh, number_at(a->hit, ROW_TRIANGLE, a->N, i),
                    value_at(a->hit, ROW_U, a->N, i), value_at(a->hit, ROW_V, a->N, i), t.corners,
                    t.weights);
        if (cut_out(mesh, &t, context->kind))
            a->valid[i] = 0;
    }
}

static void pass_backs(const struct RTCFilterFunctionNArguments *a) {
    const trace_context *context = (const trace_context *)(const void *)a->context;
    for (unsigned i = 0; i < a->N; i++) {
        if (!a->valid[i])
            continue;
        const uint32_t mesh = number_at(a->hit, ROW_MESH, a->N, i);
        const uint32_t flags = context->bvh->meshes[mesh].material->flags;
        if (!(flags & SCENE_DOUBLE_SIDED) && shows_back(a, i))
            a->valid[i] = 0;
    }
}

/* --- creation --------------------------------------------------------------------------------- */

static bool add_mesh(trace_bvh *bvh, const scene *world, size_t number) {
    trace_mesh *mesh = &bvh->meshes[number];
    RTCGeometry geometry = rtcNewGeometry(bvh->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    mesh->scene = world;
    mesh->mesh = &world->meshes[number];
    mesh->material = &world->materials[mesh->mesh->material];
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               world->vertices, 0, sizeof *world->vertices, world->vertex_count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, world->indices,
                               mesh->mesh->first_index * sizeof *world->indices,
                               3 * sizeof *world->indices, mesh->mesh->index_count / 3);
    rtcSetGeometryUserData(geometry, mesh);
    if (may_be_cut(mesh->material, TRACE_LIGHT))
        rtcSetGeometryIntersectFilterFunction(geometry, pass_cut_out);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(bvh->rays, geometry, (unsigned)number);
    rtcReleaseGeometry(geometry);
    return rtcGetDeviceError(bvh->device) == RTC_ERROR_NONE;
}

static bool build(trace_bvh *bvh, const scene *world) {
    bvh->meshes = calloc(world->mesh_count + 1, sizeof *bvh->meshes);
    bvh->device = rtcNewDevice(NULL);
    if (!bvh->meshes || !bvh->device || !(bvh->rays = rtcNewScene(bvh->device)))
        return false;
    rtcSetSceneFlags(bvh->rays, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    for (size_t i = 0; i < world->mesh_count; i++)
        if (!add_mesh(bvh, world, i))
            return false;
    rtcCommitScene(bvh->rays);
    return rtcGetDeviceError(bvh->device) == RTC_ERROR_NONE;
}

/* What Embree and its threads take at most, in bytes: its allocator asks for 128 MiB at once. */
#define ROOM          ((size_t)192 << 20)
#define ROOM_THREAD   ((size_t)16 << 20)
#define ROOM_TRIANGLE 256

/* Whether all of it is there where the address space is limited: Embree is C++, and its threads end
 * the program where memory is refused to them. */
static bool has_room(const scene *world) {
    const size_t threads = (size_t)sysconf(_SC_NPROCESSORS_ONLN);
    const size_t room = ROOM + ROOM_THREAD * threads + ROOM_TRIANGLE * (world->index_count / 3);
    struct rlimit space;
    if (getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur == RLIM_INFINITY)
        return true;
    void *memory = mmap(NULL, room, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return memory != MAP_FAILED && munmap(memory, room) == 0;
}

trace_bvh *trace_create(const scene *world) {
    trace_bvh *bvh = calloc(1, sizeof *bvh);
    if (bvh && has_room(world) && build(bvh, world))
        return bvh;
    trace_destroy(bvh);
    return NULL;
}

void trace_destroy(trace_bvh *bvh) {
    if (!bvh)
        return;
    if (bvh->rays)
        rtcReleaseScene(bvh->rays);
    if (bvh->device)
        rtcReleaseDevice(bvh->device);
    free(bvh->meshes);
    free(bvh);
}

/* --- rays ------------------------------------------------------------------------------------- */

static void set_context(const trace_bvh *bvh, trace_kind kind, trace_context *context) {
    rtcInitIntersectContext(&context->embree);
    context->bvh = bvh;
    context->kind = kind;
    if (kind == TRACE_CAMERA) {
        context->embree.filter = pass_backs;
        context->embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    }
}

trace_hit trace_nearest(const trace_bvh *bvh, trace_kind kind, const float origin[3],
                        const float direction[3]) {
    trace_context context;
    struct RTCRayHit query = {
        .ray = { .org_x = origin[0],
                 .org_y = origin[1],
                 .org_z = origin[2],
                 .tnear = 0,
                 .dir_x = direction[0],
                 .dir_y = direction[1],
                 .dir_z = direction[2],
                 .tfar = INFINITY,
                 .mask = ~0u },
        .hit = { .geomID = RTC_INVALID_GEOMETRY_ID },
    };
    set_context(bvh, kind, &context);
    rtcIntersect1(bvh->rays, &context.embree, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return (trace_hit) { .distance = INFINITY, .mesh = TRACE_NOTHING };
    return (trace_hit) { query.ray.tfar, query.hit.geomID, query.hit.primID, query.hit.u,
                         query.hit.v };
}

/* Embree's own order of the same, and which of them are rays. */
static void set_rays(const trace_rays *rays, struct RTCRay16 *packet, int valid[TRACE_LANES]) {
    for (int i = 0; i < TRACE_LANES; i++) {
        valid[i] = rays->length[i] >= 0 ? -1 : 0;
        packet->org_x[i] = rays->origin[0][i];
        packet->org_y[i] = rays->origin[1][i];
        packet->org_z[i] = rays->origin[2][i];
        packet->dir_x[i] = rays->direction[0][i];
        packet->dir_y[i] = rays->direction[1][i];
        packet->dir_z[i] = rays->direction[2][i];
        packet->tnear[i] = packet->time[i] = 0;
        packet->tfar[i] = rays->length[i];
        packet->mask[i] = ~0u;
        packet->id[i] = packet->flags[i] = 0;
    }
}

void trace_nearest_n(const trace_bvh *bvh, trace_kind kind, const trace_rays *rays,
                     trace_hit hits[TRACE_LANES]) {
    trace_context context;
    struct RTCRayHit16 query;
    _Alignas(64) int valid[TRACE_LANES];
    set_rays(rays, &query.ray, valid);
    for (int i = 0; i < TRACE_LANES; i++)
        query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    set_context(bvh, kind, &context);
    rtcIntersect16(valid, bvh->rays, &context.embree, &query);
    for (int i = 0; i < TRACE_LANES; i++)
        hits[i] = query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                      ? (trace_hit) { .distance = INFINITY, .mesh = TRACE_NOTHING }
                      : (trace_hit) { query.ray.tfar[i], query.hit.geomID[i], query.hit.primID[i],
                                      query.hit.u[i], query.hit.v[i] };
}

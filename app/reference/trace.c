/* SPDX-License-Identifier: MIT */
#include "app/reference/trace.h"

#include "app/reference/texture.h"

#include <embree3/rtcore.h>
#include <stdlib.h>
#include <string.h>

/* One Embree geometry a mesh. */
typedef struct tracer_mesh {
    const scene *scene;
    const scene_mesh *mesh;
    const scene_material *material;
} tracer_mesh;

struct reference_tracer {
    const scene *scene;
    tracer_mesh *meshes;
    RTCDevice device;
    RTCScene rays;
    double lift; /* of ray origins off their surface, against rounding */
};

/* Embree hands the context it was called with to the filter. */
typedef struct tracer_context {
    struct RTCIntersectContext embree;
    bool sees; /* a camera's ray */
} tracer_context;

/* The three vertices of a triangle and where on it a hit lies. */
typedef struct corner_weights {
    const scene_vertex *vertices[3];
    double weights[3];
} corner_weights;

static corner_weights corners(const tracer_mesh *mesh, uint32_t triangle, float u, float v) {
    const scene *world = mesh->scene;
    const uint32_t *index = world->indices + mesh->mesh->first_index + 3 * (size_t)triangle;
    return (corner_weights) { { &world->vertices[index[0]], &world->vertices[index[1]],
                                &world->vertices[index[2]] },
                              { 1 - (double)u - (double)v, (double)u, (double)v } };
}

/* Σ weight * the three floats at `offset` bytes in each vertex. */
static reference_vec blend(const corner_weights *c, size_t offset) {
    reference_vec sum = { 0, 0, 0 };
    for (int i = 0; i < 3; i++) {
        const float *v = (const float *)((const char *)c->vertices[i] + offset);
        sum = reference_add(sum, reference_scale(c->weights[i], reference_from_floats(v)));
    }
    return sum;
}

static void blend_uv(const corner_weights *c, double uv[4]) {
    memset(uv, 0, 4 * sizeof *uv);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 4; k++)
            uv[k] += c->weights[i] * (double)c->vertices[i]->uv[k / 2][k % 2];
}

static void blend_color(const corner_weights *c, const scene_material *material, double color[4]) {
    for (int k = 0; k < 4; k++)
        color[k] = material->flags & SCENE_VERTEX_COLORS ? 0 : 1;
    for (int i = 0; i < 3 && (material->flags & SCENE_VERTEX_COLORS); i++)
        for (int k = 0; k < 4; k++)
            color[k] += c->weights[i] * (double)c->vertices[i]->color[k] / 65535;
}

/* Normal of the face that is counter-clockwise to its viewer; not unit. */
static reference_vec face_normal(const corner_weights *c) {
    const reference_vec p = reference_from_floats(c->vertices[0]->position);
    return reference_cross(reference_subtract(reference_from_floats(c->vertices[1]->position), p),
                           reference_subtract(reference_from_floats(c->vertices[2]->position), p));
}

static bool cut_out(const tracer_mesh *mesh, const corner_weights *c) {
    const scene_material *material = mesh->material;
    double uv[4], rgba[4], color[4];
    if (!(material->flags & SCENE_ALPHA_MASK))
        return false;
    blend_uv(c, uv);
    blend_color(c, material, color);
    reference_texture_at(mesh->scene, &material->base_color_map,
                         uv + 2 * material->base_color_map.set, rgba);
    return rgba[3] * color[3] * (double)material->base_color[3] < (double)material->alpha_cutoff;
}

static void filter(const struct RTCFilterFunctionNArguments *arguments) {
    const tracer_context *context = (const tracer_context *)(const void *)arguments->context;
    const tracer_mesh *mesh = arguments->geometryUserPtr;
    const struct RTCRay *ray = (const struct RTCRay *)(const void *)arguments->ray;
    const struct RTCHit *hit = (const struct RTCHit *)(const void *)arguments->hit;
    const corner_weights c = corners(mesh, hit->primID, hit->u, hit->v);
    if (context->sees && !(mesh->material->flags & SCENE_DOUBLE_SIDED)) {
        const float along[3] = { ray->dir_x, ray->dir_y, ray->dir_z };
        if (reference_dot(face_normal(&c), reference_from_floats(along)) >= 0)
            arguments->valid[0] = 0;
    }
    if (cut_out(mesh, &c))
        arguments->valid[0] = 0;
}

static bool add_mesh(reference_tracer *tracer, size_t number) {
    const scene *world = tracer->scene;
    tracer_mesh *mesh = &tracer->meshes[number];
    RTCGeometry geometry = rtcNewGeometry(tracer->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    mesh->scene = world;
    mesh->mesh = &world->meshes[number];
    mesh->material = &world->materials[mesh->mesh->material];
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               world->vertices, 0, sizeof *world->vertices, world->vertex_count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, world->indices,
                               mesh->mesh->first_index * sizeof *world->indices,
                               3 * sizeof *world->indices, mesh->mesh->index_count / 3);
    rtcSetGeometryUserData(geometry, mesh);
    rtcSetGeometryIntersectFilterFunction(geometry, filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(tracer->rays, geometry, (unsigned)number);
    rtcReleaseGeometry(geometry);
    return rtcGetDeviceError(tracer->device) == RTC_ERROR_NONE;
}

bool reference_tracer_create(const scene *world, reference_tracer **tracer, cli_error *error) {
    reference_tracer *t = *tracer = calloc(1, sizeof *t);
    bool ok = t && (t->meshes = calloc(world->mesh_count + 1, sizeof *t->meshes));
    double size = 0;
    if (ok) {
        t->scene = world;
        t->device = rtcNewDevice(NULL);
        ok = t->device && (t->rays = rtcNewScene(t->device));
    }
    if (ok)
        rtcSetSceneFlags(t->rays, RTC_SCENE_FLAG_ROBUST);
    for (size_t i = 0; ok && i < world->mesh_count; i++)
        ok = add_mesh(t, i);
    if (ok) {
        rtcCommitScene(t->rays);
        ok = rtcGetDeviceError(t->device) == RTC_ERROR_NONE;
    }
    if (!ok) {
        reference_tracer_destroy(t);
        *tracer = NULL;
        return cli_fail(error, world->origin,
                        "cannot be prepared for ray tracing (out of memory?)");
    }
    for (int i = 0; i < 3; i++)
        size = fmax(size, fmax(fabs((double)world->minimum[i]), fabs((double)world->maximum[i])));
    t->lift = 1e-5 * size;
    return true;
}

void reference_tracer_destroy(reference_tracer *tracer) {
    if (!tracer)
        return;
    if (tracer->rays)
        rtcReleaseScene(tracer->rays);
    if (tracer->device)
        rtcReleaseDevice(tracer->device);
    free(tracer->meshes);
    free(tracer);
}

static struct RTCRayHit cast(const reference_tracer *tracer, reference_vec origin,
                             reference_vec direction, bool sees) {
    tracer_context context = { .sees = sees };
    struct RTCRayHit query = {
        .ray = { .org_x = (float)origin.x,
                 .org_y = (float)origin.y,
                 .org_z = (float)origin.z,
                 .tnear = 0,
                 .dir_x = (float)direction.x,
                 .dir_y = (float)direction.y,
                 .dir_z = (float)direction.z,
                 .tfar = INFINITY,
                 .mask = ~0u },
        .hit = { .geomID = RTC_INVALID_GEOMETRY_ID },
    };
    rtcInitIntersectContext(&context.embree);
    rtcIntersect1(tracer->rays, &context.embree, &query);
    return query;
}

reference_hit reference_tracer_see(const reference_tracer *tracer, reference_vec origin,
                                   reference_vec direction) {
    const struct RTCRayHit query = cast(tracer, origin, direction, true);
    reference_hit hit = { .distance = (double)INFINITY };
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return hit;
    const tracer_mesh *mesh = &tracer->meshes[query.hit.geomID];
    const corner_weights c = corners(mesh, query.hit.primID, query.hit.u, query.hit.v);
    const reference_vec face = reference_normalize(face_normal(&c));
    const double side = reference_dot(face, direction) > 0 ? -1 : 1;
    hit.position = blend(&c, offsetof(scene_vertex, position));
    hit.distance = reference_length(reference_subtract(hit.position, origin));
    hit.ray_origin = reference_add(hit.position, reference_scale(side * tracer->lift, face));
    hit.normal =
        reference_scale(side, reference_normalize(blend(&c, offsetof(scene_vertex, normal))));
    hit.tangent = reference_normalize(blend(&c, offsetof(scene_vertex, tangent)));
    hit.handedness = (double)c.vertices[0]->tangent[3];
    blend_uv(&c, hit.uv);
    blend_color(&c, mesh->material, hit.color);
    hit.material = mesh->mesh->material;
    return hit;
}

double reference_tracer_free_path(reference_vec point, reference_vec direction, void *user) {
    const reference_tracer *tracer = user;
    const struct RTCRayHit query = cast(tracer, point, direction, false);
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? (double)INFINITY : (double)query.ray.tfar;
}

/* SPDX-License-Identifier: MIT */
#include "app/trace/tree.h"

#include "app/trace/embree.h"

#include <math.h>
#include <stdlib.h>

/* Widened, so that the tree's rounding drops no triangle that the test would hit. */
static void find_bounds(const struct RTCBoundsFunctionArguments *a) {
    embree_enter();
    const trace_mesh *mesh = a->geometryUserPtr;
    const scene *world = mesh->bvh->scene;
    const uint32_t *index = world->indices + mesh->mesh->first_index + 3 * (size_t)a->primID;
    const float *corners[3];
    float moved[3][3], minimum[3], maximum[3];
    for (int i = 0; i < 3; i++)
        corners[i] = world->vertices[index[i]].position;
    if (!mesh->tree)
        tree_corners(mesh->bvh, &mesh->bvh->instances[mesh->instance], a->primID, moved, corners);
    for (int k = 0; k < 3; k++) {
        minimum[k] = fminf(corners[0][k], fminf(corners[1][k], corners[2][k]));
        maximum[k] = fmaxf(corners[0][k], fmaxf(corners[1][k], corners[2][k]));
    }
    const float margin = mesh->margin;
    *a->bounds_o = (struct RTCBounds) {
        .lower_x = minimum[0] - margin,
        .lower_y = minimum[1] - margin,
        .lower_z = minimum[2] - margin,
        .upper_x = maximum[0] + margin,
        .upper_y = maximum[1] + margin,
        .upper_z = maximum[2] + margin,
    };
    embree_leave();
}

static bool attach(RTCDevice device, RTCScene tree, RTCGeometry geometry, unsigned number) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(tree, geometry, number);
    rtcReleaseGeometry(geometry);
    return rtcGetDeviceError(device) == RTC_ERROR_NONE;
}

static bool add_triangles(const trace_bvh *bvh, trace_mesh *mesh, RTCScene tree, unsigned number) {
    RTCGeometry geometry = rtcNewGeometry(bvh->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, mesh->mesh->index_count / 3);
    rtcSetGeometryUserData(geometry, mesh);
    rtcSetGeometryBoundsFunction(geometry, find_bounds, NULL);
    rtcSetGeometryIntersectFunction(geometry, bvh->test);
    return attach(bvh->device, tree, geometry, number);
}

static bool add_tree(const trace_bvh *bvh, trace_mesh *mesh) {
    mesh->tree = rtcNewScene(bvh->device);
    if (!mesh->tree)
        return false;
    rtcSetSceneFlags(mesh->tree, RTC_SCENE_FLAG_ROBUST);
    if (!add_triangles(bvh, mesh, mesh->tree, 0))
        return false;
    embree_commit(mesh->tree);
    return rtcGetDeviceError(bvh->device) == RTC_ERROR_NONE;
}

static bool add_instance(const trace_bvh *bvh, size_t number) {
    const scene_instance *placed = bvh->instances[number].placed;
    trace_mesh *mesh = &bvh->meshes[placed->mesh];
    if (mesh->uses == 1)
        return add_triangles(bvh, mesh, bvh->rays, (unsigned)number);
    if (!mesh->tree && !add_tree(bvh, mesh))
        return false;
    RTCGeometry geometry = rtcNewGeometry(bvh->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, mesh->tree);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, placed->world_from_mesh);
    return attach(bvh->device, bvh->rays, geometry, (unsigned)number);
}

/* How long a length of the world may be in the space of the mesh: at most by the norm of the
 * inverse, whose rows are cofactors over the determinant. */
static float stretch(const scene_instance *instance) {
    double m[3][3], square = 0, determinant = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            m[i][k] = (double)instance->world_from_mesh[i][k];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            const double cofactor = m[i1][k1] * m[i2][k2] - m[i1][k2] * m[i2][k1];
            square += cofactor * cofactor;
            determinant += i == 0 ? m[0][k] * cofactor : 0;
        }
    return (float)(sqrt(square) / fabs(determinant));
}

static void set_instances(trace_bvh *bvh) {
    const scene *world = bvh->scene;
    const float margin = (float)trace_lift(world);
    for (size_t i = 0; i < world->mesh_count; i++)
        bvh->meshes[i] = (trace_mesh) { .bvh = bvh, .mesh = &world->meshes[i] };
    for (size_t i = 0; i < world->instance_count; i++) {
        const scene_instance *placed = &world->instances[i];
        trace_mesh *mesh = &bvh->meshes[placed->mesh];
        bvh->instances[i] = (trace_instance) { .placed = placed,
                                               .indices = world->indices + mesh->mesh->first_index,
                                               .material = &world->materials[mesh->mesh->material],
                                               .moves = !scene_instance_is_identity(placed),
                                               .mirrors = scene_instance_mirrors(placed) };
        mesh->margin = mesh->uses > 0 ? fmaxf(mesh->margin, margin * stretch(placed)) : margin;
        if (++mesh->uses == 2)
            mesh->margin = fmaxf(margin * stretch(&world->instances[mesh->instance]),
                                 margin * stretch(placed));
        mesh->instance = (uint32_t)i;
    }
}

bool tree_build(trace_bvh *bvh, const scene *world, RTCIntersectFunctionN test) {
    bvh->test = test;
    bvh->scene = world;
    bvh->meshes = calloc(world->mesh_count + 1, sizeof *bvh->meshes);
    bvh->instances = calloc(world->instance_count + 1, sizeof *bvh->instances);
    bvh->device = embree_device_create();
    if (!bvh->meshes || !bvh->instances || !bvh->device || !(bvh->rays = rtcNewScene(bvh->device)))
        return false;
    set_instances(bvh);
    rtcSetSceneFlags(bvh->rays, RTC_SCENE_FLAG_ROBUST);
    for (size_t i = 0; i < world->instance_count; i++)
        if (!add_instance(bvh, i))
            return false;
    embree_commit(bvh->rays);
    return rtcGetDeviceError(bvh->device) == RTC_ERROR_NONE;
}

void tree_free(trace_bvh *bvh) {
    if (bvh->rays)
        rtcReleaseScene(bvh->rays);
    for (size_t i = 0; bvh->meshes && bvh->scene && i < bvh->scene->mesh_count; i++)
        if (bvh->meshes[i].tree)
            rtcReleaseScene(bvh->meshes[i].tree);
    if (bvh->device)
        rtcReleaseDevice(bvh->device);
    free(bvh->instances);
    free(bvh->meshes);
}

/* SPDX-License-Identifier: MIT */
#include "app/scene/trace/tree.h"

#include "app/base/memory.h"
#include "app/scene/trace/embree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct box {
    float minimum[3], maximum[3];
} box;

static box bounds_of(const trace_corner_set *triangles, uint32_t count) {
    box b = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    for (uint32_t t = 0; t < count; t++)
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) {
                const float x = triangles[t].of[i][k]; /* fminf would be a call, for NaN */
                b.minimum[k] = x < b.minimum[k] ? x : b.minimum[k];
                b.maximum[k] = x > b.maximum[k] ? x : b.maximum[k];
            }
    return b;
}

/* Finds a group's bounds, widened so that the tree's rounding drops no triangle that the test would
 * hit. */
static void find_bounds(const struct RTCBoundsFunctionArguments *a) {
    embree_enter();
    const trace_mesh *mesh = a->geometryUserPtr;
    const uint32_t first = mesh->groups[a->primID], end = mesh->groups[a->primID + 1];
    const box b = bounds_of(&mesh->corners[first], end - first);
    const float margin = mesh->margin;
    *a->bounds_o = (struct RTCBounds) {
        .lower_x = b.minimum[0] - margin,
        .lower_y = b.minimum[1] - margin,
        .lower_z = b.minimum[2] - margin,
        .upper_x = b.maximum[0] + margin,
        .upper_y = b.maximum[1] + margin,
        .upper_z = b.maximum[2] + margin,
    };
    embree_leave();
}

/* --- groups ----------------------------------------------------------------------------------- */

static float area_of(const box *b) {
    const float x = b->maximum[0] - b->minimum[0], y = b->maximum[1] - b->minimum[1];
    const float z = b->maximum[2] - b->minimum[2];
    return x * y + y * z + z * x;
}

/* Returns the cost of a group by the surface area heuristic; reaching it costs about as much as a
 * test. */
static float cost_of(const trace_corner_set *triangles, uint32_t count) {
    const box b = bounds_of(triangles, count);
    return area_of(&b) * (float)(1 + count);
}

/* Divides a mesh into groups: a triangle joins the group before it where that costs less. */
static void set_groups(trace_mesh *mesh) {
    const uint32_t count = mesh->mesh->index_count / 3;
    mesh->group_count = 0;
    for (uint32_t first = 0, end; first < count; first = end) {
        float cost = cost_of(&mesh->corners[first], 1);
        for (end = first + 1; end < count && end < first + TREE_GROUP; end++) {
            const float joined = cost_of(&mesh->corners[first], end + 1 - first);
            if (!(joined <= cost + cost_of(&mesh->corners[end], 1)))
                break;
            cost = joined;
        }
        mesh->groups[mesh->group_count++] = first;
    }
    mesh->groups[mesh->group_count] = count;
}

/* --- geometries ------------------------------------------------------------------------------- */

static bool attach(RTCDevice device, RTCScene tree, RTCGeometry geometry, unsigned number) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(tree, geometry, number);
    rtcReleaseGeometry(geometry);
    return rtcGetDeviceError(device) == RTC_ERROR_NONE;
}

static bool add_triangles(const trace_bvh *bvh, trace_mesh *mesh, RTCScene tree, unsigned number) {
    RTCGeometry geometry = rtcNewGeometry(bvh->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, mesh->group_count);
    rtcSetGeometryUserData(geometry, mesh);
    rtcSetGeometryBoundsFunction(geometry, find_bounds, NULL);
    rtcSetGeometryIntersectFunction(geometry, bvh->intersect);
    rtcSetGeometryOccludedFunction(geometry, bvh->occlude);
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

/* Returns how much longer a length of the world may be in the space of the mesh: at most by the
 * norm of the inverse, whose rows are cofactors over the determinant. */
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
        bvh->instances[i] =
            (trace_instance) { .placed = placed,
                               .material = &world->materials[mesh->mesh->material] };
        mesh->margin = mesh->uses > 0 ? fmaxf(mesh->margin, margin * stretch(placed)) : margin;
        if (++mesh->uses == 2)
            mesh->margin = fmaxf(margin * stretch(&world->instances[mesh->instance]),
                                 margin * stretch(placed));
        mesh->instance = (uint32_t)i;
    }
}

/* Sets the corners of a mesh: as scene_triangle_positions computes them if one instance has the
 * mesh, else in the mesh's own space. */
static void set_corners(const scene *world, const trace_mesh *mesh) {
    const uint32_t *index = world->indices + mesh->mesh->first_index;
    for (uint32_t t = 0; t < mesh->mesh->index_count / 3; t++)
        if (mesh->uses == 1)
            scene_triangle_positions(world, mesh->instance, t, mesh->corners[t].of);
        else
            for (int i = 0; i < 3; i++)
                memcpy(mesh->corners[t].of[i],
                       world->vertices[index[3 * (size_t)t + (size_t)i]].position,
                       sizeof mesh->corners[t].of[i]);
}

static bool make_corners(trace_bvh *bvh) {
    const scene *world = bvh->scene;
    size_t count = 0;
    for (size_t i = 0; i < world->mesh_count; i++)
        count += world->meshes[i].index_count / 3;
    trace_corner_set *next = bvh->corners = memory_large((count + 1) * sizeof *bvh->corners);
    uint32_t *groups = bvh->groups = malloc((count + world->mesh_count + 1) * sizeof *bvh->groups);
    if (!next || !groups)
        return false;
    for (size_t i = 0; i < world->mesh_count; i++) {
        bvh->meshes[i].corners = next;
        bvh->meshes[i].groups = groups;
        next += world->meshes[i].index_count / 3;
        groups += world->meshes[i].index_count / 3 + 1;
    }
#pragma omp parallel for schedule(dynamic, 16)
    for (size_t i = 0; i < world->mesh_count; i++) {
        set_corners(world, &bvh->meshes[i]);
        set_groups(&bvh->meshes[i]);
    }
    for (size_t i = 0; i < world->instance_count; i++) {
        trace_instance *instance = &bvh->instances[i];
        const trace_mesh *mesh = &bvh->meshes[instance->placed->mesh];
        instance->corners = mesh->corners;
        instance->groups = mesh->groups;
        instance->moves = mesh->uses > 1 && !scene_instance_is_identity(instance->placed);
        instance->mirrors = mesh->uses > 1 && scene_instance_mirrors(instance->placed);
    }
    return true;
}

bool tree_build(trace_bvh *bvh, const scene *world, RTCIntersectFunctionN intersect,
                RTCOccludedFunctionN occlude) {
    bvh->intersect = intersect;
    bvh->occlude = occlude;
    bvh->scene = world;
    bvh->meshes = calloc(world->mesh_count + 1, sizeof *bvh->meshes);
    bvh->instances = calloc(world->instance_count + 1, sizeof *bvh->instances);
    bvh->device = embree_device_create();
    if (!bvh->meshes || !bvh->instances || !bvh->device || !(bvh->rays = rtcNewScene(bvh->device)))
        return false;
    set_instances(bvh);
    if (!make_corners(bvh))
        return false;
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
    free(bvh->groups);
    free(bvh->corners);
    free(bvh->instances);
    free(bvh->meshes);
}

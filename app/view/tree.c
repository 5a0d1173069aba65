/* SPDX-License-Identifier: MIT */
#include "app/view/tree.h"
#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <omp.h>
#include <pthread.h>
#include <stdlib.h>

struct view_tree {
    const scene *scene;
    trace_bvh *bvh;
    pthread_t builder;
    bool building; /* whether the builder has not been joined */
    pthread_mutex_t joining;
};

static void *build(void *user) {
    view_tree *tree = user;
    tree->bvh = trace_create(tree->scene);
    return NULL;
}

view_tree *view_tree_begin(const scene *world, base_error *error) {
    view_tree *tree = calloc(1, sizeof *tree);
    if (!tree) {
        base_fail(error, world->name, "out of memory");
        return NULL;
    }
    tree->scene = world;
    pthread_mutex_init(&tree->joining, NULL);
    /* LLVM's OpenMP takes the first thread that calls it for the initial one; were that the
     * builder, its end would be that of all locks. */
    omp_get_max_threads();
    tree->building = pthread_create(&tree->builder, NULL, build, tree) == 0;
    if (!tree->building)
        build(tree);
    return tree;
}

bool view_tree_is_built(view_tree *tree) {
    if (pthread_mutex_trylock(&tree->joining) != 0)
        return false; /* another thread waits for it */
    if (tree->building && pthread_tryjoin_np(tree->builder, NULL) == 0)
        tree->building = false;
    const bool built = !tree->building;
    pthread_mutex_unlock(&tree->joining);
    return built;
}

const trace_bvh *view_tree_wait(view_tree *tree) {
    pthread_mutex_lock(&tree->joining);
    if (tree->building)
        pthread_join(tree->builder, NULL);
    tree->building = false;
    pthread_mutex_unlock(&tree->joining);
    return tree->bvh;
}

void view_tree_end(view_tree *tree) {
    if (!tree)
        return;
    view_tree_wait(tree);
    pthread_mutex_destroy(&tree->joining);
    trace_destroy(tree->bvh);
    free(tree);
}

/* --- picking ---------------------------------------------------------------------------------- */

/* A surface that blends is picked where it hides more than it shows. */
#define HIDING_ALPHA 0.5
enum { LAYERS_MAX = 64 };

static bool is_seen_through(const scene *world, const trace_hit *hit) {
    const scene_material *material =
        &world->materials[scene_instance_material(world, hit->instance)];
    return material->flags & SCENE_ALPHA_BLEND && trace_alpha(world, hit) < HIDING_ALPHA;
}

static trace_hit trace(const view_ray *ray, const trace_bvh *bvh, const scene *world) {
    const float from[3] = { ray->from.x, ray->from.y, ray->from.z };
    const float along[3] = { ray->direction.x, ray->direction.y, ray->direction.z };
    trace_rays rays = { .start = { ray->near } };
    trace_hit hits[TRACE_LANES] = { trace_miss() };
    for (int lane = 0; lane < TRACE_LANES; lane++) {
        rays.length[lane] = lane == 0 ? ray->far : -1;
        for (int k = 0; k < 3; k++) {
            rays.origin[k][lane] = from[k];
            rays.direction[k][lane] = along[k];
        }
    }
    for (int layer = 0; layer < LAYERS_MAX; layer++) {
        trace_nearest_n(bvh, TRACE_CAMERA, &rays, hits);
        if (hits[0].instance == TRACE_NOTHING || !is_seen_through(world, &hits[0]))
            break;
        rays.start[0] = hits[0].distance;
    }
    return hits[0];
}

static lmp_vec3 facing(lmp_vec3 v, lmp_vec3 side) {
    return vec_dot(v, side) < 0 ? vec_scale(v, -1) : v;
}

view_hit view_pick_surface(const view_ray *ray, view_tree *tree) {
    view_hit picked = { .mesh = -1, .instance = -1, .distance = INFINITY };
    const trace_bvh *bvh = view_tree_wait(tree);
    const trace_hit hit = bvh ? trace(ray, bvh, tree->scene) : trace_miss();
    if (hit.instance == TRACE_NOTHING)
        return picked;
    scene_vertex corners[3];
    double weights[3];
    trace_corners(tree->scene, &hit, corners, weights);
    const lmp_vec3 p = vec_load(corners[0].position), back = vec_scale(ray->direction, -1);
    const lmp_vec3 normal = vec_cross(vec_sub(vec_load(corners[1].position), p),
                                      vec_sub(vec_load(corners[2].position), p));
    lmp_vec3 smooth = { 0, 0, 0 };
    for (int i = 0; i < 3; i++)
        smooth = vec_add(smooth, vec_scale(vec_load(corners[i].normal), (float)weights[i]));
    picked.mesh = (int)tree->scene->instances[hit.instance].mesh;
    picked.instance = (long)hit.instance;
    picked.distance = hit.distance;
    picked.point = vec_add(ray->from, vec_scale(ray->direction, hit.distance));
    picked.normal = facing(vec_normalize(normal, back), back);
    picked.smooth = facing(vec_normalize(smooth, picked.normal), picked.normal);
    return picked;
}

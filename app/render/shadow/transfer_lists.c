/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer_lists.h"

#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <stdlib.h>

/* How much the normals of a surface may differ where a ray hits it, and where links are read. */
static const float hit_cosine = 0.3f, link_cosine = 0.8f;

/* How many surfels near a point are tried, until it sees one. */
enum { TRIED_MAX = 12 };

/* Rays along a surface start and end off it, because it may be curved: by so many spacings, and by
 * so much of their length, which is the sag of a circle whose radius is their length. */
static const float off_surface = 0.02f, sag = 0.13f;

/* --- rays ------------------------------------------------------------------------------------- */

/* Returns direction k from a surfel, distributed as the cosine. */
static lmp_vec3 direction_of(const lmp_transfer_surfel *surfel, size_t index, size_t k) {
    double xy[2];
    transfer_sequence((double)k, (double)index, xy);
    const float u = (float)(xy[0] - floor(xy[0]));
    const double azimuth = 2 * M_PI * xy[1];
    const lmp_vec3 a = vec_across(surfel->normal), b = vec_cross(surfel->normal, a);
    const lmp_vec3 flat =
        vec_add(vec_scale(a, (float)cos(azimuth)), vec_scale(b, (float)sin(azimuth)));
    return vec_add(vec_scale(flat, sqrtf(u)), vec_scale(surfel->normal, sqrtf(1 - u)));
}

/* What a ray meets: a surface by its front, or what shines on nothing. */
typedef struct met {
    float distance; /* INFINITY: nothing */
    bool front;
    lmp_vec3 normal; /* towards the ray's start */
} met;

static met meet(const scene *world, const trace_bvh *bvh, lmp_vec3 from, lmp_vec3 direction) {
    const float origin[3] = { from.x, from.y, from.z };
    const float along[3] = { direction.x, direction.y, direction.z };
    const trace_hit hit = trace_nearest(bvh, TRACE_LIGHT, origin, along);
    float corners[3][3];
    met found = { .distance = INFINITY };
    if (hit.instance == TRACE_NOTHING)
        return found;
    const uint32_t material = scene_instance_material(world, hit.instance);
    scene_triangle_positions(world, hit.instance, hit.triangle, corners);
    transfer_face(corners, &found.normal);
    found.distance = hit.distance;
    found.front = vec_dot(found.normal, direction) <= 0;
    if (!found.front) {
        found.front = world->materials[material].flags & SCENE_DOUBLE_SIDED;
        found.normal = vec_scale(found.normal, -1);
    }
    return found;
}

static lmp_vec3 start_of(const scene *world, const lmp_transfer_surfel *surfel) {
    return vec_add(surfel->position, vec_scale(surfel->normal, (float)trace_lift(world)));
}

bool transfer_is_buried(const scene *world, const trace_bvh *bvh, const lmp_transfer_surfel *surfel,
                        size_t index, float least) {
    enum { RAYS = 16 };
    const lmp_vec3 from = start_of(world, surfel);
    int backs = 0;
    if (!(meet(world, bvh, from, surfel->normal).distance >= least))
        return true;
    for (size_t k = 0; k < RAYS; k++) {
        const met found = meet(world, bvh, from, direction_of(surfel, index, k));
        backs += isfinite(found.distance) && !found.front;
    }
    return backs > RAYS / 2;
}

float transfer_distance(const scene *world, const trace_bvh *bvh, const lmp_transfer_surfel *surfel,
                        size_t index) {
    enum { RAYS = 4 };
    const lmp_vec3 from = start_of(world, surfel);
    float inverse = 0;
    for (size_t k = 0; k < RAYS; k++)
        inverse += 1 / meet(world, bvh, from, direction_of(surfel, index, k)).distance;
    return RAYS / inverse;
}

void transfer_drop_buried(const scene *world, const trace_bvh *bvh, transfer_surfels *surfels) {
    const float least = 2 * off_surface * surfels->spacing;
    size_t count = 0;
    for (size_t i = 0; i < surfels->count; i++)
        if (!transfer_is_buried(world, bvh, &surfels->at[i], i, least))
            surfels->at[count++] = surfels->at[i];
    surfels->count = count;
}

/* Whether nothing stands between a point of a surface and a surfel. */
static bool sees(const transfer_view *view, lmp_vec3 point, lmp_vec3 normal, uint32_t surfel) {
    const lmp_transfer_surfel *to = &view->cells->surfels->at[surfel];
    const float distance = vec_length(vec_sub(to->position, point));
    const float off = off_surface * view->cells->surfels->spacing + sag * distance;
    const lmp_vec3 from = vec_add(point, vec_scale(normal, off));
    const lmp_vec3 way = vec_sub(vec_add(to->position, vec_scale(to->normal, off)), from);
    const float origin[3] = { from.x, from.y, from.z }, along[3] = { way.x, way.y, way.z };
    return !trace_occluded(view->bvh, origin, along, 1);
}

/* Returns the first of the nearest surfels, from number `first` on, that is seen from a point, or
 * else the nearest, because curved surfaces hide parts of themselves. */
static uint32_t find_seen(const transfer_view *view, lmp_vec3 point, lmp_vec3 normal, float cosine,
                          size_t first) {
    uint32_t found[TRIED_MAX];
    const size_t count = transfer_cells_find(view->cells, point, normal, cosine, TRIED_MAX, found);
    for (size_t i = first; i < count; i++)
        if (sees(view, point, normal, found[i]))
            return found[i];
    return count > 0 ? found[0] : LMP_TRANSFER_NONE;
}

uint32_t transfer_nearest(const transfer_view *view, lmp_vec3 point, lmp_vec3 normal) {
    uint32_t nearest;
    if (transfer_cells_find(view->cells, point, normal, hit_cosine, 1, &nearest) == 0)
        return find_seen(view, point, normal, -1, 0);
    return sees(view, point, normal, nearest) ? nearest
                                              : find_seen(view, point, normal, hit_cosine, 1);
}

uint32_t transfer_source(const transfer_view *view, lmp_vec3 from, lmp_vec3 direction) {
    const met found = meet(view->scene, view->bvh, from, direction);
    if (!found.front)
        return LMP_TRANSFER_NONE;
    const lmp_vec3 at = vec_add(from, vec_scale(direction, found.distance));
    return transfer_nearest(view, at, found.normal);
}

/* --- lists ------------------------------------------------------------------------------------ */

static void fill_hits(const transfer_task *task, size_t index, uint32_t *hits) {
    const lmp_transfer_surfel *surfel = &task->from->cells->surfels->at[index];
    const lmp_vec3 from = start_of(task->from->scene, surfel);
    for (size_t k = 0; k < task->rays; k++) {
        const uint32_t source = transfer_source(task->to, from, direction_of(surfel, index, k));
        hits[k] = source == LMP_TRANSFER_NONE ? source : (uint32_t)task->first + source;
    }
}

static void fill_links(const transfer_view *view, size_t index, uint32_t *links) {
    const lmp_transfer_surfel *surfel = &view->cells->surfels->at[index];
    uint32_t found[TRANSFER_LINKS + 1];
    const size_t near = transfer_cells_find(view->cells, surfel->position, surfel->normal,
                                            link_cosine, TRANSFER_LINKS + 1, found);
    size_t count = 0;
    for (size_t i = 0; i < near && count < TRANSFER_LINKS; i++)
        if (found[i] != index && sees(view, surfel->position, surfel->normal, found[i]))
            links[count++] = found[i];
    while (count < TRANSFER_LINKS)
        links[count++] = LMP_TRANSFER_NONE;
}

bool transfer_lists_create(const transfer_task *task, const lmp_host *host, transfer_lists *lists) {
    enum { TOGETHER = 64 };
    const transfer_view *view = task->from;
    const size_t count = view->cells->surfels->count;
    const ptrdiff_t groups = (ptrdiff_t)((count + TOGETHER - 1) / TOGETHER);
    ptrdiff_t done = 0;
    lists->hits = malloc((count * task->rays + 1) * sizeof *lists->hits);
    lists->links = malloc((count * TRANSFER_LINKS + 1) * sizeof *lists->links);
    if (!lists->hits || !lists->links)
        return false;
#pragma omp parallel for schedule(dynamic)
    for (ptrdiff_t group = 0; group < groups; group++) {
        for (size_t i = (size_t)group * TOGETHER; i < count && i < (size_t)(group + 1) * TOGETHER;
             i++) {
            fill_hits(task, i, lists->hits + i * task->rays);
            fill_links(view, i, lists->links + i * TRANSFER_LINKS);
        }
#pragma omp critical
        host->progress(task->begin + (task->end - task->begin) * (double)++done / (double)groups,
                       host->user);
    }
    return true;
}

void transfer_lists_free(transfer_lists *lists) {
    free(lists->hits);
    free(lists->links);
    *lists = (transfer_lists) { NULL, NULL };
}

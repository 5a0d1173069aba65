/* SPDX-License-Identifier: MIT */
#include "app/scene/subject.h"

#include "app/scene/instance.h"
#include "app/scene/joined.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

#define SUBJECT_PART  0.02f /* fraction of a scene that a model in wide surroundings has at most */
#define PLANE_PART    0.1f  /* the same where these are a plane */
#define PLANE_HEIGHT  5e-3f /* fraction of the size of a plane that is its height at most */
#define GROUND_HEIGHT 0.1f  /* fraction of the size of ground that is its height at most */
#define LEVEL_NORMAL  0.7f  /* least vertical part of the normal of ground: 45 degrees */
#define MARGIN        1e-4f /* fraction of a subject's size that rounding may put points out of it */
#define MODEL_LEAST   12    /* triangles of a model, as a box has: fewer are stray */

typedef struct box {
    lmp_vec3 low, high;
} box;

static const box nothing = { { INFINITY, INFINITY, INFINITY },
                             { -INFINITY, -INFINITY, -INFINITY } };

static float size_of(const box *b) {
    return vec_length(vec_sub(b->high, b->low));
}

static void add_box(const box *b, box *sum) {
    sum->low =
        vec(fminf(sum->low.x, b->low.x), fminf(sum->low.y, b->low.y), fminf(sum->low.z, b->low.z));
    sum->high = vec(fmaxf(sum->high.x, b->high.x), fmaxf(sum->high.y, b->high.y),
                    fmaxf(sum->high.z, b->high.z));
}

static void add_point(const float p[3], box *sum) {
    const lmp_vec3 at = vec_load(p);
    add_box(&(box) { at, at }, sum);
}

static box box_of(const scene *s, size_t instance) {
    float low[3], high[3];
    scene_instance_box(s, instance, low, high);
    return (box) { vec_load(low), vec_load(high) };
}

/* Adds the instances that are no larger; returns whether there are larger ones. */
static bool add_small(const scene *s, float most, box *sum) {
    bool all = true;
    for (size_t i = 0; i < s->instance_count; i++) {
        const box b = box_of(s, i);
        if (size_of(&b) <= most)
            add_box(&b, sum);
        else
            all = false;
    }
    return !all;
}

/* --- parts of meshes -------------------------------------------------------------------------- */

/* The connected surfaces of all meshes, in the space of their mesh. */
typedef struct parts {
    uint32_t *of; /* per vertex, its part */
    uint32_t count;
    box *boxes;     /* per part */
    size_t *seen;   /* per part, the instance that was last asked about it, from 1 */
    bool *is_small; /* then, whether it is small there */
} parts;

static void parts_free(parts *p) {
    free(p->of);
    free(p->boxes);
    free(p->seen);
    free(p->is_small);
}

/* parts_free is due in any case. */
static bool parts_find(const scene *s, parts *p) {
    const uint32_t count = (uint32_t)s->vertex_count;
    *p = (parts) { .of = malloc((count + (size_t)1) * sizeof *p->of) };
    if (!p->of || !joined_positions(s->vertices, count, p->of))
        return false;
    for (size_t i = 0; i + 2 < s->index_count; i += 3) {
        joined_join(p->of, s->indices[i], s->indices[i + 1]);
        joined_join(p->of, s->indices[i], s->indices[i + 2]);
    }
    p->count = joined_number(p->of, count);
    p->boxes = malloc((p->count + (size_t)1) * sizeof *p->boxes);
    p->seen = calloc(p->count + (size_t)1, sizeof *p->seen);
    p->is_small = malloc(p->count + (size_t)1);
    if (!p->boxes || !p->seen || !p->is_small)
        return false;
    for (uint32_t i = 0; i < p->count; i++)
        p->boxes[i] = nothing;
    for (uint32_t i = 0; i < count; i++)
        add_point(s->vertices[i].position, &p->boxes[p->of[i]]);
    return true;
}

/* Returns the box of a part of an instance. */
static box part_in(const scene *s, size_t instance, const box *part) {
    box sum = nothing;
    for (int i = 0; i < 8; i++) {
        const float corner[3] = { i & 1 ? part->high.x : part->low.x,
                                  i & 2 ? part->high.y : part->low.y,
                                  i & 4 ? part->high.z : part->low.z };
        float p[3];
        scene_instance_point(&s->instances[instance], corner, p);
        add_point(p, &sum);
    }
    return sum;
}

static bool is_level(const box *b, float height) {
    return b->high.y - b->low.y <= height * size_of(b);
}

/* Adds the parts of an instance that are no larger and counts their triangles; returns false if
 * another part is not ground. */
static bool add_parts(const scene *s, size_t instance, float most, parts *p, box *sum,
                      size_t *triangles) {
    const scene_mesh *const mesh = &s->meshes[s->instances[instance].mesh];
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const uint32_t part = p->of[s->indices[mesh->first_index + i]];
        if (p->seen[part] != instance + 1) {
            const box b = part_in(s, instance, &p->boxes[part]);
            p->seen[part] = instance + 1;
            p->is_small[part] = size_of(&b) <= most;
            if (p->is_small[part])
                add_box(&b, sum);
            else if (!is_level(&b, GROUND_HEIGHT))
                return false;
        }
        *triangles += p->is_small[part];
    }
    return true;
}

static bool find_in_meshes(const scene *s, float most, box *sum) {
    parts p;
    size_t triangles = 0;
    bool ok = parts_find(s, &p);
    *sum = nothing;
    for (size_t i = 0; ok && i < s->instance_count; i++)
        ok = add_parts(s, i, most, &p, sum, &triangles);
    parts_free(&p);
    return ok && triangles >= MODEL_LEAST;
}

/* --- what is around --------------------------------------------------------------------------- */

static bool overlaps(const box *a, const box *b) {
    return a->low.x <= b->high.x && a->low.y <= b->high.y && a->low.z <= b->high.z &&
           b->low.x <= a->high.x && b->low.y <= a->high.y && b->low.z <= a->high.z;
}

/* Whether a triangle lies like ground. */
static bool lies_flat(const float corners[3][3]) {
    const lmp_vec3 a = vec_load(corners[0]), b = vec_load(corners[1]), c = vec_load(corners[2]);
    const lmp_vec3 normal = vec_cross(vec_sub(b, a), vec_sub(c, a));
    return fabsf(normal.y) >= LEVEL_NORMAL * vec_length(normal);
}

/* Whether of an instance only ground comes near: a lamp on a mast is not a model. */
static bool keeps_away(const scene *s, size_t instance, const box *near) {
    for (uint32_t n = 0; n < scene_instance_triangles(s, instance); n++) {
        float corners[3][3];
        box b = nothing;
        scene_triangle_positions(s, instance, n, corners);
        for (int i = 0; i < 3; i++)
            add_point(corners[i], &b);
        if (overlaps(&b, near) && !lies_flat((const float(*)[3])corners))
            return false;
    }
    return true;
}

/* Whether nothing but ground comes nearer to what was found than half of its size, of the instances
 * that are larger than `most`. */
static bool stands_alone(const scene *s, float most, const box *found) {
    const float by = 0.5f * size_of(found);
    const box near = { vec_sub(found->low, vec(by, by, by)),
                       vec_add(found->high, vec(by, by, by)) };
    for (size_t i = 0; i < s->instance_count; i++) {
        const box b = box_of(s, i);
        if (size_of(&b) > most && overlaps(&b, &near) && !keeps_away(s, i, &near))
            return false;
    }
    return true;
}

/* --- the decision ----------------------------------------------------------------------------- */

static bool is_together(const box *b, float most) {
    const float size = size_of(b);
    return size > 0.0f && size <= most;
}

static scene_subject part_of_scene(const box *b) {
    const float by = MARGIN * size_of(b);
    const lmp_vec3 margin = vec(by, by, by);
    return (scene_subject) { vec_sub(b->low, margin), vec_add(b->high, margin), true };
}

/* Finds what is small and together, be it a detail of what is large. */
static bool find_small(const scene *s, float most, box *found) {
    *found = nothing;
    return add_small(s, most, found) && is_together(found, most);
}

/* Whether every instance that is larger is a plane. */
static bool is_on_planes(const scene *s, float most) {
    for (size_t i = 0; i < s->instance_count; i++) {
        const box b = box_of(s, i);
        if (size_of(&b) > most && !is_level(&b, PLANE_HEIGHT))
            return false;
    }
    return true;
}

scene_subject scene_subject_find(const scene *s) {
    const box whole = { vec_load(s->minimum), vec_load(s->maximum) };
    const float size = size_of(&whole), most = SUBJECT_PART * size, wide = PLANE_PART * size;
    box found;
    if ((find_small(s, most, &found) && stands_alone(s, most, &found)) ||
        (find_small(s, wide, &found) && is_on_planes(s, wide)) ||
        /* the first is implied, and spares most models the search */
        (is_level(&whole, GROUND_HEIGHT + SUBJECT_PART) && find_in_meshes(s, most, &found) &&
         is_together(&found, most)))
        return part_of_scene(&found);
    return (scene_subject) { whole.low, whole.high, false };
}

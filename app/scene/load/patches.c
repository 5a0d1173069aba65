/* SPDX-License-Identifier: MIT */
#include "app/scene/load/patches.h"

#include "app/scene/light.h"
#include "app/scene/outline.h"
#include "app/scene/vector.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Neighbors are in a plane if the cosine between their normals is above this, and a corner is one
 * if the sine of its angle is. */
static const double flat_cosine = 1 - 1e-6, corner_sine = 1e-3;

/* The most corners of an outline: that of a disk. */
enum { OUTLINE_MAX = 256 };

/* How far the corners of a disk may be from a circle, in radii, and the least of its area that its
 * outline has: that of 12 corners. */
static const double disk_off = 0.01, disk_area = 0.95;

/* A side of a triangle, between numbered positions. */
typedef struct side {
    uint32_t from, to, triangle;
} side;

typedef struct patches {
    const piece_triangle *triangles;
    uint32_t count;
    uint32_t *corner; /* per corner the number of its position */
    lmp_vec3 *normal; /* per triangle */
    uint32_t *joined; /* per triangle another of its patch, or itself (union-find) */
    side *sides;      /* by their ends */
    size_t most;
    lmp_light *lights;
    size_t made;
} patches;

/* --- which triangles are one patch ------------------------------------------------------------ */

static int compare_sides(const void *a, const void *b) {
    const side *p = a, *q = b;
    if (p->from != q->from)
        return p->from < q->from ? -1 : 1;
    return (p->to > q->to) - (p->to < q->to);
}

static void list_sides(patches *p) {
    for (uint32_t i = 0; i < 3 * p->count; i++)
        p->sides[i] = (side) { p->corner[i], p->corner[i / 3 * 3 + (i + 1) % 3], i / 3 };
    qsort(p->sides, 3 * p->count, sizeof *p->sides, compare_sides);
}

static void find_normals(patches *p) {
    for (uint32_t t = 0; t < p->count; t++) {
        const lmp_vec3 *c = p->triangles[t].corner;
        p->normal[t] =
            vec_normalize(vec_cross(vec_sub(c[1], c[0]), vec_sub(c[2], c[0])), vec(0, 1, 0));
    }
}

static uint32_t patch_of(const patches *p, uint32_t triangle) {
    return pieces_root(p->joined, triangle);
}

/* Returns the side of a neighbor, which runs the other way, or NULL. */
static const side *beyond(const patches *p, const side *s) {
    const side back = { s->to, s->from, 0 };
    return bsearch(&back, p->sides, 3 * p->count, sizeof *p->sides, compare_sides);
}

static void join_neighbors(patches *p) {
    for (uint32_t t = 0; t < p->count; t++)
        p->joined[t] = t;
    for (uint32_t i = 0; i < 3 * p->count; i++) {
        const side *other = beyond(p, &p->sides[i]);
        const uint32_t a = p->sides[i].triangle, b = other ? other->triangle : a;
        const lmp_vec3 n = p->normal[a], m = p->normal[b];
        const double cosine =
            (double)n.x * (double)m.x + (double)n.y * (double)m.y + (double)n.z * (double)m.z;
        if (cosine > flat_cosine && p->triangles[a].both == p->triangles[b].both)
            p->joined[patch_of(p, a)] = patch_of(p, b);
    }
}

/* --- the outline of a patch ------------------------------------------------------------------- */

typedef struct outline {
    int count;
    lmp_vec3 corner[OUTLINE_MAX];
} outline;

/* Whether a side bounds its patch. */
static bool bounds(const patches *p, const side *s) {
    const side *other = beyond(p, s);
    return !other || patch_of(p, other->triangle) != patch_of(p, s->triangle);
}

static lmp_vec3 position_of(const patches *p, const side *s) {
    const uint32_t *corner = p->corner + 3 * s->triangle;
    const int k = corner[0] == s->from ? 0 : corner[1] == s->from ? 1 : 2;
    return p->triangles[s->triangle].corner[k];
}

/* Returns the only one of these sides that begins at a position, or NULL. */
static const side *only_from(const side *const *sides, size_t count, uint32_t from) {
    const side *found = NULL;
    for (size_t i = 0; i < count; i++)
        if (sides[i]->from == from) {
            if (found)
                return NULL;
            found = sides[i];
        }
    return found;
}

/* Whether the outline turns at its corner i. */
static bool turns(const outline *o, int i) {
    const lmp_vec3 at = o->corner[i], before = o->corner[(i + o->count - 1) % o->count],
                   after = o->corner[(i + 1) % o->count];
    const lmp_vec3 a = vec_sub(at, before), b = vec_sub(after, at);
    const double sine = (double)vec_length(vec_cross(a, b)),
                 lengths = (double)vec_length(a) * (double)vec_length(b);
    return sine > corner_sine * lengths;
}

/* Removes what lies on a straight side. */
static void straighten(outline *o) {
    for (int i = o->count - 1; i >= 0 && o->count > 3; i--)
        if (!turns(o, i)) {
            memmove(&o->corner[i], &o->corner[i + 1],
                    (size_t)(o->count - 1 - i) * sizeof *o->corner);
            o->count--;
        }
}

/* Follows the sides that bound a patch; returns false if they are no single loop. */
static bool follow(const patches *p, uint32_t patch, outline *o) {
    const side *bounding[OUTLINE_MAX];
    size_t count = 0;
    for (uint32_t i = 0; i < 3 * p->count; i++)
        if (patch_of(p, p->sides[i].triangle) == patch && bounds(p, &p->sides[i])) {
            if (count == OUTLINE_MAX)
                return false;
            bounding[count++] = &p->sides[i];
        }
    const side *at = count > 0 ? bounding[0] : NULL;
    o->count = 0;
    for (size_t i = 0; i < count && at; i++) {
        o->corner[o->count++] = position_of(p, at);
        at = only_from(bounding, count, at->to);
        if (at == bounding[0] && i + 1 < count)
            return false;
    }
    if (at != bounding[0] || count < 3)
        return false;
    straighten(o);
    return true;
}

/* --- lights ----------------------------------------------------------------------------------- */

static lmp_vec3 middle_of(const outline *o) {
    lmp_vec3 sum = { 0, 0, 0 };
    for (int i = 0; i < o->count; i++)
        sum = vec_add(sum, vec_scale(vec_sub(o->corner[i], o->corner[0]), 1 / (float)o->count));
    return vec_add(o->corner[0], sum);
}

static lmp_vec3 area_of(const outline *o) {
    lmp_vec3 sum = { 0, 0, 0 };
    for (int i = 1; i + 1 < o->count; i++)
        sum = vec_add(sum, vec_cross(vec_sub(o->corner[i], o->corner[0]),
                                     vec_sub(o->corner[i + 1], o->corner[0])));
    return vec_scale(sum, 0.5f);
}

static bool make_rectangle(const outline *o, lmp_light *light) {
    const lmp_vec3 *c = o->corner;
    const lmp_vec3 x = vec_sub(c[1], c[0]), y = vec_sub(c[2], c[1]);
    const lmp_vec3 off = vec_add(vec_sub(vec_sub(c[0], c[1]), c[3]), c[2]);
    if (o->count != 4 || !(vec_length(off) <= 1e-5f * (vec_length(x) + vec_length(y))))
        return false;
    *light = scene_light_rectangle(middle_of(o), vec_scale(x, 0.5f), vec_scale(y, 0.5f));
    return true;
}

/* Makes a disk of the same area. */
static bool make_disk(const outline *o, lmp_light *light) {
    const lmp_vec3 area = area_of(o), middle = middle_of(o);
    const double size = (double)vec_length(area);
    double radius = 0;
    for (int i = 0; i < o->count; i++)
        radius += (double)vec_length(vec_sub(o->corner[i], middle)) / o->count;
    for (int i = 0; i < o->count; i++)
        if (!(fabs((double)vec_length(vec_sub(o->corner[i], middle)) - radius) <=
              disk_off * radius))
            return false;
    *light =
        scene_light_disk(middle, vec_normalize(area, vec(0, 1, 0)), (float)sqrt(size / (double)PI));
    return size >= disk_area * (double)PI * radius * radius;
}

static bool make_polygon(const outline *o, lmp_light *light) {
    const lmp_vec3 middle = middle_of(o);
    lmp_vec3 corner[LMP_LIGHT_CORNERS_MAX];
    if (o->count > LMP_LIGHT_CORNERS_MAX)
        return false;
    for (int i = 0; i < o->count; i++)
        corner[i] = vec_sub(o->corner[i], middle);
    *light = scene_light_polygon(middle, corner, o->count);
    return !scene_outline_wrong(corner, o->count);
}

/* Makes one light of an outline; returns false if it is none of these shapes. */
static bool make_light(const outline *o, bool both, lmp_light *light) {
    const bool made = make_rectangle(o, light) || make_polygon(o, light) || make_disk(o, light);
    light->two_sided = both;
    return made;
}

/* Returns the mean radiance of a patch, or of one triangle of it. */
static lmp_rgb radiance_of(const patches *p, uint32_t patch, const piece_triangle *only) {
    double sum[3] = { 0, 0, 0 }, all = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        const piece_triangle *t = &p->triangles[i];
        if (only ? t != only : patch_of(p, i) != patch)
            continue;
        const double area = piece_triangle_area(t);
        all += area;
        for (int c = 0; c < 3; c++)
            sum[c] += area * (double)t->radiance[c];
    }
    return (lmp_rgb) { (float)(sum[0] / all), (float)(sum[1] / all), (float)(sum[2] / all) };
}

/* Adds a light for an outline of a patch, all of it or one triangle. */
static bool add_outline(patches *p, const outline *o, uint32_t patch, const piece_triangle *only) {
    if (p->made == p->most || !make_light(o, p->triangles[patch].both, &p->lights[p->made]))
        return false;
    p->lights[p->made++].radiance = radiance_of(p, patch, only);
    return true;
}

/* Adds a patch as one light or, if it is no shape that a light has, as its triangles; returns false
 * if there is no room or a triangle is no light. */
static bool add_patch(patches *p, uint32_t patch) {
    outline whole, part = { .count = 3 };
    if (follow(p, patch, &whole) && add_outline(p, &whole, patch, NULL))
        return true;
    for (uint32_t t = 0; t < p->count; t++) {
        if (patch_of(p, t) != patch)
            continue;
        memcpy(part.corner, p->triangles[t].corner, sizeof p->triangles[t].corner);
        if (!add_outline(p, &part, patch, &p->triangles[t]))
            return false;
    }
    return true;
}

static size_t count_patches(const patches *p) {
    size_t patch_count = 0;
    for (uint32_t t = 0; t < p->count; t++)
        patch_count += p->joined[t] == t;
    return patch_count;
}

bool patches_make(const piece_triangle *triangles, size_t count, size_t most, lmp_light *lights,
                  size_t *made) {
    patches p = { .triangles = triangles,
                  .count = (uint32_t)count,
                  .corner = malloc((3 * count + 1) * sizeof *p.corner),
                  .normal = malloc((count + 1) * sizeof *p.normal),
                  .joined = malloc((count + 1) * sizeof *p.joined),
                  .sides = malloc((3 * count + 1) * sizeof *p.sides),
                  .most = most,
                  .lights = lights };
    const bool ok = p.corner && p.normal && p.joined && p.sides &&
                    pieces_number_corners(triangles, count, p.corner);
    if (ok) {
        list_sides(&p);
        find_normals(&p);
        join_neighbors(&p);
        bool all = count_patches(&p) <= most;
        for (uint32_t t = 0; t < p.count && all; t++)
            all = p.joined[t] != t || add_patch(&p, t);
        p.made = all ? p.made : 0;
    }
    *made = p.made;
    free(p.corner);
    free(p.normal);
    free(p.joined);
    free(p.sides);
    return ok;
}

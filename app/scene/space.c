/* SPDX-License-Identifier: MIT */
#include "app/scene/space.h"

#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <stdlib.h>

typedef struct triangle {
    float corner[3][3], lo[3], hi[3];
} triangle;

static triangle triangle_at(const scene *world, size_t instance, uint32_t number) {
    triangle t;
    scene_triangle_positions(world, instance, number, t.corner);
    for (int k = 0; k < 3; k++) {
        t.lo[k] = fminf(t.corner[0][k], fminf(t.corner[1][k], t.corner[2][k]));
        t.hi[k] = fmaxf(t.corner[0][k], fmaxf(t.corner[1][k], t.corner[2][k]));
    }
    return t;
}

/* --- along an axis ---------------------------------------------------------------------------- */

/* Finds where the line through a point along an axis meets the triangle, as a distance from the
 * point, and whether the triangle shows its front to the point. */
static bool meets(const triangle *t, lmp_vec3 point, int axis, float *distance, bool *front) {
    const float from[3] = { point.x, point.y, point.z };
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    if (from[i] < t->lo[i] || from[i] > t->hi[i] || from[j] < t->lo[j] || from[j] > t->hi[j])
        return false;
    float a[3], b[3], c[3];
    for (int k = 0; k < 3; k++) {
        a[k] = t->corner[1][k] - t->corner[0][k];
        b[k] = t->corner[2][k] - t->corner[0][k];
        c[k] = from[k] - t->corner[0][k];
    }
    const float area = a[i] * b[j] - a[j] * b[i];
    const float u = (c[i] * b[j] - c[j] * b[i]) / area, v = (a[i] * c[j] - a[j] * c[i]) / area;
    if (!(u >= 0.0f && v >= 0.0f && u + v <= 1.0f))
        return false;
    *distance = u * a[axis] + v * b[axis] - c[axis];
    *front = (*distance > 0.0f) != (area > 0.0f);
    return true;
}

/* --- balls ------------------------------------------------------------------------------------ */

static float to_segment2(lmp_vec3 p, lmp_vec3 a, lmp_vec3 b) {
    const lmp_vec3 along = vec_sub(b, a), way = vec_sub(p, a);
    const float length2 = vec_dot(along, along);
    const float at =
        length2 > 0.0f ? fminf(fmaxf(vec_dot(way, along) / length2, 0.0f), 1.0f) : 0.0f;
    const lmp_vec3 miss = vec_sub(way, vec_scale(along, at));
    return vec_dot(miss, miss);
}

/* Returns the squared distance from a point to the triangle: to its plane if the point lies over
 * it, else to its sides. */
static float distance2(const triangle *t, lmp_vec3 p) {
    const lmp_vec3 a = vec_load(t->corner[0]), b = vec_load(t->corner[1]),
                   c = vec_load(t->corner[2]);
    const lmp_vec3 n = vec_cross(vec_sub(b, a), vec_sub(c, a));
    const lmp_vec3 corners[4] = { a, b, c, a };
    float nearest = INFINITY;
    bool over = vec_dot(n, n) > 0.0f;
    for (int i = 0; i < 3; i++) {
        const lmp_vec3 side = vec_sub(corners[i + 1], corners[i]);
        over = over && vec_dot(vec_cross(side, vec_sub(p, corners[i])), n) >= 0.0f;
        nearest = fminf(nearest, to_segment2(p, corners[i], corners[i + 1]));
    }
    const float height = vec_dot(n, vec_sub(p, a));
    return over ? height * height / vec_dot(n, n) : nearest;
}

static void meet(const triangle *t, space_ball *ball) {
    const float center[3] = { ball->center.x, ball->center.y, ball->center.z }, r = ball->radius;
    float distance;
    bool front;
    if (meets(t, ball->center, 1, &distance, &front)) {
        float *nearest = distance > 0.0f ? &ball->above : &ball->below;
        if (fabsf(distance) < *nearest) {
            *nearest = fabsf(distance);
            *(distance > 0.0f ? &ball->above_is_back : &ball->below_is_back) = !front;
        }
    }
    for (int k = 0; k < 3; k++)
        if (t->lo[k] > center[k] + r || t->hi[k] < center[k] - r)
            return;
    ball->fits = ball->fits && distance2(t, ball->center) > r * r;
}

static int by_x(const void *a, const void *b) {
    const float x = ((const space_ball *)a)->center.x, y = ((const space_ball *)b)->center.x;
    return (x > y) - (x < y);
}

/* Returns the first ball whose center is not below x; balls are sorted. */
static size_t first_from(const space_ball *balls, size_t count, float x) {
    size_t low = 0;
    while (low < count) {
        const size_t middle = low + (count - low) / 2;
        if (balls[middle].center.x < x)
            low = middle + 1;
        else
            count = middle;
    }
    return low;
}

/* Whether a ball reaches into the box, or lies above or below it. */
static bool may_meet(const float lo[3], const float hi[3], const space_ball *ball) {
    const float r = ball->radius;
    return lo[0] <= ball->center.x + r && hi[0] >= ball->center.x - r &&
           lo[2] <= ball->center.z + r && hi[2] >= ball->center.z - r;
}

static void fit_instance(const scene *world, size_t instance, float largest, space_ball *balls,
                         size_t count) {
    float lo[3], hi[3];
    scene_instance_box(world, instance, lo, hi);
    const size_t first = first_from(balls, count, lo[0] - largest);
    bool meets_any = false;
    for (size_t i = first; i < count && balls[i].center.x <= hi[0] + largest; i++)
        meets_any = meets_any || may_meet(lo, hi, &balls[i]);
    for (uint32_t n = 0; meets_any && n < scene_instance_triangles(world, instance); n++) {
        const triangle t = triangle_at(world, instance, n);
        for (size_t i = first_from(balls, count, t.lo[0] - largest);
             i < count && balls[i].center.x <= t.hi[0] + largest; i++)
            meet(&t, &balls[i]);
    }
}

void space_fit(const scene *world, space_ball *balls, size_t count) {
    float largest = 0.0f;
    for (size_t i = 0; i < count; i++) {
        largest = fmaxf(largest, balls[i].radius);
        balls[i].fits = true;
        balls[i].above = balls[i].below = INFINITY;
        balls[i].above_is_back = balls[i].below_is_back = false;
    }
    qsort(balls, count, sizeof *balls, by_x);
    for (size_t i = 0; i < world->instance_count; i++)
        fit_instance(world, i, largest, balls, count);
    for (size_t i = 0; i < count; i++)
        balls[i].fits = balls[i].fits && !balls[i].above_is_back && !balls[i].below_is_back;
}

/* --- rooms ------------------------------------------------------------------------------------ */

typedef struct wall {
    float distance;
    bool front;
} wall;

static void find_walls(const triangle *t, lmp_vec3 middle, wall next[6]) {
    for (int axis = 0; axis < 3; axis++) {
        float distance;
        bool front;
        if (!meets(t, middle, axis, &distance, &front))
            continue;
        const int way = 2 * axis + (distance > 0.0f);
        if (fabsf(distance) < next[way].distance)
            next[way] = (wall) { fabsf(distance), front };
    }
}

/* Whether the box meets one of the three lines through the point. */
static bool may_be_wall(const float lo[3], const float hi[3], lmp_vec3 point) {
    const float p[3] = { point.x, point.y, point.z };
    int within = 0;
    for (int k = 0; k < 3; k++)
        within += lo[k] <= p[k] && p[k] <= hi[k];
    return within >= 2;
}

space_room space_room_at(const scene *world, lmp_vec3 middle) {
    wall next[6];
    for (int i = 0; i < 6; i++)
        next[i] = (wall) { INFINITY, false };
    for (size_t i = 0; i < world->instance_count; i++) {
        float lo[3], hi[3];
        scene_instance_box(world, i, lo, hi);
        for (uint32_t n = 0; may_be_wall(lo, hi, middle) && n < scene_instance_triangles(world, i);
             n++) {
            const triangle t = triangle_at(world, i, n);
            find_walls(&t, middle, next);
        }
    }
    space_room room;
    for (int i = 0; i < 6; i++)
        (i % 2 ? room.ahead : room.back)[i / 2] = next[i].front ? next[i].distance : INFINITY;
    return room;
}

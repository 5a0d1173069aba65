/* SPDX-License-Identifier: MIT */
#include "app/scene/emitter.h"

#include "app/scene/vector.h"

#include "src/light/packed.h"

#include <stddef.h>

/* --- flat areas ------------------------------------------------------------------------------- */

/* Sets the vectors whose products with a point give its coordinates, and the surface. */
static void set_coordinates(scene_emitter *area) {
    const lmp_vec3 beside_x = vec_cross(area->y, area->normal),
                   beside_y = vec_cross(area->normal, area->x);
    area->of_x = vec_scale(beside_x, 1 / vec_dot(area->x, beside_x));
    area->of_y = vec_scale(beside_y, 1 / vec_dot(area->y, beside_y));
    area->surface = 4 * fabsf(vec_dot(area->x, beside_x));
}

static void set_disk(const lmp_light *light, scene_emitter *area) {
    area->normal = light->direction;
    area->x = vec_scale(vec_across(light->direction), light->radius);
    area->y = vec_cross(area->normal, area->x);
    set_coordinates(area);
    area->facing = area->surface = PI * light->radius * light->radius;
    area->extent = light->radius;
}

/* Finds the bounds of a polygon along unit vectors in its plane. */
static void bound(const lmp_vec3 *corner, int count, const lmp_vec3 axes[2], float low[2],
                  float high[2]) {
    for (int k = 0; k < 2; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
        for (int i = 0; i < count; i++) {
            const float at = vec_dot(corner[i], axes[k]);
            low[k] = fminf(low[k], at);
            high[k] = fmaxf(high[k], at);
        }
    }
}

static bool is_opposite(lmp_vec3 a, lmp_vec3 b) {
    return a.x == -b.x && a.y == -b.y && a.z == -b.z;
}

/* Returns twice the area along the normal. */
static lmp_vec3 twice_area(const lmp_vec3 *corner, int count) {
    lmp_vec3 sum = { 0, 0, 0 };
    for (int i = 1; i + 1 < count; i++)
        sum = vec_add(sum,
                      vec_cross(vec_sub(corner[i], corner[0]), vec_sub(corner[i + 1], corner[0])));
    return sum;
}

/* Sets the smallest rectangle around a polygon along its first side, and the corners in it. */
static void set_polygon(const lmp_vec3 *corner, int count, scene_emitter *area) {
    float low[2], high[2];
    const lmp_vec3 n = area->normal;
    const lmp_vec3 across = vec_normalize(vec_sub(corner[1], corner[0]), vec_across(n));
    const lmp_vec3 axes[2] = { across, vec_cross(n, across) };
    bound(corner, count, axes, low, high);
    area->x = vec_scale(axes[0], 0.5f * (high[0] - low[0]));
    area->y = vec_scale(axes[1], 0.5f * (high[1] - low[1]));
    set_coordinates(area);
    const lmp_vec3 middle = vec_add(vec_scale(n, vec_dot(corner[0], n)),
                                    vec_add(vec_scale(axes[0], 0.5f * (low[0] + high[0])),
                                            vec_scale(axes[1], 0.5f * (low[1] + high[1]))));
    area->center = vec_add(area->center, middle);
    area->corner_count = count;
    for (int i = 0; i < count; i++) {
        const lmp_vec3 off = vec_sub(corner[i], middle);
        area->corner[i][0] = vec_dot(off, area->of_x);
        area->corner[i][1] = vec_dot(off, area->of_y);
    }
}

/* Sets the corners of a flat area. A rectangle's are on both sides of its position. */
static void set_outline(const lmp_vec3 *corner, int count, scene_emitter *area) {
    const lmp_vec3 twice = twice_area(corner, count);
    area->normal = vec_normalize(twice, vec(0, 0, 1));
    area->facing = 0.5f * vec_length(twice);
    if (count == 4 && is_opposite(corner[0], corner[2]) && is_opposite(corner[1], corner[3])) {
        area->x = vec_scale(vec_sub(corner[1], corner[0]), 0.5f);
        area->y = vec_scale(vec_sub(corner[2], corner[1]), 0.5f);
        set_coordinates(area);
    } else
        set_polygon(corner, count, area);
    area->extent =
        fmaxf(vec_length(vec_add(area->x, area->y)), vec_length(vec_sub(area->x, area->y)));
}

/* --- all areas -------------------------------------------------------------------------------- */

static void set_tube(const lmp_light *light, scene_emitter *area) {
    const float r = light->radius;
    area->half = vec_length(light->half[0]);
    area->radius = r;
    area->normal = vec_normalize(light->half[0], vec(0, 0, 1));
    area->extent = area->half + r;
    area->facing = r * (4 * area->half + PI * r);
    area->surface = 4 * PI * r * (area->half + r);
}

void scene_emitter_set(const lmp_light *light, scene_emitter *area) {
    lmpi_vector exact[LMP_LIGHT_CORNERS_MAX];
    lmp_vec3 corner[LMP_LIGHT_CORNERS_MAX];
    const bool tube = lmpi_area_is_tube(light);
    const int count = tube ? 0 : lmpi_area_find_corners(light, exact);
    *area = (scene_emitter) { .form = tube    ? SCENE_EMITTER_TUBE
                                      : count ? SCENE_EMITTER_OUTLINE
                                              : SCENE_EMITTER_DISK,
                              .two_sided = !tube && light->two_sided,
                              .center = light->position };
    for (int i = 0; i < count; i++)
        corner[i] = lmpi_vector_rounded(exact[i]);
    if (tube)
        set_tube(light, area);
    else if (count > 0)
        set_outline(corner, count, area);
    else
        set_disk(light, area);
}

/* Whether a line to the right of the point crosses the sides of the polygon an odd number of
 * times. */
static bool is_inside(const scene_emitter *polygon, float u, float v) {
    bool inside = false;
    for (int i = 0; i < polygon->corner_count; i++) {
        const float *a = polygon->corner[i], *b = polygon->corner[(i + 1) % polygon->corner_count];
        if ((a[1] > v) != (b[1] > v) && u < a[0] + (v - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
            inside = !inside;
    }
    return inside;
}

bool scene_emitter_covers(const scene_emitter *flat, float u, float v) {
    if (flat->form == SCENE_EMITTER_DISK)
        return u * u + v * v <= 1;
    return fabsf(u) <= 1 && fabsf(v) <= 1 && (flat->corner_count == 0 || is_inside(flat, u, v));
}

static float distance_to_flat(const scene_emitter *area, lmp_vec3 to, lmp_vec3 direction) {
    const float toward = -vec_dot(direction, area->normal);
    if (!(area->two_sided ? toward != 0 : toward > 0))
        return NAN;
    const float distance = -vec_dot(to, area->normal) / toward;
    const lmp_vec3 at = vec_sub(vec_scale(direction, distance), to);
    const bool covered =
        scene_emitter_covers(area, vec_dot(at, area->of_x), vec_dot(at, area->of_y));
    return covered && distance > 0 ? distance : NAN;
}

/* A ray as seen from the middle of a tube, in double: thin far tubes would lose their digits. */
typedef struct tube_ray {
    double along, speed;    /* along the axis, where it begins and how fast */
    double to2, rate, way2; /* squared distance, and products with the direction */
    double near, far;       /* where it meets the tube */
} tube_ray;

/* Meets the round surface around the point at `end` along the axis, or, if it is not round, the
 * cylinder around the axis; only what lies at that end counts. */
static void meet(const scene_emitter *tube, double end, bool round, tube_ray *ray) {
    const double half = (double)tube->half, r = (double)tube->radius;
    const double along = ray->along - end;
    const double keep = round ? 0 : 1; /* how much of the axis is left out */
    const double a = ray->way2 - keep * ray->speed * ray->speed;
    const double b = ray->rate - ray->along * ray->speed + (1 - keep) * along * ray->speed;
    const double c = ray->to2 - ray->along * ray->along + (1 - keep) * along * along - r * r;
    const double square = b * b - a * c;
    if (!(a > 0) || !(square >= 0))
        return;
    for (int sign = -1; sign <= 1; sign += 2) {
        const double at = (-b + sign * sqrt(square)) / a, where = ray->along + at * ray->speed;
        if (round ? where * end >= end * end : fabs(where) <= half) {
            ray->near = fmin(ray->near, at);
            ray->far = fmax(ray->far, at);
        }
    }
}

static double product(lmp_vec3 a, lmp_vec3 b) {
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

static float distance_to_tube(const scene_emitter *tube, lmp_vec3 to, lmp_vec3 direction) {
    const double half = (double)tube->half;
    tube_ray ray = { .along = -product(to, tube->normal),
                     .speed = product(direction, tube->normal),
                     .to2 = product(to, to),
                     .rate = -product(to, direction),
                     .way2 = product(direction, direction),
                     .near = (double)INFINITY,
                     .far = -(double)INFINITY };
    meet(tube, 0, false, &ray);
    meet(tube, half, true, &ray);
    meet(tube, -half, true, &ray);
    if (!(ray.far > 0))
        return NAN;
    return (float)(ray.near > 0 ? ray.near : ray.far);
}

float scene_emitter_distance(const scene_emitter *area, const float origin[3],
                             const float direction[3]) {
    const lmp_vec3 to = vec_sub(area->center, vec_load(origin)), along = vec_load(direction);
    return area->form == SCENE_EMITTER_TUBE ? distance_to_tube(area, to, along)
                                            : distance_to_flat(area, to, along);
}

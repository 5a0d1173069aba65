/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_trace.h"

#include "app/scene/instance.h"
#include "app/scene/trace/trace.h"

#include <stdlib.h>
#include <string.h>

struct reference_tracer {
    const scene *scene;
    trace_bvh *bvh;
    double lift;
};

/* The three vertices of a triangle, and the weights of a hit. */
typedef struct corner_weights {
    scene_vertex vertices[3];
    double weights[3];
} corner_weights;

/* Returns Σ weight * the three floats at `offset` bytes in each vertex. */
static reference_vec blend(const corner_weights *c, size_t offset) {
    reference_vec sum = { 0, 0, 0 };
    for (int i = 0; i < 3; i++) {
        const float *v = (const float *)(const void *)((const char *)&c->vertices[i] + offset);
        sum = reference_add(sum, reference_scale(c->weights[i], reference_from_floats(v)));
    }
    return sum;
}

static void blend_uv(const corner_weights *c, double uv[4]) {
    memset(uv, 0, 4 * sizeof *uv);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 4; k++)
            uv[k] += c->weights[i] * (double)c->vertices[i].uv[k / 2][k % 2];
}

static void blend_color(const corner_weights *c, const scene_material *material, double color[4]) {
    for (int k = 0; k < 4; k++)
        color[k] = material->flags & SCENE_VERTEX_COLORS ? 0 : 1;
    for (int i = 0; i < 3 && (material->flags & SCENE_VERTEX_COLORS); i++)
        for (int k = 0; k < 4; k++)
            color[k] += c->weights[i] * (double)c->vertices[i].color[k] / 65535;
}

/* Returns the normal of the face that is counter-clockwise as seen by the viewer; not unit. */
static reference_vec face_normal(const corner_weights *c) {
    const reference_vec p = reference_from_floats(c->vertices[0].position);
    return reference_cross(reference_subtract(reference_from_floats(c->vertices[1].position), p),
                           reference_subtract(reference_from_floats(c->vertices[2].position), p));
}

/* Returns how far above its triangle the surface with the corners' normals lies, to second order:
 * half the height of the corners' tangent planes. */
static double bulge(const corner_weights *c, reference_vec position) {
    double height = 0;
    for (int i = 0; i < 3; i++) {
        const reference_vec corner = reference_from_floats(c->vertices[i].position);
        const reference_vec normal = reference_from_floats(c->vertices[i].normal);
        height += c->weights[i] / 2 * reference_dot(reference_subtract(corner, position), normal);
    }
    return height;
}

static float lift_of(const reference_tracer *tracer, const corner_weights *c, reference_vec at) {
    lmp_vec3 corners[3];
    for (int i = 0; i < 3; i++) {
        const float *corner = c->vertices[i].position;
        corners[i] = (lmp_vec3) { corner[0], corner[1], corner[2] };
    }
    return trace_lift_at((float)tracer->lift, (lmp_vec3) { (float)at.x, (float)at.y, (float)at.z },
                         corners);
}

bool reference_tracer_create(const scene *world, reference_tracer **tracer, base_error *error) {
    reference_tracer *t = *tracer = calloc(1, sizeof *t);
    if (!t || !(t->bvh = trace_create(world))) {
        free(t);
        *tracer = NULL;
        return base_fail(error, world->name, "cannot be prepared for ray tracing (out of memory?)");
    }
    t->scene = world;
    t->lift = trace_lift(world);
    return true;
}

void reference_tracer_destroy(reference_tracer *tracer) {
    if (tracer)
        trace_destroy(tracer->bvh);
    free(tracer);
}

static trace_hit cast(const reference_tracer *tracer, trace_kind kind, reference_vec origin,
                      reference_vec direction) {
    const float from[3] = { (float)origin.x, (float)origin.y, (float)origin.z };
    const float along[3] = { (float)direction.x, (float)direction.y, (float)direction.z };
    return trace_nearest(tracer->bvh, kind, from, along);
}

static reference_hit trace_surface(const reference_tracer *tracer, trace_kind kind,
                                   reference_vec origin, reference_vec direction) {
    const trace_hit found = cast(tracer, kind, origin, direction);
    reference_hit hit = { .distance = (double)INFINITY };
    if (found.instance == TRACE_NOTHING)
        return hit;
    const scene *world = tracer->scene;
    const uint32_t material = scene_instance_material(world, found.instance);
    corner_weights c;
    trace_corners(world, &found, c.vertices, c.weights);
    const reference_vec face = reference_normalize(face_normal(&c));
    const double side = reference_dot(face, direction) > 0 ? -1 : 1;
    if (side < 0 && !(world->materials[material].flags & SCENE_DOUBLE_SIDED))
        return hit;
    hit.position = blend(&c, offsetof(scene_vertex, position));
    hit.distance = reference_length(reference_subtract(hit.position, origin));
    const reference_vec normal = blend(&c, offsetof(scene_vertex, normal));
    const reference_vec lift =
        reference_scale(side * (double)lift_of(tracer, &c, hit.position), face);
    const double height = side * bulge(&c, hit.position);
    hit.normal = reference_scale(side, reference_normalize(normal));
    hit.behind = reference_subtract(hit.position, lift);
    hit.ray_origin = reference_add(reference_add(hit.position, lift),
                                   reference_scale(fmax(height, 0), hit.normal));
    hit.ray_behind = reference_add(hit.behind, reference_scale(fmin(height, 0), hit.normal));
    hit.tangent = reference_normalize(blend(&c, offsetof(scene_vertex, tangent)));
    hit.handedness = (double)c.vertices[0].tangent[3];
    blend_uv(&c, hit.uv);
    blend_color(&c, &world->materials[material], hit.color);
    hit.material = material;
    return hit;
}

reference_hit reference_tracer_see(const reference_tracer *tracer, reference_vec origin,
                                   reference_vec direction) {
    return trace_surface(tracer, TRACE_CAMERA, origin, direction);
}

reference_hit reference_tracer_meet(const reference_tracer *tracer, reference_vec origin,
                                    reference_vec direction) {
    return trace_surface(tracer, TRACE_LIGHT, origin, direction);
}

double reference_tracer_free_path(reference_vec point, reference_vec direction, void *user) {
    return (double)cast(user, TRACE_LIGHT, point, direction).distance;
}

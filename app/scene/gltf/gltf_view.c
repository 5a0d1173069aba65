/* SPDX-License-Identifier: MIT */
/* gltf_view.c - cameras, and lights: KHR_lights_punctual and EXT_lights_area. */
#include "app/scene/gltf/gltf.h"
#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <stdio.h>
#include <string.h>

typedef struct scene_box {
    double center[3], diagonal;
} scene_box;

static scene_box box_of(const scene_builder *builder) {
    scene_box box = { .diagonal = 1.0 };
    double square = 0.0;
    float low[3], high[3];
    scene world;
    builder_geometry(builder, &world);
    if (!scene_bounds(&world, low, high))
        return box;
    for (int k = 0; k < 3; k++) {
        const double lo = (double)low[k], hi = (double)high[k];
        box.center[k] = 0.5 * (lo + hi);
        square += (hi - lo) * (hi - lo);
    }
    if (square > 0.0)
        box.diagonal = sqrt(square);
    return box;
}

static lmp_vec3 axis_of(const double m[16], int column, float sign) {
    const double *a = m + 4 * column;
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    if (!(length > 0.0))
        return vec(0.0f, column == 1 ? 1.0f : 0.0f, column == 2 ? sign : 0.0f);
    const double scale = (double)sign / length;
    return vec((float)(a[0] * scale), (float)(a[1] * scale), (float)(a[2] * scale));
}

/* Sets the field of view, or half the extents of an orthographic view; returns false if it sees
 * nothing. */
static bool set_lens(json_t *entry, scene_camera *camera) {
    const bool flat = strcmp(gltf_text(entry, "type"), "orthographic") == 0;
    json_t *view = json_object_get(entry, flat ? "orthographic" : "perspective");
    const double across = fabs(gltf_number(view, "xmag", 1.0));
    const double up = fabs(gltf_number(view, "ymag", 1.0));
    const double fov = gltf_number(view, "yfov", 0.7854);
    const double near = gltf_number(view, "znear", 0.0), far = gltf_number(view, "zfar", 0.0);
    camera->near = near < (double)LMP_LENGTH_MAX ? (float)near : 0.0f;
    camera->far = far > near && far < (double)LMP_LENGTH_MAX ? (float)far : 0.0f;
    if (!(camera->far > camera->near)) /* also when float32 cannot tell them apart */
        camera->far = 0.0f;
    camera->fov = flat ? 0.7854f : (float)fmin(fov, 3.1);
    if (!flat)
        return view && fov > 1e-6 && fov < M_PI;
    camera->height = (float)(2.0 * up);
    camera->aspect = (float)(across / up);
    return view && up > 1e-6 && up < 1e12 && camera->aspect > 1e-6f && camera->aspect < 1e6f;
}

static bool add_camera(const gltf *document, size_t node, const scene_box *box,
                       scene_builder *builder, base_error *error) {
    const double *m = document->nodes[node].world;
    json_t *holder = gltf_item(document, GLTF_NODES, node);
    const size_t index = (size_t)gltf_index(holder, "camera");
    json_t *entry = gltf_item(document, GLTF_CAMERAS, index);
    scene_camera lens = { .fov = 0.0f };
    if (!set_lens(entry, &lens)) {
        builder_unsupported(builder, "impossible field of view", "camera", 1);
        return true;
    }
    scene_camera *camera = builder_append(builder, BLOB_CAMERAS, 1);
    if (!camera)
        return base_fail(error, document->subject, "does not fit into memory");
    *camera = lens;
    const char *name = gltf_text(entry, "name");
    scene_clean_name(camera->name, name[0] ? name : gltf_text(holder, "name"));
    const lmp_vec3 eye = vec((float)m[12], (float)m[13], (float)m[14]);
    const lmp_vec3 forward = axis_of(m, 2, -1.0f), up = axis_of(m, 1, 1.0f);
    const lmp_vec3 center =
        vec((float)box->center[0], (float)box->center[1], (float)box->center[2]);
    /* the target is where the view passes the scene's middle, so that one can orbit around it */
    const float reach = fmaxf(vec_dot(vec_sub(center, eye), forward), 0.1f * (float)box->diagonal);
    vec_store(eye, camera->eye);
    vec_store(vec_add(eye, vec_scale(forward, reach)), camera->target);
    vec_store(up, camera->up);
    return true;
}

/* Makes an emitter of a light; a radius in the extras of the light, or of the node that holds it,
 * makes a point light a sphere. */
static void set_emitter(json_t *entry, json_t *holder, const double m[16], lmp_light *emitter) {
    json_t *cone = json_object_get(entry, "spot");
    const char *type = gltf_text(entry, "type");
    double color[3] = { 1.0, 1.0, 1.0 };
    gltf_numbers(entry, "color", 3, color);
    double strength = gltf_number(entry, "intensity", 1.0);
    double radius = gltf_number(json_object_get(entry, "extras"), "radius", 0.0);
    radius = gltf_number(json_object_get(holder, "extras"), "radius", radius);
    emitter->position = vec((float)m[12], (float)m[13], (float)m[14]);
    if (strcmp(type, "directional") == 0) {
        emitter->kind = LMP_LIGHT_DIRECTIONAL;
        emitter->direction = axis_of(m, 2, 1.0f);
    } else if (strcmp(type, "spot") == 0) {
        emitter->kind = LMP_LIGHT_SPOT;
        emitter->direction = axis_of(m, 2, -1.0f);
        emitter->inner = (float)gltf_number(cone, "innerConeAngle", 0.0);
        emitter->outer = (float)gltf_number(cone, "outerConeAngle", M_PI_4);
        emitter->inner = fminf(emitter->inner, emitter->outer);
    } else if (radius != 0.0) {
        emitter->radius = (float)radius;
        strength /= M_PI * radius * radius;
    } else
        emitter->kind = LMP_LIGHT_POINT;
    emitter->radiance = (lmp_rgb) { (float)(strength * color[0]), (float)(strength * color[1]),
                                    (float)(strength * color[2]) };
}

static bool is_punctual(json_t *light) {
    const char *type = gltf_text(light, "type");
    return strcmp(type, "directional") == 0 || strcmp(type, "spot") == 0 ||
           strcmp(type, "point") == 0;
}

/* Returns the largest scale of a transform along an axis. */
static double scale_of(const double m[16]) {
    double largest = 0.0;
    for (int column = 0; column < 3; column++) {
        const double *a = m + 4 * column;
        largest = fmax(largest, sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]));
    }
    return largest;
}

/* Makes a rectangle or a disk of an area light, which shines along -z with a radiance in nits. Its
 * size follows the node's largest scale. */
static void set_area(json_t *entry, const double m[16], lmp_light *emitter) {
    double color[3] = { 1.0, 1.0, 1.0 };
    gltf_numbers(entry, "color", 3, color);
    const double nits = gltf_number(entry, "intensity", 1000.0);
    const double half = 0.5 * scale_of(m) * gltf_number(entry, "size", 1.0);
    const double aspect = gltf_number(json_object_get(entry, "rect"), "aspect", 1.0);
    const lmp_vec3 backward = axis_of(m, 2, 1.0f), right = axis_of(m, 0, 1.0f);
    emitter->position = vec((float)m[12], (float)m[13], (float)m[14]);
    emitter->radiance =
        (lmp_rgb) { (float)(nits * color[0]), (float)(nits * color[1]), (float)(nits * color[2]) };
    if (strcmp(gltf_text(entry, "type"), "disk") == 0) {
        emitter->kind = LMP_LIGHT_DISK;
        emitter->direction = vec_scale(backward, -1.0f);
        emitter->radius = (float)half;
    } else {
        const lmp_vec3 down = vec_normalize(vec_cross(right, backward), vec(0.0f, -1.0f, 0.0f));
        emitter->kind = LMP_LIGHT_RECTANGLE;
        emitter->half[0] = vec_scale(right, (float)(half * aspect));
        emitter->half[1] = vec_scale(down, (float)half);
    }
}

static bool is_area(json_t *light) {
    const char *type = gltf_text(light, "type");
    return strcmp(type, "rect") == 0 || strcmp(type, "disk") == 0;
}

/* Whether the inner cone of a spot light is wider than its outer one. Equal cones give a sharp
 * edge. */
static bool is_inside_out(json_t *light) {
    json_t *cone = json_object_get(light, "spot");
    return gltf_number(cone, "innerConeAngle", 0.0) >
           gltf_number(cone, "outerConeAngle", M_PI_4) + 1e-5;
}

/* Appends a light and the motion of its node. A light that cannot be is left out; one of an unknown
 * type has been reported when the file was checked. */
static bool add_light(const gltf *document, size_t node, const gltf_motions *motions, bool known,
                      const lmp_light *emitter, scene_builder *builder, base_error *error) {
    const scene_light made = { .emitter = *emitter };
    scene_light_error wrong;
    if (!known || !scene_light_check(&made, &wrong)) {
        builder_unsupported(builder, "impossible value", "light", known);
        return true;
    }
    scene_light *light = builder_append(builder, BLOB_LIGHTS, 1);
    if (!light)
        return base_fail(error, document->subject, "does not fit into memory");
    *light = made;
    if ((scene_light_has(light, SCENE_LIGHT_DIRECTION) || scene_light_is_area(emitter)) &&
        gltf_rotates(motions, node))
        builder_unsupported(builder, "animated direction", "light", 1);
    const size_t number = builder_count(builder, BLOB_LIGHTS) - 1;
    return !scene_light_has(light, SCENE_LIGHT_POSITION) ||
           gltf_add_motion(document, motions, node, number, builder, error);
}

static bool add_punctual(const gltf *document, size_t node, const gltf_motions *motions,
                         scene_builder *builder, base_error *error) {
    json_t *holder = gltf_item(document, GLTF_NODES, node);
    const size_t index = (size_t)gltf_index(gltf_extension(holder, "KHR_lights_punctual"), "light");
    json_t *entry = gltf_item(document, GLTF_LIGHTS, index);
    const size_t before = builder_count(builder, BLOB_LIGHTS);
    lmp_light emitter = { .radius = 0.0f };
    set_emitter(entry, holder, document->nodes[node].world, &emitter);
    if (!add_light(document, node, motions, is_punctual(entry), &emitter, builder, error))
        return false;
    const size_t added = builder_count(builder, BLOB_LIGHTS) - before;
    if (emitter.kind == LMP_LIGHT_SPOT && is_inside_out(entry))
        builder_unsupported(builder, "inner cone past the outer", "light", added);
    if (json_object_get(entry, "range"))
        builder_unsupported(builder, "range", "light", added);
    return true;
}

static bool add_area(const gltf *document, size_t node, const gltf_motions *motions,
                     scene_builder *builder, base_error *error) {
    json_t *holder = gltf_item(document, GLTF_NODES, node);
    const size_t index = (size_t)gltf_index(gltf_extension(holder, "EXT_lights_area"), "light");
    json_t *entry = gltf_item(document, GLTF_AREA_LIGHTS, index);
    lmp_light emitter = { .radius = 0.0f };
    set_area(entry, document->nodes[node].world, &emitter);
    return add_light(document, node, motions, is_area(entry), &emitter, builder, error);
}

bool gltf_add_views(const gltf *document, scene_builder *builder, base_error *error) {
    const scene_box box = box_of(builder);
    gltf_motions *motions = gltf_motions_open(document, error);
    bool ok = motions != NULL;
    for (size_t i = 0; ok && i < gltf_count(document, GLTF_NODES); i++) {
        json_t *node = gltf_item(document, GLTF_NODES, i);
        if (!document->nodes[i].shown)
            continue;
        if (gltf_moves(motions, i) &&
            (json_object_get(node, "mesh") || json_object_get(node, "camera")))
            builder_unsupported(builder, "animation", "node", 1);
        if (json_object_get(node, "camera"))
            ok = add_camera(document, i, &box, builder, error);
        if (ok && gltf_extension(node, "KHR_lights_punctual"))
            ok = add_punctual(document, i, motions, builder, error);
        if (ok && gltf_extension(node, "EXT_lights_area"))
            ok = add_area(document, i, motions, builder, error);
    }
    gltf_motions_close(motions);
    return ok;
}

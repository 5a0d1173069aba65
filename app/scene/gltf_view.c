/* SPDX-License-Identifier: MIT */
/* gltf_view.c - cameras and KHR_lights_punctual. */
#include "app/scene/gltf.h"
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

/* An angle, or by parallel rays half of what is seen across and up; false if it sees nothing. */
static bool set_lens(const cJSON *entry, scene_camera *camera) {
    const bool flat = strcmp(gltf_text(entry, "type"), "orthographic") == 0;
    const cJSON *view = gltf_member(entry, flat ? "orthographic" : "perspective");
    const double across = fabs(gltf_number(view, "xmag", 1.0));
    const double up = fabs(gltf_number(view, "ymag", 1.0));
    const double fov = gltf_number(view, "yfov", 0.7854);
    const double near = gltf_number(view, "znear", 0.0), far = gltf_number(view, "zfar", 0.0);
    camera->near = near < (double)LMP_LENGTH_MAX ? (float)near : 0.0f;
    camera->far = far > near && far < (double)LMP_LENGTH_MAX ? (float)far : 0.0f;
    if (!(camera->far > camera->near)) /* past float32's digits, too */
        camera->far = 0.0f;
    camera->fov = flat ? 0.7854f : (float)fmin(fov, 3.1);
    if (!flat)
        return view && fov > 1e-6 && fov < M_PI;
    camera->height = (float)(2.0 * up);
    camera->aspect = (float)(across / up);
    return view && up > 1e-6 && up < 1e12 && camera->aspect > 1e-6f && camera->aspect < 1e6f;
}

static bool add_camera(const gltf *document, size_t node, const scene_box *box,
                       scene_builder *builder, cli_error *error) {
    const double *m = document->nodes[node].world;
    const cJSON *holder = gltf_item(document, GLTF_NODES, node);
    const size_t index = (size_t)gltf_index(holder, "camera");
    const cJSON *entry = gltf_item(document, GLTF_CAMERAS, index);
    scene_camera lens = { .fov = 0.0f };
    if (!set_lens(entry, &lens)) {
        builder_left_out(builder, "impossible field of view", "camera", 1);
        return true;
    }
    scene_camera *camera = builder_append(builder, BLOB_CAMERAS, 1);
    if (!camera)
        return cli_fail(error, document->subject, "does not fit into memory");
    *camera = lens;
    const char *name = gltf_text(entry, "name");
    scene_clean_name(camera->name, name[0] ? name : gltf_text(holder, "name"));
    const lmp_vec3 eye = vec((float)m[12], (float)m[13], (float)m[14]);
    const lmp_vec3 forward = axis_of(m, 2, -1.0f), up = axis_of(m, 1, 1.0f);
    const lmp_vec3 center =
        vec((float)box->center[0], (float)box->center[1], (float)box->center[2]);
    /* The target is where the view passes the scene's middle, so that one can orbit around it. */
    const float reach = fmaxf(vec_dot(vec_sub(center, eye), forward), 0.1f * (float)box->diagonal);
    vec_store(eye, camera->eye);
    vec_store(vec_add(eye, vec_scale(forward, reach)), camera->target);
    vec_store(up, camera->up);
    return true;
}

/* A radius in the extras of the light, or of the node that holds it, makes a point a sphere. */
static void set_emitter(const cJSON *entry, const cJSON *holder, const double m[16],
                        lmp_light *emitter) {
    const cJSON *cone = gltf_member(entry, "spot");
    const char *type = gltf_text(entry, "type");
    double color[3] = { 1.0, 1.0, 1.0 };
    gltf_numbers(entry, "color", 3, color);
    double strength = gltf_number(entry, "intensity", 1.0);
    double radius = gltf_number(gltf_member(entry, "extras"), "radius", 0.0);
    radius = gltf_number(gltf_member(holder, "extras"), "radius", radius);
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

static bool is_known(const cJSON *light) {
    const char *type = gltf_text(light, "type");
    return strcmp(type, "directional") == 0 || strcmp(type, "spot") == 0 ||
           strcmp(type, "point") == 0;
}

/* An inner cone as wide as the outer is one with a sharp edge; a wider one makes none. */
static bool is_inside_out(const cJSON *light) {
    const cJSON *cone = gltf_member(light, "spot");
    return gltf_number(cone, "innerConeAngle", 0.0) >
           gltf_number(cone, "outerConeAngle", M_PI_4) + 1e-5;
}

static bool add_light(const gltf *document, size_t node, const gltf_motions *motions,
                      scene_builder *builder, cli_error *error) {
    const cJSON *holder = gltf_item(document, GLTF_NODES, node);
    const size_t index = (size_t)gltf_index(gltf_extension(holder, "KHR_lights_punctual"), "light");
    const cJSON *entry = gltf_item(document, GLTF_LIGHTS, index);
    scene_light made = { .hidden = 0 };
    scene_light_error wrong;
    set_emitter(entry, holder, document->nodes[node].world, &made.emitter);
    if (!is_known(entry) || !scene_light_check(&made, &wrong)) {
        builder_left_out(builder, "impossible value", "light", is_known(entry)); /* or said */
        return true;
    }
    if (made.emitter.kind == LMP_LIGHT_SPOT && is_inside_out(entry))
        builder_left_out(builder, "inner cone past the outer", "light", 1);
    scene_light *light = builder_append(builder, BLOB_LIGHTS, 1);
    if (!light)
        return cli_fail(error, document->subject, "does not fit into memory");
    *light = made;
    if (gltf_member(entry, "range"))
        builder_left_out(builder, "range", "light", 1);
    if (scene_light_has(light, SCENE_LIGHT_DIRECTION) && gltf_rotates(motions, node))
        builder_left_out(builder, "animated direction", "light", 1);
    const size_t number = builder_count(builder, BLOB_LIGHTS) - 1;
    return !scene_light_has(light, SCENE_LIGHT_POSITION) ||
           gltf_add_motion(document, motions, node, number, builder, error);
}

bool gltf_add_views(const gltf *document, scene_builder *builder, cli_error *error) {
    const scene_box box = box_of(builder);
    gltf_motions *motions = gltf_motions_open(document, error);
    bool ok = motions != NULL;
    for (size_t i = 0; ok && i < gltf_count(document, GLTF_NODES); i++) {
        const cJSON *node = gltf_item(document, GLTF_NODES, i);
        if (!document->nodes[i].shown)
            continue;
        if (gltf_moves(motions, i) && (gltf_member(node, "mesh") || gltf_member(node, "camera")))
            builder_left_out(builder, "animation", "node", 1);
        if (gltf_member(node, "camera"))
            ok = add_camera(document, i, &box, builder, error);
        if (ok && gltf_extension(node, "KHR_lights_punctual"))
            ok = add_light(document, i, motions, builder, error);
    }
    gltf_motions_close(motions);
    return ok;
}

/* SPDX-License-Identifier: MIT */
#include "app/scene/gltf/gltf_deform.h"

#include "app/scene/instance.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- morph targets ---------------------------------------------------------------------------- */

/* Adds an attribute of a target to three floats of every vertex. */
static bool add_target(const gltf *document, size_t accessor, double weight, size_t offset,
                       mesh_draft *draft, base_error *error) {
    float *numbers;
    const bool ok = gltf_read_floats(document, accessor, &numbers, error);
    for (size_t i = 0; ok && i < draft->vertex_count; i++) {
        float *to = (float *)(void *)((char *)&draft->vertices[i] + offset);
        for (size_t k = 0; k < 3; k++)
            to[k] += (float)(weight * (double)numbers[3 * i + k]);
    }
    free(numbers);
    return ok;
}

bool gltf_morph(const gltf *document, json_t *node, json_t *primitive, mesh_draft *draft,
                base_error *error) {
    static const struct {
        const char *name;
        size_t offset;
    } parts[] = { { "POSITION", offsetof(scene_vertex, position) },
                  { "NORMAL", offsetof(scene_vertex, normal) },
                  { "TANGENT", offsetof(scene_vertex, tangent) } };
    json_t *mesh = gltf_item(document, GLTF_MESHES, (size_t)gltf_index(node, "mesh"));
    json_t *own = json_object_get(node, "weights");
    json_t *weights = own ? own : json_object_get(mesh, "weights");
    json_t *targets = json_object_get(primitive, "targets"), *target;
    size_t number;
    json_array_foreach (targets, number, target) {
        const double weight = json_number_value(json_array_get(weights, number));
        for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
            const long accessor = gltf_index(target, parts[i].name);
            /* normals that are computed follow the positions */
            if (weight == 0.0 || accessor < 0 || (i > 0 && !draft->has_normals))
                continue;
            if (!add_target(document, (size_t)accessor, weight, parts[i].offset, draft, error))
                return false;
        }
    }
    return true;
}

bool gltf_deforms(json_t *node) {
    return json_object_get(node, "weights") || json_object_get(node, "skin");
}

/* --- skins ------------------------------------------------------------------------------------ */

typedef struct skin {
    size_t joint_count;
    double (*joints)[16]; /* from the mesh's space to the world */
} skin;

static bool load_skin(const gltf *document, size_t index, skin *s, base_error *error) {
    json_t *entry = gltf_item(document, GLTF_SKINS, index);
    json_t *joints = json_object_get(entry, "joints");
    const long matrices = gltf_index(entry, "inverseBindMatrices");
    float *inverse = NULL;
    s->joint_count = json_array_size(joints);
    s->joints = calloc(s->joint_count, sizeof *s->joints);
    bool ok = s->joints || base_fail(error, document->subject, "does not fit into memory");
    ok = ok && (matrices < 0 || gltf_read_floats(document, (size_t)matrices, &inverse, error));
    for (size_t i = 0; ok && i < s->joint_count; i++) {
        const size_t joint = (size_t)json_number_value(json_array_get(joints, i));
        double bind[16];
        for (size_t k = 0; k < 16; k++)
            bind[k] = inverse ? (double)inverse[16 * i + k] : k % 5 == 0;
        scene_multiply(document->nodes[joint].world, bind, s->joints[i]);
    }
    free(inverse);
    return ok;
}

/* Adds the joints and weights of one set of four to the vertices' matrices; *there is false if
 * there is no such set. */
static bool add_influences(const gltf *document, const skin *s, json_t *attributes, int set,
                           size_t vertex_count, double (*matrices)[17], bool *there,
                           base_error *error) {
    char joints_name[32], weights_name[32];
    uint32_t *joints = NULL;
    float *weights = NULL;
    snprintf(joints_name, sizeof joints_name, "JOINTS_%d", set);
    snprintf(weights_name, sizeof weights_name, "WEIGHTS_%d", set);
    const long joints_at = gltf_index(attributes, joints_name);
    const long weights_at = gltf_index(attributes, weights_name);
    *there = joints_at >= 0 && weights_at >= 0;
    if (!*there)
        return true;
    const bool ok =
        gltf_read_integers(document, (size_t)joints_at, s->joint_count, &joints, error) &&
        gltf_read_floats(document, (size_t)weights_at, &weights, error);
    for (size_t i = 0; ok && i < 4 * vertex_count; i++) {
        const double weight = (double)weights[i];
        for (size_t k = 0; k < 16; k++)
            matrices[i / 4][k] += weight * s->joints[joints[i]][k];
        matrices[i / 4][16] += weight;
    }
    free(joints);
    free(weights);
    return ok;
}

static void transform_vertices(const double (*matrices)[17], const double world[16],
                               mesh_draft *draft) {
    mesh_transform transform = mesh_transform_make(world);
    bool mirrors = transform.mirrors;
    for (size_t i = 0; i < draft->vertex_count; i++) {
        if (matrices) {
            double m[16];
            const double sum = matrices[i][16];
            for (int k = 0; k < 16; k++)
                m[k] = sum > 0.0 ? matrices[i][k] / sum : world[k];
            transform = mesh_transform_make(m);
            mirrors = i == 0 ? transform.mirrors : mirrors;
        }
        mesh_transform_vertex(&transform, &draft->vertices[i]);
    }
    if (mirrors)
        mesh_flip(draft);
}

bool gltf_to_world(const gltf *document, json_t *node, json_t *attributes, const double world[16],
                   mesh_draft *draft, base_error *error) {
    const long index = gltf_index(node, "skin");
    skin s = { 0 };
    if (index < 0 || !json_object_get(attributes, "JOINTS_0")) {
        transform_vertices(NULL, world, draft);
        return true;
    }
    /* of each vertex the weighted sum of its joints' matrices, and of the weights */
    double(*matrices)[17] = calloc(draft->vertex_count, sizeof *matrices);
    bool ok = matrices || base_fail(error, document->subject, "does not fit into memory");
    bool there = true;
    ok = ok && load_skin(document, (size_t)index, &s, error);
    for (int set = 0; ok && there; set++)
        ok = add_influences(document, &s, attributes, set, draft->vertex_count, matrices, &there,
                            error);
    if (ok)
        transform_vertices((const double(*)[17])matrices, world, draft);
    free(matrices);
    free(s.joints);
    return ok;
}

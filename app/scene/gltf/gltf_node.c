/* SPDX-License-Identifier: MIT */
/* gltf_node.c - the tree of nodes and their transforms. */
#include "app/scene/gltf/gltf.h"
#include "app/scene/instance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How far a rotation's length may be from 1 by rounding; beyond that it is noted as invalid, though
 * its direction is used. */
#define QUATERNION_SLACK 0.02
#define MATRIX_SLACK     1e-6

/* --- transforms ------------------------------------------------------------------------------- */

void gltf_transform_read(json_t *node, gltf_transform *t) {
    *t = (gltf_transform) { .rotation = { 0, 0, 0, 1 }, .scale = { 1, 1, 1 } };
    gltf_numbers(node, "translation", 3, t->translation);
    gltf_numbers(node, "rotation", 4, t->rotation);
    gltf_numbers(node, "scale", 3, t->scale);
}

void gltf_transform_matrix(const gltf_transform *t, double m[16]) {
    double q[4], length2 = 0.0;
    for (int i = 0; i < 4; i++)
        length2 += t->rotation[i] * t->rotation[i];
    for (int i = 0; i < 4; i++)
        q[i] = length2 > 0.0 ? t->rotation[i] / sqrt(length2) : i == 3;
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double rotation[9] = {
        1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
        2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
        2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y),
    };
    for (int i = 0; i < 16; i++)
        m[i] = i % 5 == 0;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            m[4 * column + row] = rotation[3 * column + row] * t->scale[column];
    memcpy(m + 12, t->translation, sizeof t->translation);
}

/* Whether a node has transform parts beside its matrix other than those of the identity. */
static bool has_parts(json_t *node) {
    gltf_transform t;
    gltf_transform_read(node, &t);
    for (int k = 0; k < 3; k++)
        if (t.translation[k] != 0.0 || t.scale[k] != 1.0 || t.rotation[k] != 0.0)
            return true;
    return false;
}

static bool check_transform(const gltf *document, size_t index, base_error *error) {
    json_t *node = gltf_item(document, GLTF_NODES, index);
    double q[4] = { 0.0, 0.0, 0.0, 1.0 }, m[16] = { [15] = 1.0 };
    if (json_object_get(node, "matrix") && has_parts(node))
        return gltf_fail(document, GLTF_NODES, index, "has a matrix and its parts", error);
    gltf_numbers(node, "rotation", 4, q);
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(fabs(length - 1.0) <= QUATERNION_SLACK))
        builder_unsupported(document->builder, "length of a rotation", "node", 1);
    gltf_numbers(node, "matrix", 16, m);
    if (!(fabs(m[3]) <= MATRIX_SLACK && fabs(m[7]) <= MATRIX_SLACK && fabs(m[11]) <= MATRIX_SLACK &&
          fabs(m[15] - 1.0) <= MATRIX_SLACK))
        return gltf_fail(document, GLTF_NODES, index, "has a matrix whose last row is not 0 0 0 1",
                         error);
    return true;
}

/* --- the tree --------------------------------------------------------------------------------- */

static bool find_parents(const gltf *document, base_error *error) {
    const size_t count = gltf_count(document, GLTF_NODES);
    for (size_t i = 0; i < count; i++)
        document->nodes[i].parent = -1;
    for (size_t i = 0; i < count; i++) {
        json_t *children = json_object_get(gltf_item(document, GLTF_NODES, i), "children"), *child;
        size_t number;
        if (!check_transform(document, i, error))
            return false;
        json_array_foreach (children, number, child) {
            gltf_node *below = &document->nodes[(size_t)json_number_value(child)];
            if (below->parent >= 0)
                return gltf_fail(document, GLTF_NODES, i, "has a child that has another parent",
                                 error);
            below->parent = (long)i;
        }
    }
    return true;
}

static bool find_world(const gltf *document, size_t index, base_error *error) {
    json_t *entry = gltf_item(document, GLTF_NODES, index);
    gltf_node *node = &document->nodes[index];
    gltf_transform transform;
    double local[16];
    gltf_transform_read(entry, &transform);
    gltf_transform_matrix(&transform, local);
    gltf_numbers(entry, "matrix", 16, local);
    if (node->parent >= 0) {
        scene_multiply(document->nodes[node->parent].world, local, node->world);
        node->shown |= document->nodes[node->parent].shown;
    } else {
        memcpy(node->world, local, sizeof local);
        for (int k = 0; k < 3; k++)
            node->world[12 + k] -= document->builder->origin[k];
    }
    for (int i = 0; i < 16; i++)
        if (!isfinite(node->world[i]))
            return gltf_fail(document, GLTF_NODES, index, "has no finite transform", error);
    return true;
}

/* Pushes the nodes of a list onto a stack, the first on top. */
static size_t push_all(const json_t *list, long *stack, size_t used) {
    const size_t count = json_array_size(list);
    for (size_t i = 0; i < count; i++)
        stack[used + count - 1 - i] = (long)json_number_value(json_array_get(list, i));
    return used + count;
}

/* Orders the nodes of the trees on the stack and computes their world transforms. A root of the
 * scene, which has been cut off from its parent, may not be in another tree that is shown: it would
 * be drawn twice. */
static bool order_nodes(const gltf *document, long *stack, size_t used, size_t *ordered,
                        base_error *error) {
    while (used > 0) {
        const size_t node = (size_t)stack[--used];
        document->order[(*ordered)++] = node;
        if (!find_world(document, node, error))
            return false;
        const size_t before = used;
        used = push_all(json_object_get(gltf_item(document, GLTF_NODES, node), "children"), stack,
                        used);
        size_t kept = before;
        for (size_t i = before; i < used; i++) {
            const long child = stack[i];
            if (document->nodes[child].parent == (long)node)
                stack[kept++] = child;
            else if (document->nodes[node].shown)
                return gltf_fail(document, GLTF_NODES, (size_t)child,
                                 "is a root of the scene and the child of another node", error);
        }
        used = kept;
    }
    return true;
}

/* Orders the scene's trees, then those that are not shown but may be referred to. Nodes that remain
 * are in a loop. */
static bool order_trees(const gltf *document, long *stack, base_error *error) {
    const size_t count = gltf_count(document, GLTF_NODES);
    const long number = gltf_index(document->root, "scene");
    json_t *roots = NULL, *item;
    size_t ordered = 0, k;
    if (gltf_count(document, GLTF_SCENES) > 0)
        roots = json_object_get(gltf_item(document, GLTF_SCENES, number < 0 ? 0 : (size_t)number),
                                "nodes");
    json_array_foreach (roots, k, item) {
        gltf_node *root = &document->nodes[(size_t)json_number_value(item)];
        /* a root of the scene is not a child of a node that is not shown */
        root->parent = -1;
        root->shown = true;
    }
    if (!order_nodes(document, stack, push_all(roots, stack, 0), &ordered, error))
        return false;
    for (size_t i = 0; i < count; i++)
        if (document->nodes[i].parent < 0 && !document->nodes[i].shown) {
            stack[0] = (long)i;
            if (!order_nodes(document, stack, 1, &ordered, error))
                return false;
        }
    return ordered == count ||
           base_fail(error, document->subject,
                     "is not valid glTF: nodes are children of themselves, in a loop");
}

bool gltf_load_nodes(gltf *document, base_error *error) {
    const size_t count = gltf_count(document, GLTF_NODES);
    document->nodes = calloc(count + 1, sizeof *document->nodes);
    document->order = calloc(count + 1, sizeof *document->order);
    long *stack = calloc(count + 1, sizeof *stack);
    const bool ok = document->nodes && document->order && stack
                        ? find_parents(document, error) && order_trees(document, stack, error)
                        : base_fail(error, document->subject, "does not fit into memory");
    free(stack);
    return ok;
}

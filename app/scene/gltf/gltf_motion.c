/* SPDX-License-Identifier: MIT */
/* gltf_motion.c - node animation, of which only the positions of lights are kept: sampled at even
 * steps, fine enough for image sequences. */
#include "app/scene/gltf/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLES_PER_SECOND 60.0
#define SAMPLES_MAX        4096 /* per light */
#define SECONDS_MAX        1e6

typedef enum channel_kind {
    CHANNEL_TRANSLATION,
    CHANNEL_ROTATION,
    CHANNEL_SCALE,
    CHANNEL_KINDS
} channel_kind;
typedef enum channel_curve { CURVE_LINEAR, CURVE_STEP, CURVE_CUBIC } channel_curve;

/* A property of a node over time: `width` numbers per key, or three times as many for a cubic
 * curve: in-tangent, value, out-tangent. */
typedef struct channel {
    channel_kind kind;
    channel_curve curve;
    float *times, *values; /* NULL: constant */
    size_t count, width;
} channel;

struct gltf_motions {
    channel *channels; /* CHANNEL_KINDS per node */
    bool *moved;       /* nodes that a channel moves, theirs or an ancestor's */
    bool *rotated;     /* nodes that a rotation channel moves, theirs or an ancestor's */
    size_t node_count;
    double period;
};

/* --- reading ---------------------------------------------------------------------------------- */

static bool times_rise(const channel *c) {
    for (size_t i = 0; i < c->count; i++)
        if (!(c->times[i] >= 0.0f) || !((double)c->times[i] <= SECONDS_MAX) ||
            (i > 0 && !(c->times[i] > c->times[i - 1])))
            return false;
    return true;
}

/* Returns the channel that an animation entry is for, or NULL if it moves no node. */
static channel *find_channel(const gltf_motions *all, json_t *target) {
    static const char *const kinds[] = { "translation", "rotation", "scale" };
    const char *path = gltf_text(target, "path");
    const long node = gltf_index(target, "node");
    for (int kind = 0; kind < CHANNEL_KINDS && node >= 0; kind++)
        if (strcmp(path, kinds[kind]) == 0) {
            channel *c = &all->channels[CHANNEL_KINDS * node + kind];
            c->kind = (channel_kind)kind;
            c->width = c->kind == CHANNEL_ROTATION ? 4 : 3;
            return c;
        }
    return NULL;
}

static bool read_channel(const gltf *document, json_t *sampler, channel *c, base_error *error) {
    const size_t input = (size_t)gltf_index(sampler, "input");
    const char *curve = gltf_text(sampler, "interpolation");
    c->curve = strcmp(curve, "STEP") == 0          ? CURVE_STEP
               : strcmp(curve, "CUBICSPLINE") == 0 ? CURVE_CUBIC
                                                   : CURVE_LINEAR;
    c->count = document->accessors[input].count;
    return gltf_read_floats(document, input, &c->times, error) &&
           gltf_read_floats(document, (size_t)gltf_index(sampler, "output"), &c->values, error);
}

/* Drops a channel whose times do not ascend; the node's property stays constant. */
static void drop_channel(const gltf *document, channel *c) {
    free(c->times);
    free(c->values);
    c->times = c->values = NULL;
    builder_unsupported(document->builder, "times that do not rise", "animation channel", 1);
}

/* Reads the channels of all animations, which play at once; of two channels for one property the
 * first is used. */
static bool read_channels(const gltf *document, gltf_motions *all, base_error *error) {
    for (size_t i = 0; i < gltf_count(document, GLTF_ANIMATIONS); i++) {
        json_t *animation = gltf_item(document, GLTF_ANIMATIONS, i);
        json_t *samplers = json_object_get(animation, "samplers");
        json_t *channels = json_object_get(animation, "channels"), *entry;
        size_t number;
        json_array_foreach (channels, number, entry) {
            channel *c = find_channel(all, json_object_get(entry, "target"));
            if (!c || c->times)
                continue;
            json_t *sampler = json_array_get(samplers, (size_t)gltf_index(entry, "sampler"));
            if (!read_channel(document, sampler, c, error))
                return false;
            if (!times_rise(c)) {
                drop_channel(document, c);
                continue;
            }
            all->period = fmax(all->period, (double)c->times[c->count - 1]);
        }
    }
    for (size_t i = 0; i < all->node_count; i++) {
        const size_t node = document->order[i];
        const channel *own = &all->channels[CHANNEL_KINDS * node];
        const long parent = document->nodes[node].parent;
        all->moved[node] =
            own[0].times || own[1].times || own[2].times || (parent >= 0 && all->moved[parent]);
        all->rotated[node] = own[CHANNEL_ROTATION].times || (parent >= 0 && all->rotated[parent]);
    }
    return true;
}

gltf_motions *gltf_motions_open(const gltf *document, base_error *error) {
    const size_t nodes = gltf_count(document, GLTF_NODES);
    gltf_motions *all = calloc(1, sizeof *all);
    if (all) {
        all->node_count = nodes;
        all->channels = calloc(CHANNEL_KINDS * nodes + 1, sizeof *all->channels);
        all->moved = calloc(nodes + 1, sizeof *all->moved);
        all->rotated = calloc(nodes + 1, sizeof *all->rotated);
    }
    if (all && all->channels && all->moved && all->rotated
            ? read_channels(document, all, error)
            : base_fail(error, document->subject, "does not fit into memory"))
        return all;
    gltf_motions_close(all);
    return NULL;
}

void gltf_motions_close(gltf_motions *all) {
    if (!all)
        return;
    for (size_t i = 0; all->channels && i < CHANNEL_KINDS * all->node_count; i++) {
        free(all->channels[i].times);
        free(all->channels[i].values);
    }
    free(all->channels);
    free(all->moved);
    free(all->rotated);
    free(all);
}

bool gltf_moves(const gltf_motions *all, size_t node) {
    return all->period > 0.0 && all->moved[node];
}

bool gltf_rotates(const gltf_motions *all, size_t node) {
    return all->period > 0.0 && all->rotated[node];
}

/* --- sampling --------------------------------------------------------------------------------- */

/* Interpolates q and r, or q and -r, along the shorter arc at constant speed. */
static void rotate_between(const float *q, const float *r, double u, double *out) {
    double along = 0.0;
    for (int i = 0; i < 4; i++)
        along += (double)q[i] * (double)r[i];
    const double sign = along < 0.0 ? -1.0 : 1.0, angle = acos(fmin(along * sign, 1.0));
    const double sine = sin(angle);
    const double a = sine > 1e-6 ? sin((1.0 - u) * angle) / sine : 1.0 - u;
    const double b = sine > 1e-6 ? sin(u * angle) / sine : u;
    for (int i = 0; i < 4; i++)
        out[i] = a * (double)q[i] + b * sign * (double)r[i];
}

/* Evaluates glTF's cubic spline between two keys of three entries each. */
static void bend(const channel *c, size_t low, double step, double u, double *out) {
    const float *from = c->values + 3 * low * c->width, *to = from + 3 * c->width;
    for (size_t i = 0; i < c->width; i++) {
        const double value = (double)from[c->width + i], leaving = (double)from[2 * c->width + i];
        const double next = (double)to[c->width + i], arriving = (double)to[i];
        const double u2 = u * u, u3 = u2 * u;
        out[i] = (2 * u3 - 3 * u2 + 1) * value + step * (u3 - 2 * u2 + u) * leaving +
                 (3 * u2 - 2 * u3) * next + step * (u3 - u2) * arriving;
    }
}

static void sample(const channel *c, double seconds, double *out) {
    const size_t stride = c->curve == CURVE_CUBIC ? 3 * c->width : c->width;
    const size_t inside = c->curve == CURVE_CUBIC ? c->width : 0;
    size_t low = 0, high = c->count - 1;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *((double)c->times[middle] <= seconds ? &low : &high) = middle;
    }
    const double step = (double)c->times[high] - (double)c->times[low];
    const double along = step > 0.0 ? (seconds - (double)c->times[low]) / step : 0.0;
    const double u = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;
    const float *from = c->values + low * stride + inside;
    const float *to = c->values + high * stride + inside;
    if (c->curve == CURVE_CUBIC && high > low)
        bend(c, low, step, u, out);
    else if (c->kind == CHANNEL_ROTATION && c->curve == CURVE_LINEAR)
        rotate_between(from, to, u, out);
    else
        for (size_t i = 0; i < c->width; i++)
            out[i] = c->curve == CURVE_STEP && u < 1.0
                         ? (double)from[i]
                         : (double)from[i] + u * ((double)to[i] - (double)from[i]);
}

static void through_node(const gltf *document, const gltf_motions *all, long node, double seconds,
                         double point[3]) {
    json_t *entry = gltf_item(document, GLTF_NODES, (size_t)node);
    gltf_transform transform;
    double *const parts[] = { transform.translation, transform.rotation, transform.scale };
    double m[16], moved[3];
    gltf_transform_read(entry, &transform);
    for (int kind = 0; kind < CHANNEL_KINDS; kind++) {
        const channel *c = &all->channels[CHANNEL_KINDS * node + kind];
        if (c->times)
            sample(c, seconds, parts[kind]);
    }
    gltf_transform_matrix(&transform, m);
    gltf_numbers(entry, "matrix", 16, m);
    for (int k = 0; k < 3; k++)
        moved[k] = m[k] * point[0] + m[4 + k] * point[1] + m[8 + k] * point[2] + m[12 + k];
    memcpy(point, moved, sizeof moved);
}

bool gltf_add_motion(const gltf *document, const gltf_motions *all, size_t node, size_t light,
                     scene_builder *builder, base_error *error) {
    if (!gltf_moves(all, node))
        return true;
    const double wanted = ceil(all->period * SAMPLES_PER_SECOND) + 1.0;
    const size_t count = wanted > SAMPLES_MAX ? SAMPLES_MAX : (size_t)wanted;
    const size_t first = builder_count(builder, BLOB_OFFSETS);
    scene_motion *motion = builder_append(builder, BLOB_MOTIONS, 1);
    lmp_vec3 *offsets = motion ? builder_append(builder, BLOB_OFFSETS, count) : NULL;
    if (!offsets)
        return base_fail(error, document->subject, "does not fit into memory");
    *motion =
        (scene_motion) { (uint32_t)light, (uint32_t)first, (uint32_t)count, (float)all->period };
    for (size_t i = 0; i < count; i++) {
        double point[3] = { 0.0, 0.0, 0.0 };
        for (long at = (long)node; at >= 0; at = document->nodes[at].parent)
            through_node(document, all, at, all->period * (double)i / (double)(count - 1), point);
        const double *rest = &document->nodes[node].world[12], *origin = builder->origin;
        offsets[i] = (lmp_vec3) { (float)(point[0] - origin[0] - rest[0]),
                                  (float)(point[1] - origin[1] - rest[1]),
                                  (float)(point[2] - origin[2] - rest[2]) };
    }
    return true;
}
